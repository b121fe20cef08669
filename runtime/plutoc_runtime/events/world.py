"""What moves in a simulated world: who walks where, and which camera sees it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from itertools import pairwise, starmap
from math import dist
from typing import TYPE_CHECKING, Any

from ..alone.world import HEIGHT, WIDTH, World
from ..domain import values
from ..domain.model import Photo, Sighting

if TYPE_CHECKING:
    from ..domain.airspace import Airspace, Corner
    from ..domain.fleet_data import WorldData
    from ..domain.model import Point
    from ..domain.values import Keys, Table


@dataclass(frozen=True, slots=True, kw_only=True)
class Mover:
    """An object that moves on the ground, along a path at a constant speed."""

    name: str
    kind: str
    path: tuple[Corner, ...]
    speed: float
    starts: float = 0.0
    """When it comes, in seconds since the start."""
    repeat: bool = False
    """Whether it goes round, from the last point to the first; else it leaves at the last."""

    def at(self, now: float) -> Corner | None:
        """Return where it is at a time; None: it is not there."""
        if now < self.starts:
            return None
        path = (*self.path, self.path[0]) if self.repeat else self.path
        left = (now - self.starts) * self.speed
        if self.repeat and (around := sum(starmap(dist, pairwise(path)))) > 0.0:
            left %= around
        for start, end in pairwise(path):
            if left <= (length := dist(start, end)):
                part = left / length if length else 0.0
                return start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1])
            left -= length
        return None


def read_movers(table: Table) -> tuple[Mover, ...]:
    """Return what moves, as the `[[world.mover]]` of a fleet file say."""
    needed: Keys = {"name": values.name, "kind": values.name, "path": _PATH, "speed": values.PACE}
    others: Keys = {"from": values.TIME, "repeat": values.boolean}
    given = [one.read(needed, others) for one in table.tables("mover")]
    named = ({("starts" if key == "from" else key): one[key] for key in one} for one in given)
    return tuple(Mover(**one) for one in named)


_PATH = partial(values.each, values.corner, "corner", ())


class MovingWorld(World):
    """A world in which something moves."""

    def __init__(self, seed: int, airspace: Airspace, data: WorldData | None = None) -> None:
        super().__init__(seed, airspace, data)
        movers = () if data is None else data.movers
        self.movers = [Mover(**one) if isinstance(one, dict) else one for one in movers]

    def photo(self, point: Point, time: float) -> Photo:
        """Return a photo straight down from about this point, with what moves on it."""
        photo = super().photo(point, time)
        x, y, _ = photo.position
        tracks = self._seen(x, y, photo.width, photo.height, time)
        if not tracks:
            return photo
        sees = tuple(sorted([*photo.sees, *(one.kind for one in tracks)]))
        return replace(photo, sees=sees, tracks=tracks)

    def tracks(self, time: float) -> Mapping[str, Any]:
        """Return where everything is at a time that moves, as it is told."""
        places = ((mover, mover.at(time)) for mover in self.movers)
        return {mover.name: {"kind": mover.kind, "at": [*at, 0.0]} for mover, at in places if at}

    def moving(self, point: Point, time: float) -> tuple[Sighting, ...]:
        """Return what moves in the view of a camera that looks straight down from a point."""
        x, y, z = point
        return self._seen(x, y, z * WIDTH, z * HEIGHT, time) if z > 0.0 else ()

    def _seen(
        self, x: float, y: float, width: float, height: float, time: float
    ) -> tuple[Sighting, ...]:
        found: list[Sighting] = []
        for mover in self.movers:
            at = mover.at(time)
            if at and abs(at[0] - x) <= width / 2 and abs(at[1] - y) <= height / 2:
                found.append(Sighting(mover.name, mover.kind, (*at, 0.0)))
        return tuple(found)
