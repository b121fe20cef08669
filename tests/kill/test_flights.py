"""Flights whose processes are killed, stopped and waited for: nothing is lost."""

from __future__ import annotations

import json
import os
import signal
import time
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.journal.place import gateway_folder
from pluto_fleet.journal.reader import Reader
from tests.kill.campaign import campaign
from tests.kill.conftest import NewFlight
from tests.kill.judge import done_by_the_world, events_of, folded
from tests.kill.lives import Flight, alive, eventually
from tests.kill.trial import gateway_of


def launched(flight: Flight) -> Flight:
    """Start it, and wait until a drone flies."""
    flight.start()
    flight.until_it_says("launched")
    return flight


def rows_of(flight: Flight) -> list[str]:
    if not flight.journal.exists():
        return []
    with closing(Reader(flight.journal)) as reader:
        return [row.text for row in reader.rows()]


def events(flight: Flight, kind: str) -> list[dict[str, Any]]:
    return [event for event in events_of(rows_of(flight)) if event["event"] == kind]


def completed(flight: Flight) -> bool:
    missions = folded(rows_of(flight)).missions.values()
    return [record["status"] for record in missions] == ["COMPLETED"] * 3


def no_process_is_left(flight: Flight) -> bool:
    return eventually(lambda: gateway_of(flight.journal) is None)


def drones_are_at(flight: Flight) -> list[list[float]]:
    drones = json.loads((gateway_folder(flight.journal) / "drones.json").read_text())["drones"]
    return [drone["leg"][1] for drone in drones.values()]


def test_a_flight_stopped_on_its_way_home_goes_on_where_it_was(new_flight: NewFlight) -> None:
    """All drones fly home and land; delays, attempts and results are there, and all completes."""
    flight = new_flight(10.0)
    flight.start()
    flight.until_it_says("fetch completed")
    said = flight.run("tell", str(flight.journal), "stop", "--rtl")
    assert (said.returncode, said.stderr) == (0, "")
    assert flight.see_through() == 130
    assert f"to go on: {flight.app} resume {flight.journal}" in flight.lives[0]
    assert all(y == 0.5 and z == 0.0 for _, y, z in drones_are_at(flight))
    assert no_process_is_left(flight)
    flight.start()
    assert flight.see_through() == 0
    assert completed(flight)
    assert {event["attempt"] for event in events(flight, "trip.launched")} == {1}
    assert set(done_by_the_world(flight.journal).values()) == {1}


@pytest.mark.long  # a whole flight; tests/library/flight/test_recovery.py has it in virtual time
def test_a_delay_keeps_its_rest_over_a_stop(new_flight: NewFlight) -> None:
    """A person who has waited for a part of it waits for the rest."""
    flight = new_flight(20.0)
    plan = flight.folder / "missions.toml"
    plan.write_text(plan.read_text().replace('delay = "4 s"', 'delay = "60 s"'))
    flight.start()
    assert eventually(lambda: bool(events(flight, "trip.delayed")))
    time.sleep(1.0)  # 20 s of the 60
    assert flight.run("tell", str(flight.journal), "stop").returncode == 0
    assert flight.see_through() == 130
    flight.start()
    assert flight.see_through() == 0
    delayed, _ = events(flight, "trip.delayed")  # and again, when it goes on
    (stopped,) = events(flight, "stopped")
    began = events(flight, "brain.began")[-1]
    allocated = next(e for e in events(flight, "trip.allocated") if e["trip"] == "look")
    rest = delayed["until"] - stopped["t"]
    assert allocated["t"] - began["t"] == pytest.approx(rest, abs=8)  # 0.4 s at this speed
    assert 0 < rest < 50


