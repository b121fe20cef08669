"""Every example becomes a package that stands alone; with the library beside it, it flies."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from importlib.metadata import version
from pathlib import Path
from typing import Any
from urllib.request import urlopen
from zipfile import ZipFile

import pytest

from pluto_fleet import __version__
from pluto_fleet.shared.domain.app import SEAM
from tests.paths import ROOT
from tests.release.environments import Finished, compile_app, fresh, run, succeed

WITH_PROMISES = ROOT / "examples/night_round"
"""Its plan says what only the library reads."""
ALONE = ROOT / "examples/alfalfa"
OTHERS = [ROOT / "examples/object_finder", ROOT / "examples/pm10"]
"""All others have the blocks of one of these, or are flown by the tests below."""
OURS = str(Path(pytest.__file__).parents[1])
"""Where pytest and what the extras bring are installed for these tests; the library is not there."""

NEEDING = (
    ["fly", "missions.toml", "--sim"],
    ["serve", "--sim"],
    ["resume"],
    ["drones"],
    ["journal"],
)


def test_an_example_stands_alone_and_flies_with_the_library(library: Path, tmp_path: Path) -> None:
    """What needs the library says so before it is installed, and once it is gone."""
    package = compile_app(ALONE / "app.pluto", tmp_path / ALONE.name)
    programs = fresh(tmp_path / "venv")
    before = installed(programs)
    succeed(programs / "pip", "install", "--quiet", package)
    assert installed(programs) - before == {ALONE.name}
    program = programs / ALONE.name

    alone = flies_alone(program, ALONE)
    assert succeed(program, "check", *plan_of(ALONE))
    for words in NEEDING:
        missing(run(program, *words, cwd=ALONE), words[0])
    own_tests_pass(programs, package)

    succeed(programs / "pip", "install", "--quiet", library)
    flies_with_the_library(program, ALONE, state=str(tmp_path / "state"))

    succeed(programs / "pip", "uninstall", "--quiet", "--yes", "pluto-fleet")
    assert simulated(program, ALONE) == alone
    missing(run(program, "fly", "missions.toml", cwd=ALONE), "fly")


def test_other_examples_do_so_together(library: Path, tmp_path: Path) -> None:
    """In one environment: none is in another's way."""
    packages = [compile_app(one / "app.pluto", tmp_path / one.name) for one in OTHERS]
    programs = fresh(tmp_path / "venv")
    succeed(programs / "pip", "install", "--quiet", *packages)
    for example, package in zip(OTHERS, packages, strict=True):
        flies_alone(programs / example.name, example)
        own_tests_pass(programs, package)
    succeed(programs / "pip", "install", "--quiet", library)
    for example in OTHERS:
        state = str(tmp_path / "state" / example.name)
        flies_with_the_library(programs / example.name, example, state)


def flies_alone(program: Path, example: Path) -> dict[str, Any]:
    """Return what it says of its simulation without the library."""
    alone = simulated(program, example)
    assert {mission["status"] for mission in alone["missions"]} == {"COMPLETED"}
    assert "alone" in alone["world"]
    return alone


def flies_with_the_library(program: Path, example: Path, state: str) -> None:
    together = simulated(program, example)
    assert {mission["status"] for mission in together["missions"]} == {"COMPLETED"}
    assert "world" not in together
    fast = ("--sim", "--speed", "200")
    flown = run(program, "fly", *plan_of(example), *fast, XDG_STATE_HOME=state)
    assert flown.code == 0, flown.err
    told = run(program, "journal", XDG_STATE_HOME=state)
    assert (told.code, "COMPLETED" in told.out) == (0, True), told.err


def plan_of(example: Path) -> list[str]:
    return [str(example / "missions.toml"), "--fleet", str(example / "fleet.toml")]


def test_lists_areas_and_promises_need_the_library_and_its_extra(
    library: Path, tmp_path: Path
) -> None:
    package = compile_app(WITH_PROMISES / "app.pluto", tmp_path / WITH_PROMISES.name)
    programs = fresh(tmp_path / "venv")
    succeed(programs / "pip", "install", "--quiet", package)
    plan = [str(WITH_PROMISES / name) for name in ("missions.toml", "fleet.toml")]
    simulate: list[str | Path] = [programs / WITH_PROMISES.name, "simulate", plan[0]]
    simulate += ["--fleet", plan[1], "--json"]
    missing(run(*simulate), f'{plan[0]}: mission "Bed {{bed}}": deadline')
    own_tests_pass(programs, package)

    succeed(programs / "pip", "install", "--quiet", library)
    without = run(*simulate)
    assert (without.code, without.out) == (2, "")
    assert 'pip install "pluto-fleet[areas]"' in without.err
    together = run(*simulate, PYTHONPATH=OURS)
    missions = json.loads(together.out)["missions"]
    assert {mission["status"] for mission in missions} == {"COMPLETED"}, together.err


