"""What all pages see of the drones while they are not flown: where they are, and who is lost."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable
from typing import Any

import pytest

from pluto_fleet.gateway.starting import cut_directly
from pluto_fleet.journal.place import gateway_folder
from tests.library.station.conftest import Serve
from tests.library.station.in_process import Flown

NEAR = 0.06
"""Metres: places are shown to the centimetre."""


def rows(station: Flown) -> list[dict[str, Any]]:
    drones: list[dict[str, Any]] = station.now()["drones"]
    return drones


def homes(station: Flown) -> dict[str, list[float]]:
    return {drone["id"]: drone["home"] for drone in station.get("/api/app")["drones"]}


def is_away_from_home(station: Flown) -> bool:
    """Whether some drone is well on its way."""
    at = homes(station)
    return any(
        row["x"] is not None and abs(row["x"] - at[row["id"]][0]) > 1 for row in rows(station)
    )


def lies(station: Flown) -> list[str]:
    """Return what of the drones' rows is not so in the world; what is said to be unknown is no lie."""
    found = []
    for row in rows(station):
        real = station.world.bodies[row["id"]]
        status, why = row["status"], "" if real.down is None else str(real.down)
        if row["x"] is not None and status != "UNKNOWN":
            x, y, _ = real.location
            if max(abs(row["x"] - x), abs(row["y"] - y)) > NEAR:
                found.append(f"{row} is at {x}, {y}")
        if status == "LOST" and row["why"] != why:
            found.append(f"{row}: really {why}")
        if why and status not in ("LOST", "UNKNOWN", "RECOVERING"):
            found.append(f"{row}: really {why}")
        if status in ("LANDED", "FREE", "CHARGING") and not real.landed:
            found.append(f"{row} is in the air")
    return found


def comes_true(station: Flown) -> None:
    station.until(lambda: not lies(station), "page and world agree")


def lands(station: Flown) -> None:
    station.tell("stop", how="land")
    station.comes_to("stopped")
    station.end()


def goes_home(station: Flown) -> None:
    station.tell("stop", how="rtl")
    station.comes_to("stopped")
    station.end()


def dies(station: Flown) -> None:
    station.kill()
    bodies = station.world.bodies.values()
    station.until(lambda: all(body.landed for body in bodies), "all are down")


def dies_with_its_gateway(station: Flown) -> None:
    station.kill()
    station.world.stop_gateway()


@pytest.mark.parametrize("ends", [lands, goes_home, dies, dies_with_its_gateway])
def test_after_each_end_drones_are_shown_where_they_lie_before_and_after_a_resume(
    serve: Serve, ends: Callable[[Flown], None]
) -> None:
    station = serve(speed=10.0)
    station.tell("start")
    station.until(lambda: is_away_from_home(station), "a drone is away")
    ends(station)
    station.start()
    at = homes(station)
    if ends is not dies_with_its_gateway:
        comes_true(station)
    seen = rows(station)
    if ends is not dies_with_its_gateway:
        assert {row["status"] for row in seen} == {"LANDED"}
        away = [row for row in seen if [row["x"], row["y"]] != at[row["id"]][:2]]
        assert bool(away) is (ends is not goes_home)
    assert all(row["seen_at"] for row in seen)
    assert {row["id"] for row in seen} == at.keys()
    station.tell("resume")
    station.comes_to("over")
    comes_true(station)
    station.end()
    station.start()
    assert station.phase == "over"
    comes_true(station)


def loses_one(station: Flown) -> str:
    """Cut the motors of a drone in flight, see the flight to its end, and say which one it was."""
    station.flying()
    who = str(station.events("trip.launched")[0]["drone"])
    station.tell("cut-motors", drone=who)
    station.comes_to("over")
    return who


def all_again(station: Flown) -> str:
    """Start every mission of the plan, what was completed included; return what is said."""
    return station.tell("start", missions=[*station.keys().values()])


def test_a_lost_drone_stays_lost_over_ends_restarts_and_starts_until_it_is_brought_back(
    serve: Serve,
) -> None:
    """Why and where is shown all the time; Start says that it leaves it out, and does."""
    station = serve()
    who = loses_one(station)
    before = station.drone(who)
    assert (before["status"], before["why"]) == ("LOST", f"{who}'s motors were cut")
    station.end()
    station.start()
    assert station.phase == "over"
    assert {**before, "seen_at": 0} == {**station.drone(who), "seen_at": 0}
    launched = len(station.events("trip.launched"))
    assert all_again(station) == f"3 missions started; without {who}, lost until brought back"
    station.comes_to("over")
    assert who not in [event["drone"] for event in station.events("trip.launched")[launched:]]
    assert {**before, "seen_at": 0, "trips": 0} == {**station.drone(who), "seen_at": 0}
    assert lies(station) == []
    assert station.refused("bring-back", drone="cf9").startswith('no drone "cf9" is in the')
    said = station.tell("bring-back", drone=who)
    assert said.startswith(f"{who} is brought back: it is asked")
    assert station.tell("bring-back", drone="cf4") == "cf4 is neither retired nor lost"
    back = station.drone(who)
    assert (back["status"], back["x"]) == ("UNKNOWN", None)  # a person has it in their hands
    assert all_again(station) == "3 missions started"
    well = ("FREE", "BUSY", "CHARGING")
    station.until(lambda: station.drone(who)["status"] in well, "it is well")


def test_a_drone_that_falls_with_the_gateway_alone_there_is_lost_with_its_reason_and_place(
    serve: Serve,
) -> None:
    """While no station runs, while one shows what its crash has broken off, and after that was put away."""
    station = serve(speed=3.0)
    station.tell("start")
    station.until(lambda: station.in_the_air(1.0), "a drone is in the air")
    first, second, third = (row["id"] for row in rows(station)[:3])
    folder = gateway_folder(station.journals()[-1])

    def cut(drone: str) -> None:
        station.world.run(asyncio.to_thread(cut_directly, folder, drone, 60.0))

    station.kill()
    cut(first)
    station.start()
    station.until(lambda: station.drone(first)["status"] == "LOST", "it is seen")
    comes_true(station)
    assert station.drone(first)["why"] == f"{first}'s motors were cut"
    station.tell("cut-motors", drone=second)
    station.until(lambda: station.drone(second)["status"] == "LOST", "it is seen")
    comes_true(station)
    cut(third)
    station.tell("discard")
    station.until(lambda: station.drone(third)["status"] == "LOST", "it is seen")
    comes_true(station)
    station.start()
    assert [row["id"] for row in rows(station) if row["status"] == "LOST"] == [first, second, third]
    assert station.tell("bring-back", drone=second).startswith(f"{second} is brought back")
    assert station.tell("start").endswith(f"without {first}, {third}, lost until brought back")


def test_who_is_lost_is_remembered_without_journals_and_with_no_drone_left_nothing_flies(
    serve: Serve,
) -> None:
    station = serve()
    who = loses_one(station)
    station.end()
    (journal,) = station.journals()
    journal.rename(station.folder.parent / journal.name)
    station.start()
    assert station.phase == "idle"
    lost = [(row["id"], row["why"]) for row in rows(station) if row["status"] == "LOST"]
    assert lost == [(who, f"{who}'s motors were cut")]
    kept = station.folder / "station" / "drones.json"
    data = json.loads(kept.read_text())
    for row in rows(station):
        data["drones"]["lost"].setdefault(row["id"], {"reason": "it fell", "at": None})
    kept.write_text(json.dumps(data))
    station.start()
    assert "every drone is lost: look after one" in station.refused("start")
    assert station.journals() == []
