"""What strikes an app from outside, and when: at which row of its journal."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from plutoc_runtime.domain.text import number


class Kind(Enum):
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


DEATHS = (Kind.CRASH, Kind.KEPT, Kind.LOST)
STOPS = (Kind.RTL, Kind.LAND)
BY_HAND = (Kind.PAUSE, Kind.SKIP, Kind.CANCEL)


@dataclass(frozen=True, slots=True, kw_only=True)
class Blow:
    """One of them."""

    kind: Kind
    row: int
    """At which row of the journal, counted from 1 over all lives of the app."""
    after: float = 0.0
    """So many seconds later."""

    def __str__(self) -> str:
        later = f"+{number(self.after)}" if self.after else ""
        return f"{self.kind.value}@{self.row}{later}"


def blow_of(text: str) -> Blow:
    """Read what `str` writes: `crash@12`, `rtl@3+1.5`; raise `ValueError` where it is no blow."""
    match = _BLOW.fullmatch(text)
    if match is None:
        raise ValueError(f"{text} is not written like crash@12 or rtl@3+1.5")
    kind, row, after = match.groups()
    known = {one.value: one for one in Kind}
    if kind not in known:
        raise ValueError(f"{kind} is nothing that can strike; what can: {', '.join(known)}")
    return Blow(kind=known[kind], row=int(row), after=float(after or 0))


def blows_of(text: str) -> tuple[Blow, ...]:
    """Read several, with commas or spaces between them; `-` is none."""
    if text.strip() == "-":
        return ()
    return tuple(blow_of(part) for part in re.split(r"[,\s]+", text.strip()) if part)


def blows_text(blows: Sequence[Blow]) -> str:
    """Write several as one word of a command line."""
    return ",".join(map(str, blows))


_BLOW = re.compile(r"([a-z-]+)@([1-9]\d{0,8})(?:\+(\d{1,6}(?:\.\d{1,6})?))?")
