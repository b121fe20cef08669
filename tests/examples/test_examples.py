"""The examples compile, fly to their end, and keep the invariants no matter what goes wrong."""

from __future__ import annotations

import json
import re
import tomllib
from functools import partial
from xml.etree import ElementTree

import pytest

from pluto_fleet.cli import main as fleet_main
from pluto_fleet.trials.invariants import violations
from plutoc.cli import main
from tests.kit import apps
from tests.kit.apps import EXAMPLES, MISHAPS, NAMES, Example
from tests.kit.command import run

FEW_OR_MANY = pytest.mark.parametrize(
    "seeds",
    [range(3), pytest.param(range(3, 20), marks=pytest.mark.long)],
    ids=["few seeds", "many seeds"],
)


@pytest.fixture(params=NAMES)
def example(request: pytest.FixtureRequest) -> Example:
    """Return an example, compiled and imported."""
    return apps.example(request.param)


LEAST = 0.1
"""Half of the usual reserve: waiting for others on the way takes no more."""

WARNED = {
    "drugs_distribution": ["P2055"],
    "warehouse_item_finder": ["P2055"],
}
"""The basic graph of the thesis retries nothing; its examples say so. The others have no warning."""


def test_every_app_of_the_thesis_is_there() -> None:
    """The applications of the thesis's chapter 6, and a night round."""
    assert NAMES == [
        "aerial_mapping",
        "alfalfa",
        "drugs_distribution",
        "drugs_distribution_retry",
        "drugs_distribution_timer",
        "night_round",
        "object_finder",
        "pm10",
        "pursue",
        "warehouse_item_finder",
    ]


@pytest.mark.parametrize("name", NAMES)
def test_examples_warn_of_nothing_unexpected(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    """`plutoc check` accepts every example, with the warnings that its README mentions."""
    assert main(["check", "--format", "json", str(EXAMPLES / name / "app.pluto")]) == 0
    codes = [json.loads(line)["code"] for line in capsys.readouterr().out.splitlines()]
    assert codes == WARNED.get(name, [])


@pytest.mark.parametrize("name", NAMES)
def test_folders_are_whole(name: str) -> None:
    """Every example has its files, and its app is named like its folder."""
    folder = EXAMPLES / name
    for file in ("missions.toml", "fleet.toml", "README.md", "map.svg"):
        assert (folder / file).is_file()
    assert f"app {name} " in (folder / "app.pluto").read_text(encoding="utf-8")
    fleet = tomllib.loads((folder / "fleet.toml").read_text(encoding="utf-8"))
    assert (folder / fleet["map"]["image"]).is_file()


@pytest.mark.parametrize("name", NAMES)
def test_floor_plan_is_as_large_as_the_map(name: str) -> None:
    """A metre is a unit of the picture, so that drawing on it needs no scale."""
    folder = EXAMPLES / name
    fleet = tomllib.loads((folder / "fleet.toml").read_text(encoding="utf-8"))
    picture = ElementTree.parse(folder / "map.svg").getroot()
    assert [float(n) for n in picture.attrib["viewBox"].split()] == [0, 0, *fleet["map"]["size"]]


@FEW_OR_MANY
def test_examples_complete_when_nothing_goes_wrong(example: Example, seeds: range) -> None:
    """Every mission of every example is completed, for any seed, within its battery limits."""
    for seed in seeds:
        flown = example.fly(seed)
        assert {status for status, _ in flown.ends} == {"COMPLETED"}, f"seed {seed}"
        assert violations(flown.trace, example.items) == [], f"seed {seed}"
        # Who has waited for others on its way lands with a part of its reserve, and charges at once.
        low = [event for event in flown.trace if event["event"] == "drone.charging"]
        assert all(float(str(event["battery"])) >= LEAST for event in low), f"seed {seed}"


@FEW_OR_MANY
def test_examples_end_no_matter_what_goes_wrong(example: Example, seeds: range) -> None:
    """With crashes, lost links and failed actions every mission still ends, and says why."""
    for seed in seeds:
        flown = example.fly(seed, MISHAPS)
        for status, reason in flown.ends:
            assert status == "COMPLETED" or (status == "FAILED" and reason), f"seed {seed}"
        assert violations(flown.trace, example.items) == [], f"seed {seed}"


def test_command_line_completes(example: Example, monkeypatch: pytest.MonkeyPatch) -> None:
    """`simulate missions.toml --fleet fleet.toml`, as a person types it, ends with 0."""
    monkeypatch.chdir(EXAMPLES / example.name)
    words = ("simulate", "missions.toml", "--fleet", "fleet.toml")
    ran = run(partial(fleet_main, example.app), *words)
    assert ran.code == 0, ran.out + ran.err
    completed = re.search(r"(\d+) of (\d+) missions completed", ran.out)
    assert completed is not None
    assert completed[1] == completed[2]  # events make some of them
    assert int(completed[1]) >= len(example.missions)
