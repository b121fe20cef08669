"""Faults by seed: which, when and with which vehicles; what came of them is held to the rules of all flights."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from operator import attrgetter
from random import Random

from tests.flights_mavlink.vehicles import MISSIONS, Parameters, Value, Vehicles, never

VICTIMS = ("m1", "m2", "m3")
"""Those that have faults: one is well, and has time for what the others fail to do."""
_LATEST = 35.0
"""Seconds after the start of the app in which something goes wrong."""
_FALLS = ("dead", "reboot")
"""The faults by which a vehicle falls."""
_LASTS = {
    "silent": (2.0, 12.0),
    "late": (2.0, 8.0),
    "blank": (3.0, 15.0),
    "eyeless": (3.0, 15.0),
    "blind": (3.0, 20.0),
    "sag": (1.0, 8.0),
    "astray": (1.0, 6.0),
    "ahead": (1.0, 6.0),
    "homeless": (3.0, 20.0),
    "gaugeless": (3.0, 20.0),
    "unfenced": (3.0, 20.0),
    "stubborn": (3.0, 20.0),
}
"""Seconds that a fault lasts, from and to; any other is there for good, or for so many commands."""
_HOW: dict[str, Callable[[Random], Value]] = {
    "late": lambda random: random.uniform(0.2, 2.0),
    "unanswered": lambda random: random.randint(1, 5),
    "lost_answer": lambda random: random.choice((21, 22, 176, 192, 400)),
    "denied": lambda random: random.randint(1, 2),
    "busy": lambda random: random.randint(1, 2),
    "level": lambda random: random.uniform(0.01, 0.3),
    "sag": lambda random: random.uniform(0.3, 0.9),
    "astray": lambda random: random.uniform(-4.0, 4.0),
    "raised": lambda random: random.uniform(-4.0, 4.0),
    "ahead": lambda random: random.uniform(1.0, 1e5),
    "pilot": lambda random: random.choice(("return", "land")),
}
"""The value of a fault; True where nothing else is said."""
FAULTS = (*dict.fromkeys((*_LASTS, *_HOW, *_FALLS)),)


@dataclass(frozen=True, slots=True)
class Strike:
    """What is let happen to a vehicle, so many seconds after the start of the app."""

    at: float
    drone: str
    fault: str
    value: Value
    ends: bool = False
    """Whether it is the end of a fault, and must come in any case."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """The faults of one flight."""

    strikes: Sequence[Strike]
    parameters: Parameters
    falls: Sequence[str] = field(default_factory=tuple)

    def __str__(self) -> str:
        return ", ".join(
            f"{one.drone} {one.fault} {one.value} at {one.at:.0f} s" for one in self.strikes
        )

    def begin(self, flight: Vehicles) -> None:
        """Let go wrong what does so before the app starts."""
        for strike in self.strikes:
            if strike.at <= 0.0:
                flight.let(strike.drone, strike.fault, strike.value)

    def go_on(self, flight: Vehicles) -> None:
        """Let go wrong what does so later."""
        now = 0.0
        for strike in self.strikes:
            if strike.at <= 0.0:
                continue
            flight.goes_on(strike.at - now)
            now = strike.at
            if strike.ends or not flight.has_ended:
                flight.let(strike.drone, strike.fault, strike.value)

    def wrong(self, flight: Vehicles, code: int) -> Iterator[str]:
        """Yield what is wrong with a flight that has ended."""
        if code not in (0, 1):
            yield f"exit code {code}"
        ends = flight.ends()
        yield from (f"{name} ended as {how}" for name, how in ends.items() if how not in _ENDS)
        if len(ends) < len(MISSIONS):
            yield f"only {', '.join(ends) or 'no mission'} ended"
        if "Traceback" in flight.told:
            yield "a traceback was printed"
        yield from never(flight, self.falls)


_ENDS = ("COMPLETED", "FAILED")


def drawn(seed: int) -> Drawn:
    """Return the faults of a seed."""
    random = Random(f"vehicles/{seed}")
    strikes = list[Strike]()
    for drone in random.sample(VICTIMS, random.randint(1, len(VICTIMS))):
        fault = random.choice(FAULTS)
        at = random.choice((0.0, random.uniform(4.0, _LATEST)))
        if at == 0.0 and fault in ("reboot", "pilot"):
            at = 10.0
        value = _HOW[fault](random) if fault in _HOW else True
        strikes.append(Strike(at, drone, fault, value))
        if fault in _LASTS:
            strikes.append(
                Strike(at + random.uniform(*_LASTS[fault]), drone, fault, False, ends=True)
            )
    parameters = {
        "px4": {"NAV_DLL_ACT": random.randint(0, 3), "COM_DL_LOSS_T": 2, "COM_FAIL_ACT_T": 1},
        "ardupilot": {
            "FS_GCS_ENABLE": random.choice((0, 1, 5)),
            "FS_GCS_TIMEOUT": 3,
            "SYSID_MYGCS": 245,
        },
    }
    return Drawn(
        strikes=sorted(strikes, key=attrgetter("at")),
        parameters=parameters,
        falls=[one.drone for one in strikes if one.fault in _FALLS],
    )
