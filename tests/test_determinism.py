"""The same input gives the same bytes: packages and traces, for every hash seed and folder."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.paths import ROOT

EXAMPLES = ROOT / "examples"
HASH_SEEDS = ("0", "1", "4711")
FAULTS = "crash=10%,link=5%,action=5%,battery=5%"


def run(
    hash_seed: str, *words: str | Path, path: str | None = None, codes: tuple[int, ...] = (0,)
) -> None:
    """Run Python with this hash seed; it must end with one of the codes."""
    cache = os.path.join(os.environ["XDG_CACHE_HOME"], hash_seed)  # none takes what another kept
    environment = {**os.environ, "PYTHONHASHSEED": hash_seed, "XDG_CACHE_HOME": cache}
    if path is not None:
        environment["PYTHONPATH"] = path
    done = subprocess.run(
        [sys.executable, *(str(word) for word in words)],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode in codes, done.stderr


def files(folder: Path) -> dict[str, bytes]:
    """Every file of a folder by its path in it."""
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file() and path.suffix != ".pyc"
    }


@pytest.mark.parametrize("name", ["alfalfa", "pm10", "drugs_distribution_timer"])
def test_two_compilations_in_different_folders_are_the_same_bytes(
    name: str, tmp_path: Path
) -> None:
    source = EXAMPLES / name / "app.pluto"
    folders = [tmp_path / "one" / name, tmp_path / "a longer way" / "two" / name]
    for hash_seed, folder in zip(HASH_SEEDS, folders, strict=False):
        folder.parent.mkdir(parents=True)
        run(hash_seed, "-m", "plutoc", "compile", source, "-o", folder)
    first, second = (files(folder) for folder in folders)
    assert first == second
    assert first.keys() >= {"pluto.lock", f"src/{name}/flow.py"}


def test_the_same_seed_gives_the_same_trace_and_another_seed_another(tmp_path: Path) -> None:
    example, package = EXAMPLES / "alfalfa", tmp_path / "alfalfa"
    run("0", "-m", "plutoc", "compile", example / "app.pluto", "-o", package)

    def trace(hash_seed: str, seed: int) -> bytes:
        file = tmp_path / f"{hash_seed}-{seed}.jsonl"
        plan: list[str | Path] = [example / "missions.toml", "--fleet", example / "fleet.toml"]
        command: list[str | Path] = ["-m", "alfalfa", "simulate", *plan, "--seed", str(seed)]
        command += ["--fail", FAULTS, "--trace", file]
        # 1: under these faults a mission may fail
        run(hash_seed, *command, path=str(package / "src"), codes=(0, 1))
        return file.read_bytes()

    traces = {trace(hash_seed, 3) for hash_seed in HASH_SEEDS}
    assert len(traces) == 1
    assert traces != {trace("0", 4)}
    assert b"trip.failed" in traces.pop()
