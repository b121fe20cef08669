"""What all pages see of the drones while they are not flown: where they are, and who is lost."""

from __future__ import annotations

import json
import os
import signal
import subprocess
from collections.abc import Callable
from contextlib import closing
from typing import Any

import pytest

from pluto_fleet.gateway.starting import cut_directly, still_runs
from pluto_fleet.journal.place import gateway_folder
from pluto_fleet.journal.reader import Reader
from tests.kit.station import PATIENCE, Station, until
from tests.library.station.flights.conftest import Serve
from tests.library.station.flights.test_flights import comes_to, events, flying, refused, tell
from tests.library.station.world import disagreements, truth


def rows(station: Station) -> list[dict[str, Any]]:
    drones: list[dict[str, Any]] = station.now()["drones"]
    return drones


def gateway(station: Station) -> int | None:
    return still_runs(gateway_folder(station.journals()[-1]))


def is_away_from_home(station: Station) -> bool:
    """Whether some drone is well on its way."""
    homes = {drone["id"]: drone["home"] for drone in station.get("/api/app")["drones"]}
    return any(
        row["x"] is not None and abs(row["x"] - homes[row["id"]][0]) > 1 for row in rows(station)
    )


def is_home(station: Station, row: dict[str, Any]) -> bool:
    homes = {drone["id"]: drone["home"] for drone in station.get("/api/app")["drones"]}
    return bool([row["x"], row["y"]] == homes[row["id"]][:2])


def agrees(station: Station) -> bool:
    """Whether all pages are shown the world as it is."""
    return disagreements(rows(station), truth(station, station.folder / "scratch")) == []


def ends_by_a_stop_to_land(station: Station) -> None:
    tell(station, "stop", how="land")
    comes_to(station, "stopped")
    station.end()


def ends_by_a_stop_home(station: Station) -> None:
    tell(station, "stop", how="rtl")
    comes_to(station, "stopped")
    station.end()


def is_killed(station: Station) -> None:
    station.kill()
    scratch = station.folder / "scratch"
    until(lambda: all(one.landed for one in truth(station, scratch).values()), "all are down")


def is_killed_with_its_gateway(station: Station) -> None:
    process = gateway(station)
    station.kill()
    assert process is not None
    os.kill(process, signal.SIGKILL)


@pytest.mark.parametrize(
    "ends",
    [ends_by_a_stop_to_land, ends_by_a_stop_home, is_killed, is_killed_with_its_gateway],
)
def test_after_each_end_drones_are_shown_where_they_lie_before_and_after_a_resume(
    serve: Serve, ends: Callable[[Station], None]
) -> None:
    station = serve("drugs_distribution", "--speed", "60")
    tell(station, "start")
    until(lambda: is_away_from_home(station), "a drone is away")
    ends(station)
    station.start()
    until(lambda: agrees(station), "page and world agree")
    world, seen = truth(station, station.folder / "scratch"), rows(station)
    if ends is not is_killed_with_its_gateway:
        assert {row["status"] for row in seen} == {"LANDED"}
        assert any(not is_home(station, row) for row in seen) is (ends is not ends_by_a_stop_home)
    assert all(row["seen_at"] for row in seen)
    assert world.keys() == {row["id"] for row in seen}
    tell(station, "resume")
    comes_to(station, "over")
    until(lambda: agrees(station), "page and world agree")
    station.end()
    station.start()
    assert station.phase == "over"
    until(lambda: agrees(station), "page and world agree")


def loses_one(station: Station) -> str:
    """Cut the motors of a drone in flight, see the flight to its end, and say which one it was."""
    flying(station)
    who = str(events(station, "trip.launched")[0]["drone"])
    tell(station, "cut-motors", drone=who)
    comes_to(station, "over")
    return who


def test_a_lost_drone_stays_lost_over_ends_restarts_and_starts_until_it_is_brought_back(
    serve: Serve,
) -> None:
    """Why and where is shown all the time; Start says that it leaves it out, and does."""
    station = serve("drugs_distribution", "--speed", "60")
    who = loses_one(station)
    before = next(row for row in rows(station) if row["id"] == who)
    assert (before["status"], before["why"]) == ("LOST", f"{who}'s motors were cut")
    for end in (station.kill, station.end):
        end()
        station.start()
        assert station.phase == "over"
        assert {**before, "seen_at": 0} == {**found(station, who), "seen_at": 0}
    assert all_again(station) == f"3 missions started; without {who}, lost until brought back"
    comes_to(station, "over")
    assert who not in [event["drone"] for event in events_of_newest(station, "trip.launched")]
    assert {**before, "seen_at": 0, "trips": 0} == {**found(station, who), "seen_at": 0}
    assert agrees(station)
    assert refused(station, "bring-back", drone="cf9")[1].startswith('no drone "cf9" is in the')
    assert tell(station, "bring-back", drone=who).startswith(f"{who} is brought back: it is asked")
    back = found(station, who)
    assert (back["status"], back["x"]) == ("UNKNOWN", None)  # a person has it in their hands
    assert all_again(station) == "3 missions started"
    until(lambda: found(station, who)["status"] in ("FREE", "BUSY", "CHARGING"), "it is well")
    comes_to(station, "over")


