"""What goes wrong in the air, fault by fault, and how each flight must end all the same: `scenarios.toml`."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from pluto_fleet.crtp.battery import LOW
from pluto_fleet.crtp.server import Value
from tests.flights_crazyflie.flight import Flight
from tests.kill.trial import gateway_of

ALL = ("cf1", "cf2", "cf3", "cf4")
"""The drones of each of these flights; three missions are flown, so one of them has time."""

_CRASHED = 1 << 7
"""What a drone says of itself that has crashed, until it was asked to forget it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario:
    """A fault, and what must come of it."""

    name: str
    before: str = ""
    """What goes wrong before the app starts."""
    in_flight: str = ""
    """What goes wrong with cf1 while it flies."""
    value: Value = True
    all: bool = False
    """Whether it goes wrong with all drones, and not with cf1 alone."""
    seconds: float = 0.0
    """How long it goes wrong; 0: for good."""
    after: str = ""
    """What is done then, while cf1 flies or after it has come down."""
    fails: str = ""
    """A pattern that the reason of a failed trip must match; empty: no trip fails."""
    falls: Sequence[str] = ()
    """The drones that may come down otherwise than by landing."""
    code: int = 0
    speed: float | None = None
    """Metres per second that its drones may fly; None: as fast as a Crazyflie follows."""
    refused: str = ""
    """A pattern of why nothing is flown; empty: missions are flown."""

    def begin(self, flight: Flight) -> None:
        """Let go wrong what does so before the app starts."""
        for drone in ALL if self.all else ("cf1",):
            if self.before:
                flight.let(drone, self.before, self.value)

    def go_on(self, flight: Flight) -> None:
        """Let go wrong what does so in flight."""
        if self.in_flight or self.after:
            flight.until_up("cf1")
        if self.in_flight:
            flight.let("cf1", self.in_flight, self.value)
        if self.seconds:
            flight.goes_on(self.seconds)
            flight.let("cf1", self.in_flight, False)
        if self.after:
            _AFTER[self.after](flight)


def empty(flight: Flight) -> None:
    """Let its battery be empty, so that it falls."""
    flight.let("cf1", "volts", LOW)


def kill_brain(flight: Flight) -> None:
    """Kill the app; the gateway must land all drones; then go on."""
    flight.kill()
    flight.until(lambda: not flight.airborne(), 30.0)
    flight.start()


def kill_gateway(flight: Flight) -> None:
    """Kill the gateway; the app must start it again."""
    old = gateway_of(flight.journal)
    flight.kill_gateway()
    flight.until(lambda: gateway_of(flight.journal) not in (None, old), 30.0)


def fetched(flight: Flight) -> None:
    """Let a person fetch the drone, a little after it has come down."""
    flight.until(lambda: "cf1" not in flight.airborne())
    flight.goes_on(2.0)
    flight.let("cf1", "fetch", True)


def found_again(flight: Flight) -> None:
    """Let a drone see its beacons again once it has landed."""
    flight.until(lambda: "cf1" not in flight.airborne(), 30.0)
    flight.let("cf1", "fixes", True)


def stood_up(flight: Flight) -> None:
    """Let a person stand it up where it lies, and press Bring back."""
    flight.until(lambda: any(one["event"] == "drone.lost" for one in flight.events))
    flight.let("cf1", "upright", True)
    flight.notes.append(flight.tell("bring-back", "cf1").strip())
    flight.until(lambda: not int(flight.state["cf1"]["info"]) & _CRASHED)


_AFTER: Mapping[str, Callable[[Flight], None]] = {
    call.__name__: call
    for call in (empty, kill_brain, kill_gateway, fetched, found_again, stood_up)
}

SCENARIOS = tuple(
    Scenario(**one)
    for one in tomllib.loads(Path(__file__).with_suffix(".toml").read_text())["scenario"]
)
