"""Plans whose missions and trips are made, of lists and areas: what commands say and keep of them."""

from __future__ import annotations

import json
from contextlib import closing
from pathlib import Path

import pytest

from pluto_fleet.flight.lives import reopen
from pluto_fleet.journal.store import Store
from tests.library.cli.conftest import Command
from tests.library.files.an_app import APP

PLAN = """
[[mission]]
name = "Bed {nr}"
each = "beds.csv"
[[mission.trip]]
action = "measure"
target = ["{x}", 1]
[[mission.area]]
polygon = [["{x}", 2], ["{x}", 4], [9, 4], [9, 2]]
action = "take_photo"
spacing = 2
"""


@pytest.fixture
def plan(tmp_path: Path) -> Path:
    """A file with a list of two beds beside it."""
    (tmp_path / "beds.csv").write_text("nr,x\n1,7\n2,5\n", encoding="utf-8")
    file = tmp_path / "m.toml"
    file.write_text(PLAN, encoding="utf-8")
    return file


def test_of_very_many_areas_the_first_are_told(plan: Path, command: Command) -> None:
    rows = "".join(f"{n},7\n" for n in range(60))
    plan.with_name("beds.csv").write_text(f"nr,x\n{rows}", encoding="utf-8")
    *told, more, last, end = command("check", plan)[1].split("\n")
    assert (len(told), more, end) == (50, "… and 10 more areas", "")
    assert last.startswith("60 missions with 120 trips")


@pytest.mark.long
@pytest.mark.process
def test_a_journal_keeps_plain_missions(plan: Path, tmp_path: Path, command: Command) -> None:
    """It is resumed where the list is gone, and from before the first mission has begun."""
    journal = tmp_path / "j"
    assert command("fly", plan, "--sim", "--speed", "1000", "--journal", journal)[0] == 0
    plan.with_name("beds.csv").unlink()
    with closing(Store.open(journal)) as store:
        header = store.header
    assert "each" not in str(header["missions"])
    again = tmp_path / "again"
    Store.create(again, header).close()
    with closing(reopen(APP, again).store) as store:
        assert store.header["missions"] == header["missions"]
    taken = reopen(APP, again)
    taken.store.close()
    assert [len(mission.trips) for mission in taken.planned] == [2, 3]


SPOT = """
[[mission]]
name = "{n}"
each = "three.csv"
[[mission.trip]]
action = "measure"
target = [4, 4]
"""
FLEET = "".join(
    f'[[drone]]\nid = "cf{n}"\ncategory = "scout"\nhome = [{n + 1}.5, 1]\n' for n in (1, 2, 3)
)


@pytest.fixture
def spot(tmp_path: Path) -> Path:
    """Three missions at one spot, and three drones."""
    (tmp_path / "three.csv").write_text("n\n1\n2\n3\n", encoding="utf-8")
    (tmp_path / "fleet.toml").write_text(FLEET, encoding="utf-8")
    file = tmp_path / "m.toml"
    file.write_text(SPOT, encoding="utf-8")
    return file


def test_missions_at_one_spot_fly_at_the_same_time(spot: Path, command: Command) -> None:
    """A simulation says of each where it was done, if that was not at its target."""
    three = json.loads(command("simulate", spot, "--json", "--no-spread")[1])
    spot.with_name("three.csv").write_text("n\n1\n", encoding="utf-8")
    one = json.loads(command("simulate", spot, "--json", "--no-spread")[1])
    assert three["duration_s"] <= 1.25 * one["duration_s"]
    assert "beside" not in one
    assert [told["mission"] for told in three["beside"]] == ["2", "3"]
    for told in three["beside"]:
        assert set(told) == {"t", "mission", "trip", "drone", "round", "attempt", "target", "at"}
        assert told["target"] == [4, 4, 1.2]
        assert told["at"] != told["target"]


def test_what_changes_something_is_done_just_there(spot: Path, command: Command) -> None:
    """One after the other, as an action of the app's own that is not safe to do once more."""
    own = SPOT.replace('"measure"', '"pollinate"') + 'parameters = { dose = "40 mg" }\n'
    spot.write_text(own, encoding="utf-8")
    fleet = spot.with_name("fleet.toml")
    fleet.write_text(FLEET.replace("scout", "carrier"), encoding="utf-8")
    found = json.loads(command("simulate", spot, "--json", "--no-spread")[1])
    assert {one["status"] for one in found["missions"]} == {"COMPLETED"}
    assert "beside" not in found
