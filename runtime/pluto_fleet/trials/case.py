"""A case: the missions of a run, its random faults, and its strikes, faults at given times."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass, fields, replace
from enum import Enum
from typing import Any

from ..files.fleet import FleetFile
from ..shared.alone.world import FAULTS, Faults
from ..shared.domain.model import Mission
from ..shared.domain.text import number


class StrikeKind(Enum):
    """The kinds of strikes, with their names on the command line."""

    CRASH = "crash"  # the brain dies after the row is durable and its waiting calls were made
    KEPT = (
        "crash-kept"  # the brain dies after the row is durable, before its waiting calls are made
    )
    LOST = "crash-lost"  # the brain dies before the row is durable
    FREEZE = "freeze"  # the brain hangs, another is started, and then the first continues
    RTL = "rtl"  # everything is stopped, and all drones fly home
    LAND = "land"  # everything is stopped, and all drones land where they are
    GATEWAY = "gateway"  # the gateway dies
    CUT = "cut"  # brain and gateway lose one another
    REPORT = "report"  # the next report is lost, and the connection with it
    REBOOT = "reboot"  # a drone restarts; in the air it sinks
    FALL = "fall"  # a drone falls down
    PAUSE = "pause"
    SKIP = "skip"
    CANCEL = "cancel"
    DISK = "disk"  # no row can be written from this one on

    __hash__ = object.__hash__


DEATHS = (StrikeKind.CRASH, StrikeKind.KEPT, StrikeKind.LOST)
STOPS = (StrikeKind.RTL, StrikeKind.LAND)
BY_HAND = (StrikeKind.PAUSE, StrikeKind.SKIP, StrikeKind.CANCEL)


@dataclass(frozen=True, slots=True, kw_only=True)
class Strike:
    """A fault at a given row."""

    kind: StrikeKind
    row: int
    """The row of the journal, counted from 1 over all runs of the app."""
    after: float = 0.0
    """Seconds after that row."""

    def __str__(self) -> str:
        later = f"+{number(self.after)}" if self.after else ""
        return f"{self.kind.value}@{self.row}{later}"


def strike_of(text: str) -> Strike:
    """Parse `crash@12` or `rtl@3+1.5`; raise `ValueError` if it is invalid."""
    match = _BLOW.fullmatch(text)
    if match is None:
        raise ValueError(f"{text} is not written like crash@12 or rtl@3+1.5")
    kind, row, after = match.groups()
    known = {one.value: one for one in StrikeKind}
    if kind not in known:
        raise ValueError(f"{kind} is nothing that can strike; what can: {', '.join(known)}")
    return Strike(kind=known[kind], row=int(row), after=float(after or 0))


def strikes_of(text: str) -> tuple[Strike, ...]:
    """Parse several, separated by commas or spaces; `-` is none."""
    if text.strip() == "-":
        return ()
    return tuple(strike_of(part) for part in re.split(r"[,\s]+", text.strip()) if part)


def strikes_text(strikes: Sequence[Strike]) -> str:
    """Format several as one word of a command line."""
    return ",".join(map(str, strikes))


_BLOW = re.compile(r"([a-z-]+)@([1-9]\d{0,8})(?:\+(\d{1,6}(?:\.\d{1,6})?))?")


@dataclass(frozen=True, slots=True, kw_only=True)
class Weather(Faults):
    """Random faults: probabilities from 0 to 1, or seconds, with their names on the command line."""

    hook: float = 0.0
    """The share of hook calls that raise an unexpected error."""
    block: float = 0.0
    """The share of hook calls that take half a minute."""
    late: float = 0.0
    """The share of wake-ups that come late."""
    slow: float = 0.0
    """Seconds that a message takes between app and gateway, each way."""
    radio: float = 0.0
    """Seconds that a message takes between gateway and drone, each way."""
    disk: float = 0.0
    """Seconds until a row of the journal is durable."""
    jump: float = 0.0
    """Seconds by which the machine's clock is changed while the app is down."""
    down: float = 1.0
    """Seconds until a crashed app is restarted."""


class BrokenHook(RuntimeError):
    """An unexpected error of a hook."""


FAIR = Weather()

_SHARES = (*FAULTS, "hook", "block", "late")
_MOST = 3_600.0
"""The largest seconds of all but `jump`: with longer delays an app may rightly fail."""
_LONGEST_JUMP = 1e10
"""Seconds: a clock may well begin in 1970."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """Everything that a run depends on besides the app. The missions are copied for each run."""

    seed: int
    missions: tuple[Mission[Any], ...]
    fleet: FleetFile
    weather: Weather = FAIR
    strikes: tuple[Strike, ...] = ()


def fresh(mission: Mission[Any]) -> Mission[Any]:
    """Return a copy of a mission to fly."""
    flown = copy(mission)
    flown.trips = [copy(trip) for trip in mission.trips]
    return flown


def weather_of(text: str) -> Weather:
    """Parse `crash=0.1,slow=0.4`; raise `ValueError` if it is invalid."""
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
    """Format the faults as one word of a command line."""
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
"""All faults whose occurrences are counted."""
WRITTEN: Mapping[str, str] = {
    **{kind.value: f"--strike {kind.value}" for kind in StrikeKind},
    "slow line": "--weather slow",
    "slow radio": "--weather radio",
    "slow disk": "--weather disk",
    "late wake-up": "--weather late",
    "clock jump": "--weather jump",
    "hook raising": "--weather hook",
    "hook blocking": "--weather block",
    **{f"flight: {name}": f"--weather {name}" for name in FAULTS},
}
"""How what can be asked for is asked for."""
