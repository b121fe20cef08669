"""Simulates every example with many seeds, and holds what is printed against what was kept.

    python -m tests.as_before --seeds 100           # compare
    python -m tests.as_before --seeds 100 --write   # keep what is printed now

`tests/as_before.json` has one hash for each seed, of what `simulate --json --trace` printed, without
mishaps and with them, where drones fly straight. It was written by the second command when actions began to
be done beside a spot that another drone has, and drones to go home at once where nothing waits (decisions 31
and 32), which changed two examples, `aerial_mapping` and `pm10`; and once before, when jobs of one instant began
to reserve their space in the order in which they arrive, and ways home to be one section (decision 18). Until
then all was as at the last commit whose packages carried the whole runtime (0984158).
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from argparse import ArgumentParser
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from plutoc.cli import main as plutoc
from tests.kit.apps import fly_straight

HERE = Path(__file__).parent
EXAMPLES = HERE.parent / "examples"
LIBRARY = HERE.parent / "runtime"
"""This checkout's, not the installed one's."""
KEPT = HERE / "as_before.json"
FILES = ("app.pluto", "missions.toml", "fleet.toml")
FORMER = {
    "aerial_mapping": {"default: 1 min": "default: 30 s", 'gap = "40 s"': 'gap = "20 s"'},
    "pm10": {"default: 90 s": "default: 1 min", 'gap = "2 min"': 'gap = "75 s"'},
    "object_finder": {
        "= DroneAllocator": "= DroneAllocator(policy: nearest)",
        "[map]": '[fleet]\nafter_trip = "home"\n\n[map]',
    },
}
"""What stands in examples since their drones fly like Crazyflies, and what stood there before; and the
defaults of before, of the one that names none."""
MISHAPS = {"nothing goes wrong": "", "mishaps": "crash=10%,link=5%,action=5%,battery=5%"}

_MANY_RUNS = """
import contextlib, hashlib, importlib, io, os, sys
name, seeds, mishaps, fleet, trace = sys.argv[1:]
app = importlib.import_module(f"{name}.flow").APP
try:
    main = importlib.import_module(f"{name}._runtime.command").main
except ModuleNotFoundError:  # so it was before
    main = importlib.import_module(f"{name}._runtime.cli").main
for seed in range(int(seeds)):
    command = ["simulate", "missions.toml", "--fleet", fleet, "--seed", str(seed)]
    command += ["--json", "--trace", trace, *(["--fail", mishaps] if mishaps else [])]
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        code = main(app, command)
    assert code in (0, 1), code
    hashed = hashlib.sha256(printed.getvalue().encode())
    with open(trace, "rb") as file:
        hashed.update(file.read())
    os.remove(trace)
    print(hashed.hexdigest()[:16])
"""


def as_it_was(example: str, folder: Path) -> Path:
    """Copy an example into a folder, with the limits that it had, and return where it is."""
    copy = shutil.copytree(EXAMPLES / example, folder / "examples" / example)
    text = {name: (copy / name).read_text("utf-8") for name in FILES}
    for now, former in FORMER.get(example, {}).items():
        assert any(now in one for one in text.values()), f"{example}: {now}"
        text = {name: one.replace(now, former) for name, one in text.items()}
    for name, one in text.items():
        (copy / name).write_text(one, "utf-8")
    return copy


def hashes(example: Path, package: Path, mishaps: str, seeds: int) -> list[str]:
    """Return a hash of what each of the first seeds printed, flown by a compiled package."""
    fleet = Path(shutil.copy(example / "fleet.toml", package))
    fly_straight(fleet)
    command = [sys.executable, "-c", _MANY_RUNS, example.name, str(seeds), mishaps, str(fleet)]
    done = subprocess.run(
        [*command, str(package / "trace.jsonl")],
        cwd=example,
        env={"PYTHONPATH": f"{package / 'src'}{os.pathsep}{LIBRARY}", "PYTHONHASHSEED": "0"},
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode:
        raise RuntimeError(f"{example.name}: {done.stderr}")
    return done.stdout.split()


def compiled(example: Path, folder: Path) -> Path:
    """Compile an example into a folder, and return its package."""
    package = folder / example.name
    if plutoc(["compile", str(example / "app.pluto"), "-o", str(package)]):
        raise RuntimeError(f"{example.name} does not compile")
    return package


def main(argv: Sequence[str] | None = None) -> int:
    """Fly, and compare or keep."""
    parser = ArgumentParser(prog="python -m tests.as_before", allow_abbrev=False)
    parser.add_argument("--seeds", type=int, default=100)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args(argv)
    kept = {} if options.write else json.loads(KEPT.read_text("utf-8"))
    different = 0
    with TemporaryDirectory() as folder:
        for app in sorted(EXAMPLES.glob("*/app.pluto")):
            if not options.write and app.parent.name not in kept:
                print(f"{app.parent.name} is new: --write keeps what it prints")
                continue
            example = as_it_was(app.parent.name, Path(folder))
            package = compiled(example, Path(folder))
            for name, mishaps in MISHAPS.items():
                found = hashes(example, package, mishaps, options.seeds)
                if options.write:
                    kept.setdefault(example.name, {})[name] = found
                    continue
                before = kept[example.name][name][: options.seeds]
                wrong = [
                    seed
                    for seed, pair in enumerate(zip(before, found, strict=True))
                    if len(set(pair)) > 1
                ]
                print(
                    f"{example.name}, {name}: {len(found) - len(wrong)} of {len(found)} as before",
                    *wrong,
                )
                different += len(wrong)
    if options.write:
        KEPT.write_text(json.dumps(kept, indent=1) + "\n", "utf-8")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
