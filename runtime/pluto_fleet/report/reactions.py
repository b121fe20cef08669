"""What came of the events of an app: how soon, within which bounds, and how drones took over from each other."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from ..shared.domain.status import Status
from ..shared.domain.text import counted, duration, number
from .spread import spread
from .terminal import table

if TYPE_CHECKING:
    from ..shared.domain.trace import Event

TOLD_BY = frozenset(
    {
        "event.raised",
        "event.over",
        "mission.promised",
        "mission.late",
        "mission.ended",
        "trip.handed_over",
    }
)
"""The entries of a trace that say so."""


@dataclass(slots=True)
class Reaction:
    """What came of all occurrences of one event."""

    raised: int = 0
    missions: int = 0
    """Those that were made of it."""
    seconds: list[float] = field(default_factory=list)
    """From each occurrence to the end of its mission, where that was completed."""
    promised: int = 0
    """The missions with a deadline."""
    kept: int = 0
    """Those of them that were completed by then."""
    faults: int = 0
    """How often a creator had a fault, or made what cannot be flown."""

    def add(self, other: Reaction) -> None:
        """Add those of another run."""
        self.raised += other.raised
        self.missions += other.missions
        self.seconds += other.seconds
        self.promised += other.promised
        self.kept += other.kept
        self.faults += other.faults


@dataclass(slots=True)
class Reactions:
    """What came of all events, in one run or in several."""

    events: dict[str, Reaction] = field(default_factory=dict)
    """By their names, in the order in which they were first raised."""
    away: list[float] = field(default_factory=list)
    """Metres from the drone that took over to its place, at each hand-over."""
    gaps: int = 0
    """The hand-overs at which these were more than the trip's reach."""

    def add(self, other: Reactions) -> None:
        """Add those of another run."""
        for name, reaction in other.events.items():
            self.events.setdefault(name, Reaction()).add(reaction)
        self.away += other.away
        self.gaps += other.gaps

    def data(self) -> dict[str, Any]:
        """Return them as plain data; nothing, where no event was raised and no drone took over."""
        told: dict[str, Any] = {}
        if self.events:
            told["events"] = {name: _data(one) for name, one in self.events.items()}
        if self.away:
            told["hand_overs"] = {
                "count": len(self.away),
                "gaps": self.gaps,
                "away_m": spread(self.away),
            }
        return told

    def lines(self) -> Iterator[str]:
        """Yield a table of the events, and a line about the hand-overs, each where there were any."""
        if self.events:
            rows = [_row(name, one) for name, one in self.events.items()]
            yield from table(_HEADER, rows, right=(1, 2, 3, 4, 5))
        if faults := sum(one.faults for one in self.events.values()):
            yield f"{counted(faults, 'fault')} of creators, whose events made no mission: the lines above say why"
        if self.away:
            count = len(self.away)
            yield (
                f"{counted(count, 'hand-over')}, {count - self.gaps} without a gap:"
                f" who took over was at most {number(round(max(self.away), 2))} m away"
            )


_HEADER = ("event", "raised", "missions", "completed", "median", "p95", "bounds kept")


def _row(name: str, one: Reaction) -> tuple[str, ...]:
    found = spread(one.seconds)
    times = ("", "") if found is None else (duration(found["median"]), duration(found["p95"]))
    kept = f"{one.kept} of {one.promised}" if one.promised else ""
    return (name, str(one.raised), str(one.missions), str(len(one.seconds)), *times, kept)


def _data(one: Reaction) -> dict[str, Any]:
    return {
        "raised": one.raised,
        "missions": one.missions,
        "completed": len(one.seconds),
        "seconds": spread(one.seconds),
        "promised": one.promised,
        "kept": one.kept,
        "faults": one.faults,
    }


def reactions_of(trace: Iterable[Event]) -> Reactions:
    """Return what came of the events of one run."""
    found = Reactions()
    raised: dict[str, tuple[Reaction, float]] = {}
    made: dict[str, tuple[Reaction, float]] = {}
    promised = set[str]()
    late = set[str]()
    for entry in trace:
        match entry:
            case {"event": "event.raised", "id": id, "kind": name, "t": when}:
                reaction = found.events.setdefault(name, Reaction())
                reaction.raised += 1
                raised[id] = (reaction, when)
            case {"event": "event.over", "id": id, "made": mission} if id in raised:
                made[mission] = raised[id]
                made[mission][0].missions += 1
            case {"event": "event.over", "id": id, "fault": True} if id in raised:
                raised[id][0].faults += 1
            case {"event": "mission.promised", "mission": mission, "deadline": _}:
                promised.add(mission)
            case {"event": "mission.late", "mission": mission}:
                late.add(mission)
            case {"event": "mission.ended", "mission": mission} if mission in made:
                reaction, when = made[mission]
                reaction.promised += mission in promised
                if entry["status"] == Status.COMPLETED.value:
                    reaction.seconds.append(entry["t"] - when)
                    reaction.kept += mission in promised and mission not in late
            case {"event": "trip.handed_over", "away": away, "reach": reach}:
                found.away.append(away)
                found.gaps += away > reach
    return found
