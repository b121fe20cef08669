"""A package and the library are installed in each of the three ways without an index."""

from __future__ import annotations

import os
import sys
import tomllib
from pathlib import Path

import pytest

from pluto_fleet import __version__
from tests.paths import ROOT
from tests.release.environments import compile_app, fresh, run, succeed

LIBRARY = ROOT / "runtime"
EXAMPLE = ROOT / "examples/drugs_distribution"


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a generated package."""
    return compile_app(EXAMPLE / "app.pluto", tmp_path_factory.mktemp("made") / "drugs")


@pytest.fixture(scope="module")
def builders(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the wheels that pip builds others with, or the library needs; these alone are fetched."""
    wheels = tmp_path_factory.mktemp("builders")
    settings = tomllib.loads((LIBRARY / "pyproject.toml").read_text(encoding="utf-8"))
    needed = *settings["build-system"]["requires"], *settings["project"]["dependencies"]
    succeed(sys.executable, "-m", "pip", "wheel", "-q", "-w", wheels, *needed)
    return wheels


def offline(programs: Path, *words: str | Path, wheels: tuple[Path, ...]) -> None:
    """Run pip where there is no index, but folders with wheels."""
    found = " ".join(map(os.fspath, wheels))
    # the variables reach also the pip that installs what builds
    done = run(programs / "pip", *words, PIP_NO_INDEX="1", PIP_FIND_LINKS=found)
    assert done.code == 0, done.err


def flies(programs: Path) -> None:
    """The library is there, and the app is flown by it."""
    program = programs / "drugs_distribution"
    assert f"pluto-fleet {__version__}" in succeed(program, "--version")
    plan: list[str | Path] = [EXAMPLE / "missions.toml", "--fleet", EXAMPLE / "fleet.toml"]
    assert "with traffic" in succeed(program, "simulate", *plan).splitlines()[-1]


def test_from_an_index_that_is_a_folder(package: Path, builders: Path, tmp_path: Path) -> None:
    programs, wheels = fresh(tmp_path / "venv"), tmp_path / "wheels"
    offline(programs, "wheel", "-q", "-w", wheels, LIBRARY, wheels=(builders,))
    offline(programs, "install", "-q", f"{package}[fleet]", wheels=(builders, wheels))
    flies(programs)


def test_on_a_machine_without_a_network(package: Path, builders: Path, tmp_path: Path) -> None:
    here, wheels = fresh(tmp_path / "here"), tmp_path / "wheels"
    offline(here, "wheel", "-q", "-w", wheels, LIBRARY, f"{package}[fleet]", wheels=(builders,))
    there = fresh(tmp_path / "there")
    words = ("install", "-q", "--no-index", "--find-links", wheels, "drugs_distribution[fleet]")
    succeed(there / "pip", *words)
    flies(there)
