"""Whole flights of Crazyflies through the unmodified cflib: to their end, and with a killed app."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from tests.flights_crazyflie.campaign import fly
from tests.flights_crazyflie.flight import Flight
from tests.flights_crazyflie.judge import beside_its_target, unmeant
from tests.flights_crazyflie.plans import DISTRIBUTION, SIZE, plan, quick_package, targets, write
from tests.flights_crazyflie.scenarios import SCENARIOS
from tests.kill.trial import gateway_of
from tests.kit.apps import compiled

pytest.importorskip("cflib")
pytestmark = pytest.mark.long  # a minute each in real time

COMMAND = re.compile(r" *[\d.]+ s +cf1 +(take off|go to|land) +\((.*?)\)")
CALLED = {"takeoff": "take off", "go_to": "go to", "land": "land"}


@pytest.fixture
def flight(tmp_path: Path) -> Iterator[Flight]:
    """A flight whose files are to be written; no process of it is left."""
    flight = Flight(app=DISTRIBUTION, source=compiled(DISTRIBUTION) / "src", folder=tmp_path)
    yield flight
    flight.end()


def test_all_trips_are_completed_at_their_targets_and_every_drone_lands_before_its_link_closes(
    flight: Flight,
) -> None:
    missions, fleet = plan("ward")
    write(flight.folder, missions, fleet)
    flight.drones = 5
    flight.start()
    assert flight.see_through() == 0, flight.told
    assert set(flight.ends().values()) == {"COMPLETED"}, flight.told
    flight.until(lambda: gateway_of(flight.journal) is None)  # all links are closed
    assert list(beside_its_target(flight.events, flight.trace, targets(missions))) == []
    assert list(unmeant(flight.commands, flight.trace, SIZE)) == []


def test_a_dry_run_says_what_a_drone_is_told(flight: Flight) -> None:
    """The same commands, in the same order, to the same places."""
    write(flight.folder, *plan("one_photo"))
    flight.drones = 1
    dry = flight.run("fly", *flight.files, "--dry-run", "--crtp-sim", "1")
    assert (dry.code, dry.err) == (0, "")
    meant = [line for line in map(COMMAND.match, dry.out.splitlines()) if line is not None]
    flight.start()
    assert flight.see_through() == 0, flight.told
    told = [command for command in flight.commands if command.what in CALLED]
    assert [CALLED[command.what] for command in told] == [line[1] for line in meant]
    for command, line in zip(told, meant, strict=True):
        place = [command.values.get(axis, at) for axis, at in zip("xyz", command.at, strict=True)]
        assert place == pytest.approx([float(one) for one in line[2].split(", ")], abs=0.1), line


def test_an_app_that_is_killed_has_its_drones_landed_and_goes_on(tmp_path: Path) -> None:
    (scenario,) = (one for one in SCENARIOS if one.name == "kill -9 of the brain")
    flight, wrong = fly(scenario, quick_package(tmp_path / "package"), tmp_path)
    assert wrong == [], flight.told