def test_with_the_library_every_command_works(library: Path, tmp_path: Path) -> None:
    """Also those that want an extra, where what it brings is there."""
    example = ROOT / "examples/drugs_distribution"
    package = compile_app(example / "app.pluto", tmp_path / "package")
    programs = fresh(tmp_path / "venv")
    succeed(programs / "pip", "install", "--quiet", package, library)
    program = programs / "drugs_distribution"
    state = str(tmp_path / "state")

    def told(*words: str | Path) -> Finished:
        return run(program, *words, PYTHONPATH=OURS, XDG_STATE_HOME=state)

    assert f"seam {SEAM}, pluto-fleet {__version__}" in told("--version").out
    own = succeed(programs / "pluto-fleet", "--version")
    assert own.startswith(f"pluto-fleet {__version__}, speaks seam ")
    assert own.endswith("extras: not installed: areas, crazyflie, mavlink, plot, station\n")

    fleet = ("--fleet", str(example / "fleet.toml"))
    flight = ("fly", str(example / "missions.toml"), *fleet, "--sim", "--speed", "50")
    journal = tmp_path / "one.journal"
    words = [str(program), *flight, "--journal", str(journal)]
    with subprocess.Popen(words, stdout=subprocess.PIPE, text=True) as flying:
        assert flying.stdout is not None
        flying.stdout.readline()
        flying.send_signal(signal.SIGINT)  # lands them all
        flying.stdout.read()
    resumed = told("resume", journal)
    assert resumed.code == 0, resumed.err
    assert "3 of 3 missions completed" in resumed.out

    looked = told("drones", *fleet)
    assert "uri" in looked.err + looked.out  # its drones are none that a radio reaches
    serve = ["serve", "--sim", "--port", "0", "--folder", str(tmp_path / "kept"), *fleet]
    with subprocess.Popen(
        [str(program), *serve], stdout=subprocess.PIPE, text=True, env={"PYTHONPATH": OURS}
    ) as serving:
        try:
            assert serving.stdout is not None
            address = serving.stdout.readline().removeprefix("station: ").strip()
            with urlopen(address) as page:
                assert page.status == 200
        finally:
            serving.send_signal(signal.SIGINT)
            serving.wait(timeout=30)


def test_a_package_that_carries_the_library_flies_alone(tmp_path: Path) -> None:
    """`compile --carry fleet`: one distribution, and all commands."""
    example = ROOT / "examples/drugs_distribution"
    package = tmp_path / "package"
    compiler: list[str | Path] = [sys.executable, "-m", "plutoc", "compile", example / "app.pluto"]
    succeed(*compiler, "--carry", "fleet", "-o", package, cwd=ROOT)
    programs = fresh(tmp_path / "venv")
    before = installed(programs)
    succeed(programs / "pip", "install", "--quiet", f"{package}[fleet]")
    there = installed(programs) - before
    assert "drugs-distribution" in there
    assert "pluto-fleet" not in there
    program = programs / "drugs_distribution"
    assert f"pluto-fleet {__version__}" in succeed(program, "--version")
    plan: list[str | Path] = [example / "missions.toml", "--fleet", example / "fleet.toml"]
    flown = run(program, "fly", *plan, "--sim", "--speed", "200", XDG_STATE_HOME=str(tmp_path))
    assert flown.code == 0, flown.err


def test_the_library_is_built_with_the_brain_as_it_is(library: Path) -> None:
    """What an app does not carry comes from that copy, byte for byte."""
    source = ROOT / "runtime/plutoc_runtime"
    ours = {
        path.relative_to(source).as_posix(): path.read_bytes()
        for path in source.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    inside = "pluto_fleet/shared/"
    with ZipFile(library) as wheel:
        names = [name for name in wheel.namelist() if name.startswith(inside)]
        assert {name.removeprefix(inside): wheel.read(name) for name in names} == ours


def test_the_compiler_alone_runs_apps_and_says_what_its_trials_need(tmp_path: Path) -> None:
    programs = fresh(tmp_path / "venv")
    succeed(programs / "pip", "install", "--quiet", ROOT)
    app = ROOT / "examples/drugs_distribution/app.pluto"
    assert "alone in the air" in succeed(programs / "plutoc", "run", app).splitlines()[-1]
    missing(run(programs / "plutoc", "test", app), "test")


def test_the_extra_names_the_version_that_the_tests_fly_with() -> None:
    """With its mends; another minor version may do otherwise."""
    for file in ("plutoc/emit/templates/pyproject.toml.jinja", "runtime/pyproject.toml"):
        assert 'crazyflie = ["cflib>=0.1.34,<0.2"]' in (ROOT / file).read_text(encoding="utf-8")
    major, minor, *mend = map(int, version("cflib").split(".")[:3])
    assert (major, minor) == (0, 1)
    assert mend >= [34]


def simulated(program: Path, example: Path) -> dict[str, Any]:
    """Return what `simulate --json` says of an example's own files."""
    outcome: dict[str, Any] = json.loads(succeed(program, "simulate", *plan_of(example), "--json"))
    return outcome


def own_tests_pass(programs: Path, package: Path) -> None:
    """Run the package's tests where nothing but it is installed, by the pytest of these tests."""
    found = run(programs / "python", "-c", "import pluto_fleet", PYTHONPATH=OURS)
    assert "No module named 'pluto_fleet'" in found.err
    words = ["-m", "pytest", "-q", "-p", "no:cacheprovider"]
    done = run(programs / "python", *words, cwd=package, PYTHONPATH=OURS)
    assert done.code == 0, done.out


def missing(done: Finished, command: str) -> None:
    """A command that needs the library says so in one line, and how to come by it."""
    assert (done.code, done.out) == (2, ""), done.err
    (line,) = done.err.splitlines()
    assert command in line
    assert "pluto-fleet" in line
    assert "pip install" in line


def installed(programs: Path) -> set[str]:
    """The names of what is installed."""
    listed = json.loads(succeed(programs / "pip", "list", "--format", "json"))
    return {entry["name"].lower().replace("_", "-") for entry in listed}
