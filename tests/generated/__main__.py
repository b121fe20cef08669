"""Holds what is generated to the rules that hold for what is written: black, ruff and mypy --strict find nothing.

    python -m tests.generated

Compiles all examples, the apps of the tests of what is emitted, and those with golden packages, as they come out
at first. Black and ruff read all of it; mypy reads a few that together have all blocks and kinds of hooks, and the
plain flow of one. The brain that they carry is checked at its source. Exits with 1 if there is anything to say.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from argparse import ArgumentParser
from pathlib import Path

from plutoc.emit.package import emit
from tests.compiler.emit.apps import EVENTS, ODD_NAMES, PARCELS, PLAIN, TYPED
from tests.compiler.emit.plans import plan_of
from tests.paths import CASES, EXAMPLES, ROOT

STRICT = ("odd_", "typed_", "events_", "alfalfa")


def sources() -> dict[str, str]:
    """Return the texts of the apps, by the names of their packages."""
    paths = [
        *EXAMPLES.glob("*/app.pluto"),
        *(p.parent / "app.pluto" for p in CASES.glob("*/expected")),
    ]
    texts = {path.parent.name: path.read_text(encoding="utf-8") for path in sorted(paths)}
    return {
        **texts,
        "odd_": ODD_NAMES,
        "parcels": PARCELS,
        "plain": PLAIN,
        "typed_": TYPED,
        "events_": EVENTS,
    }


def written(folder: Path) -> None:
    """Write the packages."""
    for name, text in sources().items():
        package = emit(
            plan_of(text), source_name="app.pluto", picture="flowchart TD\n", graph_data=""
        )
        for path, file in {**package.owned, **package.once}.items():
            (folder / name / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / name / path).write_text(file, encoding="utf-8")
    plain = emit(
        plan_of(ODD_NAMES, optimise=False), source_name="app.pluto", picture="", graph_data=""
    )
    for path, file in plain.owned.items():
        if not (folder / "odd_" / path).exists():
            (folder / "odd_" / path).write_text(file, encoding="utf-8")
    (folder / "odd_/src/odd_/plain_flow.py").write_text(plain.owned["src/odd_/flow.py"])


def checked(folder: Path) -> int:
    """Run the tools, and return how many of their runs found something."""
    ours = f"--config={ROOT / 'pyproject.toml'}"
    black = ("black", "--check", "--quiet", "--line-length=100", "--extend-exclude=/_runtime/", ".")
    mypy = ("mypy", "--strict", "--no-error-summary", f"--cache-dir={os.devnull}", "src")
    ruff = ("ruff", "check", "--no-cache", "--quiet", "--extend-exclude=_runtime")
    found = int(tool(folder, *black))
    for name in sources():
        # where a package lies alone, its own modules are known for its own
        found += tool(folder / name, *ruff, "--isolated", ".")
        found += tool(folder / name, *ruff, ours, f"src/{name}")
    return found + sum(tool(folder / name, *mypy) for name in STRICT)


def tool(folder: Path, *command: str) -> bool:
    """Run a tool in a folder; return whether it found something, which it has printed."""
    environment = {**os.environ, "MYPYPATH": "src"}
    done = subprocess.run(
        [sys.executable, "-m", *command], cwd=folder, env=environment, check=False
    )
    return done.returncode != 0


def main() -> int:
    """Write the packages into a folder of their own, and let the tools read them."""
    ArgumentParser(
        prog="python -m tests.generated", description=(__doc__ or "").split("\n")[0]
    ).parse_args()
    with tempfile.TemporaryDirectory(prefix="pluto-generated-") as folder:
        written(Path(folder))
        return int(checked(Path(folder)) > 0)


if __name__ == "__main__":
    sys.exit(main())
