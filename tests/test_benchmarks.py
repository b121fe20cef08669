"""What is measured can be measured, and what a command has no use for it does not load."""

from __future__ import annotations

import json
import re

import pytest

from tests.kit.command import python
from tests.paths import ROOT

pytestmark = [pytest.mark.long, pytest.mark.process]


def measured(script: str, *words: str) -> str:
    """Run a script of benchmarks/ in small, and return what it prints."""
    ran = python(ROOT / "benchmarks" / script, *words)
    assert ran.code == 0, ran.err
    return ran.out


@pytest.mark.parametrize("flag", ["--version", "--help"])
def test_the_version_and_the_help_do_not_wait_for_the_compiler(flag: str) -> None:
    """No tool of the compiler is loaded, nor the compiler itself."""
    code = (
        "import sys; before = set(sys.modules); from plutoc.cli import main; main(sys.argv[1:]);"
        "print(*(set(sys.modules) - before))"
    )
    loaded = python("-c", code, flag).out.splitlines()[-1].split()
    heavy = {"jinja2", "black", "asyncio", "lark", "networkx", "plutoc.compile"}
    assert not heavy.intersection(loaded)


def test_the_cold_start_is_measured() -> None:
    """Every command gets a line, and the sample apps are what they are meant to be."""
    said = measured("cold_start.py", "--rounds", "1")
    lines = {line[:24].strip(): line for line in said.splitlines()[1:]}
    assert "lark" not in lines["--help"]
    for name in ("check", "check, with a hooks.py", "check, with a warning"):
        assert "lark" in lines[name]
        assert "black" not in lines[name]


def test_large_apps_are_measured() -> None:
    """Here with few blocks: every shape is an app that passes."""
    said = measured("large_apps.py", "--sizes", "12", "24", "--rounds", "1").splitlines()[1:]
    assert [line.split()[0] for line in said] == ["chain", "wide", "forks"]


def test_compiling_is_measured() -> None:
    """Here with few blocks, and once."""
    few = ("--sizes", "12", "24", "--rounds", "1", "--large-rounds", "1", "--json")
    found = json.loads(measured("compile.py", *few))
    for name in ("cold", "edit", "unchanged", "growth_10k"):
        assert found[name] > 0
    assert set(found["raw"]) >= {"python -c pass", "cold", "edit", "unchanged", "wide 24"}
    assert all(least["least_s"] <= least["median_s"] for least in found["raw"].values())


def test_the_choice_of_drones_is_measured() -> None:
    """Here in small: every policy chooses, shares out and empties a queue."""
    few = ["--rounds", "1", "--fleets", "5", "30", "--shares", "3x2", "--plans", "2", "15"]
    told = json.loads(measured("choosing.py", *few, "--json"))
    policies = (
        *("first", "least_used", "nearest", "batch_optimal"),
        *("least_makespan", "nearest, charging"),
    )
    assert list(told["queue_s"]) == [f"{name} {size}" for name in policies for size in (2, 15)]
    assert len(told["choice_us"]) == 6
    assert list(told["share_ms"]) == ["3 x 2"]


def test_makespans_are_measured_by_policy() -> None:
    """Here of one plan, without a solver: the defaults are nowhere near `nearest` and `home`."""
    few = ["--plans", "1", "--seconds", "0", "--json"]
    told = json.loads(measured("allocation.py", *few))
    assert list(told["makespans_s"]) == ["1 few drones"]
    defaults, nearest = told["ratios"]["defaults"], told["ratios"]["nearest, home"]
    assert 1.0 <= defaults["median"] <= defaults["worst"] < 1.5 < nearest["median"]
    assert told["ratios"]["defaults"] == told["ratios"]["least_makespan, next"]


def test_simulations_are_measured() -> None:
    """Here in small, beside a bare loop that flies as many trips."""
    few = ["--rounds", "1", "--fleets", "2", "3", "--trips", "5", "10"]
    # its exit code says whether it grows too fast: so little tells nothing of that
    told = json.loads(python(ROOT / "benchmarks" / "simulate.py", *few, "--json").out)
    assert {"apart = 0", "apart = 0.5", "bare loop"} <= told["start_s"].keys()
    sizes = [
        "10 trips, 2 drones",
        "10 trips, 3 drones",
        "5 trips, 20 drones",
        "10 trips, 20 drones",
    ]
    assert list(told["net_s"]) == sizes
    assert {"2 to 3 drones, apart = 0", "5 to 10 trips, bare loop"} <= told["exponents"].keys()


def test_the_house_is_measured() -> None:
    """Each package has its line, and so have the rings."""
    sizes, *rings = measured("house.py").split("\n\n")
    named = {line.split()[0] for line in sizes.splitlines()[1:]}
    assert {"plutoc", "runtime/plutoc_runtime", "runtime/pluto_fleet", "tests"} <= named
    titles = [ring.partition(":")[0] for ring in rings]
    assert titles == ["rings between rooms", "rings between files"]


def test_the_path_of_a_trip_is_measured() -> None:
    """It leads through more files where a gateway keeps drones apart."""
    said = measured("trip_path.py")
    counted = re.findall(r"files (\d+), moves (\d+) until ([a-z.]+)", said)
    assert [end for _, _, end in counted] == ["mission.ended", "drone.free"] * 2
    alone, *_, together = (int(files) for files, _, _ in counted)
    assert 5 < alone < together


def test_pursuit_is_measured() -> None:
    """Here of one flight: each pair has its row, and no rule is broken."""
    few = ["--drones", "5", "--people", "2", "--seeds", "1", "--json"]
    (cell,) = json.loads(measured("pursuit.py", *few))["cells"]
    assert (cell["drones"], cell["people"]) == (5, 2)
    assert 0.0 < cell["seen"] <= 1.0
    assert cell["seconds"]["median"] > 0.0


def test_a_survey_takes_no_more_than_a_planner_says() -> None:
    """Neither photos nor metres, and each way is flown to its end; else the script ends with 1."""
    assert measured("survey.py").splitlines()[1].startswith("QGroundControl")
