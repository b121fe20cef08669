"""The same input gives the same bytes: plans, packages and traces, for every hash seed and folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.kit.command import python
from tests.paths import EXAMPLES, ROOT

HASH_SEEDS = ("0", "4711")
PATHS = ":".join(str(ROOT / name) for name in (".", "grammar", "runtime", "stdlib_blocks"))
PROGRAM = """
import sys
from pathlib import Path
from plutoc.cli import main
from plutoc.plan.build import build
from plutoc.plan.show import show
from tests.compiler.check.graphs import checked
from tests.compiler.plan.graphs import GRAPHS
examples, into = map(Path, sys.argv[1:3])
Path(into, "plans.txt").write_text("".join(show(build(checked(text))) for text in GRAPHS.values()))
for name in ("alfalfa", "pm10", "drugs_distribution_timer"):
    assert main(["compile", str(examples / name / "app.pluto"), "-o", str(into / name)]) == 0
sys.path.insert(0, str(into / "alfalfa/src"))
from alfalfa.flow import APP
from alfalfa._runtime.command import main
plan = [str(examples / "alfalfa/missions.toml"), "--fleet", str(examples / "alfalfa/fleet.toml")]
for seed in ("3", "4"):
    words = ["--seed", seed, "--fail", "crash=10%,link=5%,action=5%,battery=5%"]
    main(APP, ["simulate", *plan, *words, "--trace", str(into / f"{seed}.jsonl")])
"""


def files(folder: Path) -> dict[str, bytes]:
    """Return every file of a folder by its path in it."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.suffix != ".pyc"
    }


@pytest.mark.process
def test_hash_seeds_and_folders_change_no_byte(tmp_path: Path) -> None:
    """Of plans, of packages, and of what a simulation under all faults has written down."""
    made = []
    for seed, name in zip(HASH_SEEDS, ("one", "a longer way/two"), strict=True):
        folder = tmp_path / name
        folder.mkdir(parents=True)
        cache = str(tmp_path / f"cache {seed}")  # none takes what another kept
        environment = {"PYTHONPATH": PATHS, "PYTHONHASHSEED": seed, "XDG_CACHE_HOME": cache}
        done = python("-c", PROGRAM, EXAMPLES, folder, cwd=ROOT, **environment)
        assert done.code == 0, done.err
        made.append(files(folder))
    first, second = made
    assert first == second
    assert first.keys() >= {"plans.txt", "alfalfa/pluto.lock", "pm10/src/pm10/flow.py"}
    assert first["3.jsonl"] != first["4.jsonl"]
    assert b"trip.failed" in first["3.jsonl"]
    assert b"join" in first["plans.txt"]
