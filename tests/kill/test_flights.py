"""Flights of real processes that are killed, stopped and waited for: nothing is lost.

`python -m tests.kill --brain 500 --gateway 100` kills many more.
"""

from __future__ import annotations

import json
import os
import signal
from contextlib import closing
from pathlib import Path
from random import Random
from typing import Any

import pytest

from pluto_fleet.journal.place import gateway_folder
from pluto_fleet.journal.reader import Reader, standing_of
from tests.kill.conftest import NewFlight
from tests.kill.judge import events_of
from tests.kill.lives import Flight, alive, eventually
from tests.kill.painter import painted
from tests.kill.plans import Plan
from tests.kill.trial import Tally, Trial, gateway_of


def launched(flight: Flight) -> Flight:
    """Start it, and wait until a drone flies."""
    flight.start()
    flight.until_it_says("launched")
    return flight


def rows_of(flight: Flight) -> list[str]:
    with closing(Reader(flight.journal)) as reader:
        return [instant.text for instant in reader.instants()]


def events(flight: Flight, kind: str) -> list[dict[str, Any]]:
    return [event for event in events_of(rows_of(flight)) if event["event"] == kind]


def statuses(flight: Flight) -> list[str]:
    return [record["status"] for record in standing_of(flight.journal).missions.values()]


def drones_are_at(flight: Flight) -> list[list[float]]:
    drones = json.loads((gateway_folder(flight.journal) / "drones.json").read_text())["drones"]
    return [drone["leg"][1] for drone in drones.values()]


def all_are_down(flight: Flight) -> bool:
    return all(z == 0.0 for _, _, z in drones_are_at(flight))


def no_process_is_left(flight: Flight) -> bool:
    return eventually(lambda: gateway_of(flight.journal) is None)


@pytest.mark.process
@pytest.mark.parametrize("victim", ["brain", "gateway"])
def test_a_kill_loses_nothing_and_lets_nothing_be_done_twice(
    victim: str, new_flight: NewFlight, plan: Plan
) -> None:
    tally = Tally()
    trial = Trial(
        plan=plan,
        flight=new_flight(10.0),
        random=Random("in flight"),
        victims=[victim],
        tally=tally,
        early=0.0,
    )
    assert trial.run() == []
    assert tally.brains.total() == (victim == "brain")
    assert tally.gateways.total() == (victim == "gateway")
    assert tally.ends == {"COMPLETED": 3} and tally.actions == 6


@pytest.mark.long
def test_a_supervised_app_that_is_killed_goes_on(new_flight: NewFlight) -> None:
    """And a Stop of the supervisor stops it, once all drones are down."""
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
    assert "all drones are down" in flight.lives[0] and all_are_down(flight)
    assert not alive(first) and no_process_is_left(flight)
    flight.start("--supervise")
    assert flight.see_through() == 0
    assert statuses(flight) == ["COMPLETED"] * 3


@pytest.mark.long
def test_a_stop_reaches_drones_whose_app_hangs(new_flight: NewFlight) -> None:
    """Past the app; and when that wakes up, it does not fly on."""
    flight = launched(new_flight(10.0))
    flight.signal(signal.SIGSTOP)
    said = flight.run("tell", str(flight.journal), "stop")
    assert said.code == 0
    assert "does not answer" in said.out
    assert eventually(lambda: all_are_down(flight))
    flight.signal(signal.SIGCONT)
    assert flight.see_through() == 130
    flight.start()
    assert flight.see_through() == 0
    assert statuses(flight) == ["COMPLETED"] * 3


@pytest.mark.long
def test_a_stop_counts_although_the_gateway_dies_meanwhile(new_flight: NewFlight) -> None:
    """Another one is started, and brings the drones down."""
    flight = launched(new_flight(1.0))
    assert flight.run("tell", str(flight.journal), "stop", "--rtl").code == 0
    gateway = gateway_of(flight.journal)
    assert gateway is not None
    os.kill(gateway, signal.SIGKILL)
    assert flight.see_through() == 130
    assert "the gateway has ended" in flight.lives[0]
    assert all_are_down(flight) and no_process_is_left(flight)


@pytest.mark.long
def test_what_was_not_seen_a_person_decides(painting: Flight) -> None:
    """An action of the app's own was cut short: it is done once more."""
    begun = painting.folder / "begun"
    painting.start()
    assert eventually(begun.exists)
    painting.kill()
    painting.start()
    assert painting.see_through() == 4
    (painting.folder / "go").touch()
    asked = painting.run("decide", str(painting.journal))
    assert asked.code == 0
    assert "was spray of trip left done by d0?" in asked.out
    assert asked.out in painting.lives[-1]
    said = painting.run("decide", str(painting.journal), "wall", "not-done")
    assert (said.code, said.err) == (0, "")
    painting.start()
    assert painting.see_through() == 0
    assert painted(painting.folder) == ["left", "right"]


@pytest.mark.long
def test_a_stop_waits_for_no_hook(painting: Flight) -> None:
    """Not even for one that blocks the whole app: the drones land, and a second Ctrl-C ends it."""
    painting.start()
    begun: Path = painting.folder / "begun"
    (painting.folder / "block").touch()
    assert eventually(begun.exists)
    painting.signal(signal.SIGINT)
    painting.until_it_says("the app is busy: the gateway lands the drones without it")
    painting.signal(signal.SIGINT)
    assert painting.see_through() == 130
    (painting.folder / "block").unlink()
    (painting.folder / "go").touch()
    painting.start()
    assert painting.see_through() == 4
    assert statuses(painting) != ["COMPLETED"]
