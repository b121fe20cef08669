"""What goes wrong with one of four vehicles, and how each flight must end all the same: `scenarios.toml`."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from tests.flights_crazyflie.judge import badly_ended, not_as_meant
from tests.flights_mavlink.vehicles import MAKES, STRANGER, Parameters, Value, Vehicles, never

BROKEN = {"px4": "m1", "ardupilot": "m2"}
"""The vehicle of each make that has the fault."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Scenario:
    """A fault, and what must come of it."""

    name: str
    comes: str
    """What comes of it, for people."""
    before: str = ""
    """What goes wrong before the app starts."""
    in_flight: str = ""
    """What goes wrong with it while it flies."""
    value: Value = True
    both: bool = False
    """Whether it goes wrong with one of the other make, too."""
    seconds: float = 0.0
    """How long it goes wrong; 0: for good."""
    after: str = ""
    """What is done then."""
    fails: str = ""
    """A pattern that the reason of a failed trip must match; empty: no trip fails."""
    may_fail: bool = False
    """Whether that is so only if the trip is given to it."""
    falls: bool = False
    """Whether it may come down otherwise than by landing."""
    parameters: Parameters = field(default_factory=dict)
    """By make."""

    def begin(self, flight: Vehicles, broken: str) -> None:
        """Let go wrong what does so before the app starts."""
        if self.before:
            self._let(flight, broken, self.before, self.value)

    def go_on(self, flight: Vehicles, broken: str) -> None:
        """Let go wrong what does so in flight."""
        if self.in_flight:
            flight.until_up(broken, 3.0)
            flight.goes_on(1.0)
            self._let(flight, broken, self.in_flight, self.value)
        if self.seconds:
            flight.goes_on(self.seconds)
            self._let(flight, broken, self.in_flight, False)
        if self.after:
            _AFTER[self.after](flight, broken)

    def _let(self, flight: Vehicles, broken: str, fault: str, value: Value) -> None:
        for id in BROKEN.values() if self.both else (broken,):
            flight.let(id, fault, value)

    def wrong(self, flight: Vehicles, broken: str, code: int) -> Iterator[str]:
        """Yield what is wrong with a flight that has ended."""
        yield from badly_ended(flight, code)
        if not self.may_fail or flight.has_failed:
            yield from not_as_meant(flight, self.fails)
        yield from never(flight, [broken] if self.falls else ())


def lands(flight: Vehicles, broken: str) -> None:
    """Wait until it has landed by itself; then let it be heard again."""
    flight.until(lambda: broken not in flight.airborne())
    flight.let(broken, "silent", False)


def is_given_back(flight: Vehicles, broken: str) -> None:
    """Have its pilot switch to the mode that it had."""
    flight.goes_on(3.0)
    flight.let(broken, "pilot", "go")


def restarts_on_the_ground(flight: Vehicles, broken: str) -> None:
    """Switch it off and on between two flights."""
    flight.until(lambda: flight.state[broken]["landings"] > 0)
    flight.let(broken, "reboot")
    flight.let(broken, "silent")
    flight.goes_on(4.0)
    flight.let(broken, "silent", False)


def is_lost_while_it_lands(flight: Vehicles, broken: str) -> None:
    """Hear nothing of it from when it is halfway down, until it has landed."""
    flight.until(lambda: bool(flight.state[broken]["doing"] == "land"))
    flight.goes_on(2.0)
    flight.let(broken, "silent")
    lands(flight, broken)


def has_a_twin(flight: Vehicles, broken: str) -> None:
    """Have another vehicle of its make switched on, with its id."""
    flight.until_up(broken, 3.0)
    flight.join(STRANGER, MAKES[broken])
    flight.let(STRANGER, "system", [*MAKES].index(broken) + 1)


def stop(flight: Vehicles, broken: str) -> None:
    """Have the user stop the flight, and go on once all have landed."""
    flight.notes.append(flight.tell("stop").strip())
    flight.goes_on(4.0)
    flight.let(broken, "silent", False)
    flight.notes.append(f"stopped with {flight.wait(120.0)}")
    flight.start()


def kill_brain(flight: Vehicles, _: str) -> None:
    """Kill the app; the gateway must land all vehicles; then go on."""
    flight.until_up("m1", 3.0)
    flight.kill()
    flight.until(lambda: not flight.airborne())
    flight.start()


def kill_the_gateway(flight: Vehicles, broken: str) -> None:
    """Kill the gateway; the app must start it again."""
    flight.until_up(broken, 3.0)
    flight.restart_gateway()


_AFTER: Mapping[str, Callable[[Vehicles, str], None]] = {
    call.__name__: call
    for call in (
        lands,
        is_given_back,
        restarts_on_the_ground,
        is_lost_while_it_lands,
        has_a_twin,
        stop,
        kill_brain,
        kill_the_gateway,
    )
}

SCENARIOS = tuple(
    Scenario(**one)
    for one in tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))[
        "scenario"
    ]
)
