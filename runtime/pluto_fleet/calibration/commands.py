"""The measured commands of journals: what each drone flew, and how long that took."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from math import dist
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..jobs.flown import FLEW
from ..journal import errors
from ..journal.facts import Event, check
from ..journal.reader import Reader
from ..shared.domain.errors import BadInput
from ..shared.domain.text import bounded, quoted

if TYPE_CHECKING:
    from ..journal.database import Row
    from ..shared.domain.model import Point


@dataclass(frozen=True, slots=True, kw_only=True)
class Command:
    """One command of one drone, which is over."""

    drone: str
    category: str
    what: str
    start: Point
    end: Point
    speed: float
    """The category's, in metres per second."""
    began: float
    ended_at: float
    """In seconds since the app first started."""
    battery: tuple[float, float]
    """At its beginning, and at its end."""
    ended: str
    action: str = ""
    flight_time: float = 0.0
    charge_time: float = 0.0
    """The category's; known of a take-off."""

    @property
    def metres(self) -> float:
        """How far it led."""
        return dist(self.start, self.end)

    @property
    def seconds(self) -> float:
        """How long it took."""
        return self.ended_at - self.began


@dataclass(frozen=True, slots=True, kw_only=True)
class Flights:
    """What one journal tells."""

    path: Path
    fleet: str | None
    """The text of its fleet file; None: it was flown with the default fleet."""
    runs: Sequence[Sequence[Command]] = field(repr=False)
    """The commands of each run of the app: between two, no one has watched the drones."""

    @property
    def commands(self) -> Iterator[Command]:
        """All commands."""
        for run in self.runs:
            yield from run


def read_flights(path: Path) -> Flights:
    """Read a journal; raise `BadInput` if it is none, is damaged, or tells no commands."""
    runs: list[list[Command]] = [[]]
    with closing(Reader(path)) as reader:
        for row in reader.rows():
            for event in _events(path, row):
                if event["event"] == FLEW:
                    runs[-1].append(_command(path, row.seq, event))
                elif event["event"] == "brain.began":
                    runs.append([])
        if reader.damaged is not None:
            raise BadInput(reader.damaged)
    if not any(runs):
        raise BadInput(f"{path}: {_NONE}")
    return Flights(path=path, fleet=reader.header.get("fleet"), runs=[run for run in runs if run])


def _events(path: Path, row: Row) -> Sequence[Event]:
    try:
        return row.events
    except ValueError as error:
        raise errors.strange(path, errors.unfit(row.seq, error)) from None


def _command(path: Path, row: int, facts: Mapping[str, Any]) -> Command:
    try:
        check(facts)
        ended_at, (before, after) = float(facts["t"]), facts["battery"]
        (x, y, z), (to_x, to_y, to_z) = (map(float, facts[end]) for end in ("from", "to"))
        return Command(
            drone=str(facts["drone"]),
            category=str(facts["category"]),
            what=str(facts["what"]),
            start=(x, y, z),
            end=(to_x, to_y, to_z),
            speed=float(facts["speed"]),
            began=ended_at - float(facts["seconds"]),
            ended_at=ended_at,
            battery=(float(before), float(after)),
            ended=str(facts["ended"]),
            action=str(facts.get("action", "")),
            flight_time=float(facts.get("flight_time", 0.0)),
            charge_time=float(facts.get("charge_time", 0.0)),
        )
    except (KeyError, TypeError, ValueError) as error:
        said = bounded(f"{type(error).__name__}: {error}", _LONGEST)
        raise BadInput(
            f"{path}: row {row} has a measurement that this pluto-fleet does not know ({said}): use a"
            " newer one"
        ) from None


_LONGEST = 200
"""Characters of what is wrong."""

_NONE = (
    "no drone has flown in it, so there is nothing to calibrate with; what `simulate` flies is not"
    " measured: use fly"
)
"""Why a journal has no commands."""


def read_all(paths: Sequence[Path]) -> list[Flights]:
    """Read journals; raise `BadInput` also if one is named twice."""
    seen: dict[Path, Path] = {}
    for path in paths:
        where = path.resolve()
        if where in seen:
            raise BadInput(f"{path}: it is named twice (also as {quoted(str(seen[where]))})")
        seen[where] = path
    return [read_flights(path) for path in paths]
