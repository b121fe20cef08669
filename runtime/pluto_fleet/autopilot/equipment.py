"""What a simulated vehicle carries: a gripper, sensors whose values a companion computer tells, and what its camera sees."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from urllib.parse import quote

from ..geodesy import Degrees, LocalPlane
from ..process.surroundings import Surroundings, quantities_in
from ..shared.alone.world import World
from ..shared.domain.airspace import Airspace

LONGEST_NAME = 9
"""Characters of a value's name: PX4 ends a NAMED_VALUE_FLOAT's ten with a zero."""


@dataclass(slots=True)
class Gripper:
    """A servo without a sensor: it counts as there when it has had the time."""

    closed: bool | None
    """None: it is between."""
    moves_for: float
    """Seconds that it takes."""
    since: float = 0.0
    """When it was told last."""
    wanted: bool | None = None
    """Where it moves to, as long as it does."""

    def move(self, close: bool, now: float) -> None:
        self.closed = None
        self.wanted = close
        self.since = now

    def arrives(self, now: float) -> bool:
        """Return whether it has got there since the last look."""
        if self.wanted is None or now - self.since < self.moves_for:
            return False
        self.closed = self.wanted
        self.wanted = None
        return True


class Around:
    """The world in which vehicles are, and where its map lies."""

    def __init__(self, surroundings: Surroundings, plane: LocalPlane) -> None:
        # without what moves: a tracker tells that
        self._world = World(surroundings.seed, Airspace(), surroundings.data)
        self._plane = plane

    def measure(self, quantity: str, place: Degrees, now: float) -> float:
        return self._world.measure(quantity, self._plane.to_metres(place), now)

    def sight(self, place: Degrees, now: float) -> str:
        """Return what a picture shows, as it stands behind its address: `?sharpness=1&sees=bloom*2,pest`."""
        photo = self._world.photo(self._plane.to_metres(place), now)
        sees = ",".join(_counted(photo.sees))
        return f"?sharpness={photo.sharpness:g}&sees={sees}"


def _counted(kinds: tuple[str, ...]) -> Iterator[str]:
    for kind, times in Counter(kinds).items():
        yield quote(kind, safe="") + (f"*{times}" if times > 1 else "")


_ANY_OTHER = "*"
_NOTHING = "nothing"
"""The name of a value that is that of all quantities which there are not in its world."""


def sensors(given: Mapping[str, object], world: World) -> dict[str, str]:
    """Return the names of what a simulated vehicle tells in a world, by quantity: those of its options come first."""
    named = given.get("measure")
    there = enumerate(quantities_in(world))
    return {
        _ANY_OTHER: _NOTHING,
        **{quantity: _name(quantity, number) for number, quantity in there},
        **(named if isinstance(named, Mapping) else {}),
    }


def fitted(given: Mapping[str, object], measure: Mapping[str, str]) -> dict[str, object]:
    """Return the options of a simulated vehicle: those of the fleet file, and a gripper and sensors."""
    return {"grip": {"number": 1}, **given, "measure": measure}


def _name(quantity: str, number: int) -> str:
    return quantity if len(quantity) <= LONGEST_NAME else f"q{number}"
