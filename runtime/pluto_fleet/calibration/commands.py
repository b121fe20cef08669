"""What journals tell of how long things took: the measured commands of each drone, and the actions of an app's own.

The latter run in the app, so no drone measures them: a journal says when each began, and when its trip was completed.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from math import dist
from pathlib import Path
from typing import Any

from msgspec import Struct, convert

from ..jobs.flown import FLEW
from ..journal import errors
from ..journal.facts import BEGUN, check
from ..journal.reader import Reader
from ..shared.domain.errors import BadInput
from ..shared.domain.model import Point
from ..shared.domain.text import bounded, quoted


@dataclass(frozen=True, slots=True, kw_only=True)
class Acted:
    """One action of the app's own that was done."""

    action: str
    seconds: float
    parameters: Mapping[str, Any]
    """Those of its trip."""


class Acting:
    """What becomes of the own actions of one journal, event by event."""

    def __init__(self, own: Mapping[str, object]) -> None:
        self.acted: list[Acted] = []
        """What was done, in order."""
        self._own = own
        self._begun: dict[str, float] = {}
        """When the action of each mission began last."""

    def hear(self, event: Mapping[str, Any]) -> None:
        """Take an event; one of a trip that was completed has this trip as `did`."""
        match event["event"]:
            case "action.begun":
                self._begun[event["mission"]] = event["t"]
            case "trip.completed":
                began = self._begun.pop(event["mission"], None)
                trip = event["did"]
                # when it was done is unknown where that was only found out afterwards
                if began is None or event.get("found_out") or trip["action"] not in self._own:
                    return
                self.acted.append(
                    Acted(
                        action=trip["action"],
                        seconds=event["t"] - began,
                        parameters=trip.get("parameters", {}),
                    )
                )


class Command(
    Struct, frozen=True, kw_only=True, rename={"start": "from", "end": "to", "ended_at": "t"}
):
    """One command of one drone, which is over, as a journal has it."""

    drone: str
    category: str
    what: str
    start: Point
    end: Point
    speed: float
    """The category's, in metres per second."""
    seconds: float
    """How long it took."""
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
        return dist(self.start, self.end)

    @property
    def began(self) -> float:
        """In seconds since the app first started."""
        return self.ended_at - self.seconds


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
        return convert(facts, Command)
    except ValueError as error:
        said = bounded(str(error), _LONGEST)
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
