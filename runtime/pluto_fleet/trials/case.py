"""One run to be tried: what is flown, what goes wrong by itself, and what strikes it when."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass, fields, replace
from enum import Enum
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.text import number

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Mission

    from ..files.fleet import FleetFile


class StrikeKind(Enum):
    """What can strike. The words are those of the command line."""

    CRASH = "crash"  # the brain dies once the row is durable and what waited for it was told
    KEPT = (
        "crash-kept"  # the brain dies: the row is durable, and nothing that waited for it was told
    )
    LOST = "crash-lost"  # the brain dies before the row is durable
    FREEZE = "freeze"  # the brain stands still, another is started, and then the first goes on
    RTL = "rtl"  # everything is stopped, and all drones fly home
    LAND = "land"  # everything is stopped, and all drones land where they are
    GATEWAY = "gateway"  # the gateway dies
    CUT = "cut"  # brain and gateway lose one another
    REPORT = "report"  # the next report is not heard, and the line is broken with it
    REBOOT = "reboot"  # a drone is switched off and on again; in the air it sinks
    FALL = "fall"  # a drone falls down
    PAUSE = "pause"
    SKIP = "skip"
    CANCEL = "cancel"
    DISK = "disk"  # from this row on nothing can be written

    __hash__ = object.__hash__


DEATHS = (StrikeKind.CRASH, StrikeKind.KEPT, StrikeKind.LOST)
STOPS = (StrikeKind.RTL, StrikeKind.LAND)
BY_HAND = (StrikeKind.PAUSE, StrikeKind.SKIP, StrikeKind.CANCEL)


@dataclass(frozen=True, slots=True, kw_only=True)
class Strike:
    """One of them."""

    kind: StrikeKind
    row: int
    """At which row of the journal, counted from 1 over all lives of the app."""
    after: float = 0.0
    """So many seconds later."""

    def __str__(self) -> str:
        later = f"+{number(self.after)}" if self.after else ""
        return f"{self.kind.value}@{self.row}{later}"


def strike_of(text: str) -> Strike:
    """Read what `str` writes: `crash@12`, `rtl@3+1.5`; raise `ValueError` where it is no strike."""
    match = _BLOW.fullmatch(text)
    if match is None:
        raise ValueError(f"{text} is not written like crash@12 or rtl@3+1.5")
    kind, row, after = match.groups()
    known = {one.value: one for one in StrikeKind}
    if kind not in known:
        raise ValueError(f"{kind} is nothing that can strike; what can: {', '.join(known)}")
    return Strike(kind=known[kind], row=int(row), after=float(after or 0))


def strikes_of(text: str) -> tuple[Strike, ...]:
    """Read several, with commas or spaces between them; `-` is none."""
    if text.strip() == "-":
        return ()
    return tuple(strike_of(part) for part in re.split(r"[,\s]+", text.strip()) if part)


def strikes_text(strikes: Sequence[Strike]) -> str:
    """Write several as one word of a command line."""
    return ",".join(map(str, strikes))


_BLOW = re.compile(r"([a-z-]+)@([1-9]\d{0,8})(?:\+(\d{1,6}(?:\.\d{1,6})?))?")


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
    """Calls of hooks that raise an unexpected error."""
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
"""Seconds, of all others but `jump`: an app that is kept waiting for longer need not be at fault."""
_LONGEST_JUMP = 1e10
"""Seconds: a clock may well begin in 1970."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """All that a run depends on besides the app. The missions are never flown themselves."""

    seed: int
    missions: tuple[Mission[Any], ...]
    fleet: FleetFile
    weather: Weather = FAIR
    strikes: tuple[Strike, ...] = ()


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


ENDS: Mapping[str, str] = {
    "COMPLETED": "were completed",
    "FAILED": "failed, as they may when so much goes wrong",
    "CANCELLED": "were cancelled",
}
"""How missions end."""
WORDS: Mapping[str, str] = {
    "crash": "the app died",
    "crash-kept": "the app died before it had acted on what it had written down",
    "crash-lost": "the app died before it had written down what it was about to do",
    "freeze": "the app stood still, and went on when another had taken over",
    "rtl": "everything was stopped, and flew home",
    "land": "everything was stopped, and landed",
    "gateway": "the gateway died",
    "cut": "app and gateway lost one another",
    "report": "the end of a flight was not heard",
    "reboot": "a drone was switched off and on again",
    "fall": "a drone fell down",
    "pause": "a person paused a mission",
    "skip": "a person skipped a trip",
    "cancel": "a person cancelled a mission",
    "disk": "the disk was full",
    "failsafe": "the gateway landed everything, because the app was silent",
    "death in recovery": "the app died while it was starting anew",
    "report to nobody": "a flight ended while the app was down",
    "slow line": "a message between app and gateway came late",
    "slow radio": "a message between gateway and drone came late",
    "slow disk": "the disk was slow",
    "late wake-up": "the app woke up late",
    "clock jump": "the machine's clock was set",
    "snapshot": "the app began with a snapshot of its journal",
    "hook raising": "a hook raised an unexpected error",
    "hook blocking": "a hook took half a minute",
    "go on": "a person let a paused mission go on",
    "decision": "a person was asked what had become of a trip",
    "decision at rest": "a person was asked that while the app was down",
    "flight: crash": "a drone crashed",
    "flight: link": "a drone lost its link",
    "flight: battery": "a drone ran out of battery",
    "flight: action": "an action failed",
}
"""Everything of which it is counted how often it has struck."""
WRITTEN: Mapping[str, str] = {
    **{kind.value: f"--strike {kind.value}" for kind in StrikeKind},
    "slow line": "--weather slow",
    "slow radio": "--weather radio",
    "slow disk": "--weather disk",
    "late wake-up": "--weather late",
    "clock jump": "--weather jump",
    "snapshot": "--weather snapshot",
    "hook raising": "--weather hook",
    "hook blocking": "--weather block",
    **{f"flight: {name}": f"--weather {name}" for name in ("crash", "link", "battery", "action")},
}
"""How what can be asked for is asked for."""
