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
from ..journal.facts import BEGUN, check
from ..journal.reader import Reader
from ..shared.domain.errors import BadInput
from ..shared.domain.text import bounded, quoted
from .acted import Acted, Acting

if TYPE_CHECKING:
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
    app: str = ""
    begun: float = 0.0
    """When, in seconds since 1970."""
    takes: Mapping[str, Mapping[str, Any]] = field(default_factory=dict, repr=False)
    """What plans count with for each action of the app's own, as in the journal's header."""
    acted: Sequence[Acted] = field(default=(), repr=False)
    """The actions of the app's own that were done."""

    @property
    def commands(self) -> Iterator[Command]:
        """All commands."""
        for run in self.runs:
            yield from run


def read_flights(path: Path) -> Flights:
    """Read a journal; raise `BadInput` if it is none, is damaged, or tells no commands."""
    runs: list[list[Command]] = [[]]
    begun = 0.0
    with closing(Reader(path)) as reader:
        header = reader.header
        takes = header.get("takes", {})
        acting = Acting(takes)
        for instant, event in reader.events():
            acting.hear(event)
            if event["event"] == BEGUN:
                begun = instant.wall
            elif event["event"] == FLEW:
                runs[-1].append(_command(path, instant.seq, event))
            elif event["event"] == "brain.began":
                runs.append([])
        if reader.damaged is not None:
            raise errors.damaged(path, reader.damaged)
    if not any(runs):
        raise BadInput(f"{path}: {_NONE}")
    return Flights(
        path=path,
        fleet=header.get("fleet"),
        runs=[run for run in runs if run],
        app=header.get("app", ""),
        begun=begun,
        takes=takes,
        acted=acting.acted,
    )


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
