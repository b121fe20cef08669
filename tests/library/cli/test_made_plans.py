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


def test_check_tells_what_each_area_has_become(plan: Path, command: Command) -> None:
    code, out, _ = command("check", plan)
    assert code == 0
    assert out.split("\n") == [
        'mission "Bed 1" (beds.csv, row 2), area 1: 1 trip, 0 m from the first to the last',
        'mission "Bed 2" (beds.csv, row 3), area 1: 2 trips, 2 m from the first to the last',
        "2 missions with 5 trips: a fleet of 5 drones can fly them",
        "",
    ]


def test_of_very_many_areas_the_first_are_told(plan: Path, command: Command) -> None:
    rows = "".join(f"{n},7\n" for n in range(60))
    plan.with_name("beds.csv").write_text(f"nr,x\n{rows}", encoding="utf-8")
    *told, more, last, end = command("check", plan)[1].split("\n")
    assert (len(told), more, end) == (50, "… and 10 more areas", "")
    assert last.startswith("60 missions with 120 trips")


def test_check_writes_plain_missions(plan: Path, tmp_path: Path, command: Command) -> None:
    """Into a new file, which needs no list and no shapely; never over another one."""
    plain = tmp_path / "plain.toml"
    assert command("check", plan, "--write", plain)[0] == 0
    text = plain.read_text(encoding="utf-8")
    assert "each" not in text
    assert "area]]" not in text
    assert text.count("[[mission]]") == 2
    assert text.count("[[mission.trip]]") == 5
    plan.with_name("beds.csv").unlink()
    assert command("check", plain)[:2] == (
        0,
        "2 missions with 5 trips: a fleet of 5 drones can fly them\n",
    )
    code, _, said = command("check", plain, "--write", plain)
    assert (code, said) == (2, f"{plain}: it is there already, and is not replaced\n")
    code, _, said = command("check", plain, "--write", tmp_path / "no" / "p.toml")
    assert (code, said) == (
        2,
        f"{tmp_path}/no/p.toml: the missions cannot be written: No such file or directory\n",
    )


def test_a_simulation_flies_plain_trips(plan: Path, command: Command) -> None:
    code, out, _ = command("simulate", plan, "--json")
    assert code == 0
    missions = json.loads(out)["missions"]
    assert [one["name"] for one in missions] == ["Bed 1", "Bed 2"]
    assert missions[1]["completed_trips"] == ["1", "area 1.1", "area 1.2"]


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


def test_it_is_said_on_the_console_and_in_the_trace(
    spot: Path, tmp_path: Path, command: Command
) -> None:
    trace = tmp_path / "trace"
    _, out, _ = command("simulate", spot, "--trace", trace)
    assert out.count("another drone is at its place (cf") == 2
    events = [json.loads(line) for line in trace.read_text(encoding="utf-8").splitlines()]
    order = [event["event"] for event in events if event.get("mission") == "3"]
    assert order[-4:] == ["trip.launched", "trip.beside", "trip.completed", "mission.ended"]


def test_a_dry_run_commands_just_that(spot: Path, command: Command) -> None:
    """All three are there at once."""
    code, out, _ = command("fly", spot, "--dry-run", "--sim")
    assert code == 0
    acts = [line.split() for line in out.splitlines() if "measure" in line]
    times = [float(words[0]) for words in acts]
    assert len(times) == 3
    assert max(times) <= 1.25 * min(times)


def test_a_flight_writes_it_into_its_journal(spot: Path, tmp_path: Path, command: Command) -> None:
    """As it says it."""
    journal = tmp_path / "j"
    code, out, _ = command("fly", spot, "--sim", "--speed", "1000", "--journal", journal)
    assert code == 0
    assert out.count("another drone is at its place (cf") == 2
    read = command("journal", journal)[1]
    assert read.count("another drone is at its place (cf") == 2
    told = [
        event
        for line in command("journal", journal, "--json")[1].splitlines()
        if (event := json.loads(line))["event"] == "trip.beside"
    ]
    assert [one["mission"] for one in told] == ["2", "3"]


def test_what_changes_something_is_done_just_there(spot: Path, command: Command) -> None:
    """One after the other, as an action of the app's own that is not safe to do once more."""
    own = SPOT.replace('"measure"', '"pollinate"') + 'parameters = { dose = "40 mg" }\n'
    spot.write_text(own, encoding="utf-8")
    fleet = spot.with_name("fleet.toml")
    fleet.write_text(FLEET.replace("scout", "carrier"), encoding="utf-8")
    found = json.loads(command("simulate", spot, "--json", "--no-spread")[1])
    assert {one["status"] for one in found["missions"]} == {"COMPLETED"}
    assert "beside" not in found


def test_a_plan_with_names_of_places_is_kept_without_them(tmp_path: Path, command: Command) -> None:
    """What is written, as a journal is, needs no map to be read again."""
    (tmp_path / "fleet.toml").write_text(
        '[[map.places]]\nname = "Bed 3"\nat = [2.5, 8]\n'
        '[[drone]]\nid = "a"\ncategory = "scout"\nhome = [1, 1]\n',
        encoding="utf-8",
    )
    file, plain = tmp_path / "m.toml", tmp_path / "other" / "plain.toml"
    file.write_text(
        '[[mission]]\n[[mission.trip]]\naction = "measure"\ntarget = "Bed 3"\n', encoding="utf-8"
    )
    plain.parent.mkdir()
    assert command("check", file, "--write", plain)[0] == 0
    assert "target = [2.5, 8.0, 1.2]" in plain.read_text(encoding="utf-8")
    assert command("check", plain)[0] == 0
