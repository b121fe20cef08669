"""One run to be tried: what is flown, what goes wrong by itself, and what strikes it when."""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.text import number

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Mission

    from ..files.fleet import FleetFile
    from .blows import Blow


@dataclass(frozen=True, slots=True, kw_only=True)
class Weather:
    """What goes wrong by itself: shares from 0 to 1, or seconds. The names are the command line's."""

    crash: float = 0.0
    """Flights that crash."""
    link: float = 0.0
    """Flights that lose their link."""
    action: float = 0.0
    """Flights whose action fails."""
    battery: float = 0.0
    """Flights whose battery is empty all at once."""
    hook: float = 0.0
    """Calls of hooks that raise an error that nobody expected."""
    block: float = 0.0
    """Calls of hooks that take half a minute."""
    late: float = 0.0
    """Wake-ups that come late."""
    slow: float = 0.0
    """Seconds that a message takes between app and gateway, each way."""
    radio: float = 0.0
    """Seconds that a message takes between gateway and drone, each way."""
    disk: float = 0.0
    """Seconds until a row of the journal is durable."""
    jump: float = 0.0
    """Seconds by which the clock of the machine is set on while the app is down; less than 0: back."""
    down: float = 1.0
    """Seconds until a crashed app is started again."""
    snapshot: float = 0.0
    """Lives that begin with a snapshot and not with the first row of the journal."""


FAIR = Weather()

_SHARES = ("crash", "link", "action", "battery", "hook", "block", "late", "snapshot")
_MOST = 3_600.0
"""Seconds, of all others but `jump`: whoever is kept waiting for longer need not be at fault."""
_LONGEST_JUMP = 1e10
"""Seconds: a clock may well begin in 1970."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """All that a run depends on besides the app. The missions are never flown themselves."""

    seed: int
    missions: tuple[Mission[Any], ...]
    fleet: FleetFile
    weather: Weather = FAIR
    blows: tuple[Blow, ...] = ()


def fresh(mission: Mission[Any]) -> Mission[Any]:
    """Return a mission to fly: what changes in flight is a copy."""
    flown = copy(mission)
    flown.trips, flown.completed_trips = [copy(trip) for trip in mission.trips], []
    return flown


def weather_of(text: str) -> Weather:
    """Read `crash=0.1,slow=0.4`; raise `ValueError` where it says nothing."""
    given: dict[str, float] = {}
    known = [field.name for field in fields(Weather)]
    for part in text.split(","):
        name, _, value = (piece.strip() for piece in part.partition("="))
        if name not in known:
            raise ValueError(f"{name} is no weather; there are: {', '.join(known)}")
        try:
            given[name] = float(value)
        except ValueError:
            raise ValueError(f"{part.strip()} is not written like slow=0.4") from None
        least, most = _bounds(name)
        if not least <= given[name] <= most:
            raise ValueError(f"{part.strip()} is not between {number(least)} and {number(most)}")
    return replace(FAIR, **given)


def _bounds(name: str) -> tuple[float, float]:
    if name == "jump":
        return -_LONGEST_JUMP, _LONGEST_JUMP
    return 0.0, 1.0 if name in _SHARES else _MOST


def weather_text(weather: Weather) -> str:
    """Write what is not fair of it as one word of a command line."""
    return ",".join(
        f"{field.name}={number(value)}"
        for field in fields(Weather)
        if (value := getattr(weather, field.name)) != getattr(FAIR, field.name)
    )