@pytest.mark.parametrize(("number", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_an_interrupt_waits_for_the_landing(
    number: signal.Signals, code: int, new_flight: NewFlight
) -> None:
    flight = launched(new_flight(20.0))
    flight.signal(number)
    assert flight.see_through() == code
    assert "stopping: the drones land where they are" in flight.lives[0]
    assert "all drones are down" in flight.lives[0]
    assert all(z == 0.0 for _, _, z in drones_are_at(flight))
    assert [event["how"] for event in events(flight, "stopped")] == ["land"]
    assert no_process_is_left(flight)


def test_interrupted_twice_it_leaves_at_once_and_the_gateway_lands(new_flight: NewFlight) -> None:
    flight = launched(new_flight(1.0))
    high_enough = time.monotonic() + 1.5  # to be still landing when it is told for the second time
    assert eventually(lambda: time.monotonic() > high_enough)
    flight.signal(signal.SIGINT)
    flight.until_it_says("once more to leave at once")
    flight.signal(signal.SIGINT)
    assert flight.see_through() == 130
    assert eventually(lambda: all(z == 0.0 for _, _, z in drones_are_at(flight)))


def test_a_supervised_app_that_is_killed_goes_on(new_flight: NewFlight) -> None:
    """And a Stop of the supervisor stops it."""
    flight = new_flight(10.0)
    flight.start("--supervise")
    flight.until_it_says("launched")
    lock = flight.journal.with_name(f"{flight.journal.name}.lock")
    first = int(lock.read_text())
    assert first != flight.pid
    os.kill(first, signal.SIGKILL)
    assert eventually(lambda: len(events(flight, "brain.began")) == 2)
    flight.signal(signal.SIGTERM)
    assert flight.see_through() == 143
    assert "was killed (SIGKILL): it is started again" in flight.lives[0]
    assert not alive(first)
    assert no_process_is_left(flight)
    flight.start("--supervise")
    assert flight.see_through() == 0
    assert completed(flight)


def test_a_stop_reaches_drones_whose_app_hangs(new_flight: NewFlight) -> None:
    """Past the app; and when that wakes up, it does not fly on."""
    flight = launched(new_flight(10.0))
    flight.signal(signal.SIGSTOP)
    said = flight.run("tell", str(flight.journal), "stop")
    assert said.returncode == 0
    assert "does not answer" in said.stdout
    assert eventually(lambda: all(z == 0.0 for _, _, z in drones_are_at(flight)))
    flight.signal(signal.SIGCONT)
    assert flight.see_through() == 130
    flight.start()
    assert flight.see_through() == 0
    assert completed(flight)


def test_a_stop_counts_although_the_gateway_dies_meanwhile(new_flight: NewFlight) -> None:
    """Another one is started, and brings the drones down."""
    flight = launched(new_flight(1.0))
    assert flight.run("tell", str(flight.journal), "stop", "--rtl").returncode == 0
    gateway = gateway_of(flight.journal)
    assert gateway is not None
    os.kill(gateway, signal.SIGKILL)
    assert flight.see_through() == 130
    assert "the gateway has ended" in flight.lives[0]
    assert all(z == 0.0 for _, _, z in drones_are_at(flight))
    assert no_process_is_left(flight)


def test_missions_are_paused_skipped_and_cancelled_while_they_fly(new_flight: NewFlight) -> None:
    flight = launched(new_flight(5.0))  # none shall have ended before they are paused

    def tell(*words: str) -> str:
        done = flight.run("tell", str(flight.journal), *words)
        assert done.returncode == 0, done.stderr
        return done.stdout

    assert tell("pause") == "3 missions: paused\n"  # however long the rest may take to be told
    assert tell("skip", "north", "look") == 'mission "north": trip "look" is skipped\n'
    assert tell("cancel", "east") == 'mission "east": cancelled\n'
    assert tell("go-on", "south") == 'mission "south": going on\n'
    assert tell("go-on") == 'mission "north": going on\n'
    refused = flight.run("tell", str(flight.journal), "pause", "west")
    assert refused.returncode == 2
    assert flight.see_through() == 1
    missions = folded(rows_of(flight)).missions
    assert {name: record["status"] for name, record in missions.items()} == {
        "north": "COMPLETED",
        "south": "COMPLETED",
        "east": "CANCELLED",
    }
    assert max(done_by_the_world(flight.journal).values()) == 1


def test_a_journal_that_is_deleted_in_flight_ends_it(new_flight: NewFlight) -> None:
    """As a full disk does: the drones land, it says why, and nothing names what is not there."""
    flight = launched(new_flight(5.0))
    flight.journal.unlink()
    assert flight.see_through() == 2
    assert f"{flight.journal}: it was deleted while the flight was being written" in flight.lives[0]
    assert "resume" not in flight.lives[0]
    assert all(z == 0.0 for _, _, z in drones_are_at(flight))
    assert no_process_is_left(flight)


@pytest.mark.long  # ten flights
def test_ten_kills_lose_nothing_and_let_nothing_be_done_twice(tmp_path: Path) -> None:
    """Eight brains and two gateways, at random moments."""
    tally = campaign(tmp_path, brains=8, gateways=2, seed=3, tell=lambda _: None)
    assert tally.problems == []
    assert (tally.brains.total(), tally.gateways.total()) == (8, 2)
    assert tally.actions > 0
