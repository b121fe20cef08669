"""What is measured can be measured, and what a command has no use for it does not load."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
EXAMPLES = sorted(path.parent.name for path in ROOT.glob("examples/*/app.pluto"))
HEAVY = ("networkx", "jinja2", "black", "asyncio", "importlib.metadata", "lark", "pickle")
FOR_PACKAGES = ("jinja2", "black", "asyncio")
FOR_APPS = ("lark", "argparse", "dataclasses", "typing", "plutoc.compile")


def python(*arguments: str) -> subprocess.CompletedProcess[str]:
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    return subprocess.run(
        [sys.executable, *arguments], env=environment, capture_output=True, text=True, check=True
    )


def loaded(*arguments: str) -> set[str]:
    """Return the modules that a command of plutoc loads."""
    code = (
        "import sys; before = set(sys.modules); from plutoc.cli import main; main(sys.argv[1:]);"
        "print(*(set(sys.modules) - before))"
    )
    return set(python("-c", code, *arguments).stdout.splitlines()[-1].split())


def test_who_asks_for_the_version_does_not_wait_for_the_compiler() -> None:
    """Neither the parser of the language nor that of the command line is loaded."""
    assert not loaded("--version").intersection(HEAVY + FOR_APPS)


@pytest.mark.parametrize("example", EXAMPLES)
def test_checking_an_app_loads_nothing_that_packages_are_made_with(
    example: str, tmp_path: Path
) -> None:
    """Not even where there is a hooks.py, or a warning to be told."""
    for name in ("app.pluto", "hooks.py"):
        if (ROOT / "examples" / example / name).exists():
            shutil.copy(ROOT / "examples" / example / name, tmp_path)
    assert not loaded("check", str(tmp_path / "app.pluto")).intersection(FOR_PACKAGES)


def test_a_compile_that_has_nothing_to_do_loads_nothing(tmp_path: Path) -> None:
    """Not even the parser of the command line."""
    shutil.copy(ROOT / "tests" / "cases" / "alfalfa" / "app.pluto", tmp_path)
    command = ("compile", str(tmp_path / "app.pluto"))
    first = loaded(*command)
    assert "plutoc.compile" in first
    assert not loaded(*command).intersection(HEAVY + FOR_APPS)


def test_the_cold_start_is_measured() -> None:
    """Every command gets a line, and the sample apps are what they are meant to be."""
    said = python(str(ROOT / "benchmarks" / "cold_start.py"), "--rounds", "1").stdout
    lines = {line[:24].strip(): line for line in said.splitlines()[1:]}
    for name in ("check", "check, with a hooks.py", "check, with a warning"):
        assert "networkx" in lines[name]
        assert "black" not in lines[name]


def test_large_apps_are_measured() -> None:
    """Here with few blocks: every shape is an app that passes."""
    script = str(ROOT / "benchmarks" / "large_apps.py")
    said = python(script, "--sizes", "12", "24", "--rounds", "1").stdout.splitlines()[1:]
    assert [line.split()[0] for line in said] == ["chain", "wide", "forks"]


def test_compiling_is_measured() -> None:
    """Here with few blocks, and once."""
    script = str(ROOT / "benchmarks" / "compile.py")
    few = ("--sizes", "12", "24", "--rounds", "1", "--large-rounds", "1", "--json")
    found = json.loads(python(script, *few).stdout)
    for name in ("cold_black", "edit", "cold", "unchanged", "growth_10k"):
        assert found[name] > 0
    assert set(found["raw"]) >= {"python -c pass", "cold_black", "cold", "unchanged", "wide 24"}
    assert all(least["least_s"] <= least["median_s"] for least in found["raw"].values())


def test_the_choice_of_drones_is_measured() -> None:
    """Here in small: every policy chooses, shares out and empties a queue."""
    few = ["--rounds", "1", "--fleets", "5", "120", "--shares", "3x2", "--plans", "2", "60"]
    told = json.loads(python(str(ROOT / "benchmarks" / "allocation.py"), *few, "--json").stdout)
    policies = ("first", "least_used", "nearest", "batch_optimal", "nearest, charging")
    assert list(told["queue_s"]) == [f"{name} {size}" for name in policies for size in (2, 60)]
    assert len(told["choice_us"]) == 6
    assert list(told["share_ms"]) == ["3 x 2"]