def test_a_drone_that_is_dropped_while_no_app_flies_it_is_lost_as_well(serve: Serve) -> None:
    """The gateway brings all down after a crash of the station, and the motors of one are cut."""
    station = serve("drugs_distribution", "--speed", "1")
    tell(station, "start")
    until(lambda: any(row["z"] > 1 for row in rows(station)), "a drone is in the air")
    station.kill()
    station.start()
    who = next(row["id"] for row in rows(station) if row["z"] > 0.5)
    tell(station, "cut-motors", drone=who)
    until(lambda: found(station, who)["status"] == "LOST", "it is seen")
    until(lambda: agrees(station), "page and world agree")
    tell(station, "discard")
    assert tell(station, "start").endswith(f"without {who}, lost until brought back")


def test_a_drone_that_falls_with_the_gateway_alone_there_is_lost_with_its_reason_and_place(
    serve: Serve,
) -> None:
    """While no station runs, and after the flight was put away."""
    station = serve("drugs_distribution", "--speed", "1")
    tell(station, "start")
    until(lambda: any(row["z"] > 1 for row in rows(station)), "a drone is in the air")
    first, second = (row["id"] for row in rows(station)[:2])
    station.kill()
    folder = gateway_folder(station.journals()[-1])
    cut_directly(folder, first, PATIENCE)
    station.start()
    until(lambda: found(station, first)["status"] == "LOST", "it is seen")
    until(lambda: agrees(station), "page and world agree")
    assert found(station, first)["why"] == f"{first}'s motors were cut"
    cut_directly(folder, second, PATIENCE)
    tell(station, "discard")
    until(lambda: found(station, second)["status"] == "LOST", "it is seen")
    until(lambda: agrees(station), "page and world agree")
    station.end()
    station.start()
    assert [row["id"] for row in rows(station) if row["status"] == "LOST"] == [first, second]
    assert tell(station, "bring-back", drone=second).startswith(f"{second} is brought back")
    assert tell(station, "start").endswith(f"without {first}, lost until brought back")


def test_a_drone_that_has_lost_its_link_when_the_app_dies_is_said_to_be_unknown_and_why(
    serve: Serve,
) -> None:
    station = serve("drugs_distribution", "--speed", "10", "--fail", "link=1.0")
    tell(station, "start")
    until(
        lambda: any(row["status"] == "RECOVERING" for row in rows(station)), "one has lost its link"
    )
    who = next(row["id"] for row in rows(station) if row["status"] == "RECOVERING")
    station.kill()
    station.start()
    until(lambda: agrees(station), "page and world agree")
    row = found(station, who)
    assert (row["status"], row["why"][:17]) == ("UNKNOWN", f"{who} lost its link")
    assert row["x"] is not None


def test_who_is_lost_is_remembered_without_journals_and_with_no_drone_left_nothing_flies(
    serve: Serve,
) -> None:
    station = serve("drugs_distribution", "--speed", "60")
    who = loses_one(station)
    station.end()
    (journal,) = station.journals()
    journal.rename(station.folder.parent / journal.name)
    station.start()
    assert station.phase == "idle"
    assert [(row["id"], row["why"]) for row in rows(station) if row["status"] == "LOST"] == [
        (who, f"{who}'s motors were cut")
    ]
    kept = station.folder / "station" / "drones.json"
    data = json.loads(kept.read_text())
    for row in rows(station):
        data["drones"]["lost"].setdefault(row["id"], {"reason": "it fell", "at": None})
    station.end()
    kept.write_text(json.dumps(data))
    station.start()
    assert "every drone is lost: look after one" in refused(station, "start")[1]
    assert station.journals() == []


def test_a_lost_drone_is_brought_back_by_command_while_nothing_flies(serve: Serve) -> None:
    station = serve("drugs_distribution", "--speed", "60")
    who = loses_one(station)
    (journal,) = station.journals()
    app = [str(station.app.program), "tell", str(journal), "bring-back"]
    said = subprocess.run([*app, who], capture_output=True, text=True, check=True).stdout
    assert said.startswith(f"{who} is brought back")
    until(lambda: found(station, who)["status"] == "UNKNOWN", "all pages see it")
    other = subprocess.run([*app, "cf9"], capture_output=True, text=True, check=True).stdout
    assert other == "cf9 is neither retired nor lost\n"
    assert all_again(station) == "3 missions started"
    until(lambda: found(station, who)["status"] in ("FREE", "BUSY", "CHARGING"), "it is well")


@pytest.mark.long  # they fly in real time: half a minute
def test_simulated_crazyflies_begin_the_next_flight_where_the_last_one_has_left_them(
    serve: Serve,
) -> None:
    pytest.importorskip("cflib")
    station = serve("drugs_distribution", "--crtp-sim", "2")
    tell(station, "start")
    until(lambda: is_away_from_home(station), "a drone is away")
    tell(station, "stop", how="land")
    comes_to(station, "stopped")
    before = {row["id"]: (row["x"], row["y"]) for row in rows(station)}
    tell(station, "discard")
    tell(station, "start")
    until(lambda: station.now()["missions"] != [], "the drones have been asked where they are")
    for row in rows(station):
        assert (row["x"], row["y"]) == pytest.approx(before[row["id"]], abs=0.3)


def all_again(station: Station) -> str:
    """Start every mission of the plan, what was completed included; return what is said."""
    keys = [mission["key"] for mission in station.get("/api/plan")["missions"]]
    return tell(station, "start", missions=keys)


def found(station: Station, drone: str) -> dict[str, Any]:
    return next(row for row in rows(station) if row["id"] == drone)


def events_of_newest(station: Station, kind: str) -> list[dict[str, Any]]:
    with closing(Reader(station.journals()[-1])) as reader:
        found = [event for row in reader.rows() for event in json.loads(row.text)]
    return [event for event in found if event["event"] == kind]
