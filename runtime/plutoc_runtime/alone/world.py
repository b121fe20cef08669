"""What the drones of a simulation would see and measure. The same seed is the same world."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import exp, inf
from random import Random
from typing import TYPE_CHECKING

from ..domain.actions import BUILT_IN, MEASURE
from ..domain.photos import take

if TYPE_CHECKING:
    from ..domain.actions import Plain
    from ..domain.airspace import Airspace
    from ..domain.geometry import Corner
    from ..domain.model import Photo, Point

BACKGROUND: Mapping[str, float] = {"temperature": 21.0, "pm10": 20.0}
"""What is measured far from every source, in `UNITS`. Any other quantity is 0 there."""

UNITS: Mapping[str, str] = {"temperature": "°C", "pm10": "µg/m³"}
"""What the numbers of a simulated world mean; any other quantity has the unit that its author had
in mind."""

_NOISE = 0.001
"""The sensors' error, as a share of what they measure."""

_KINDS = ("bloom", "pest", "disease")
_GROUND_EACH = 4.0
"""Square metres for each feature of a world that nobody described."""
_AT_MOST = 10_000
"""Features of such a world: more would take longer to make than the missions to fly."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Feature:
    """Something on the ground that a photo can show."""

    kind: str
    at: Corner
    radius: float = 0.3


@dataclass(frozen=True, slots=True, kw_only=True)
class Source:
    """Where a quantity is highest, by how much, and how far it spreads."""

    quantity: str
    at: Corner
    peak: float
    radius: float
    """Metres within which most of it stays: the standard deviation of a bell curve."""

    def at_distance(self, x: float, y: float) -> float:
        """Return what there is of it so many metres away, however narrow or wide it is."""
        away, spread = x * x + y * y, 2 * self.radius * self.radius
        if away == 0.0 or spread == inf:
            return self.peak
        return self.peak * exp(-away / spread) if spread > 0.0 else 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class WorldData:
    """A world as a fleet file describes it."""

    features: tuple[Feature, ...] = ()
    sources: tuple[Source, ...] = ()
    background: Mapping[str, float] = field(default_factory=dict)
    """Beside `BACKGROUND`, or instead of its numbers."""


class World:
    """What there is to see and to measure on a map; without data, one made up from the seed."""

    def __init__(
        self,
        seed: int,
        airspace: Airspace,
        data: WorldData | None = None,
    ) -> None:
        data = invented(seed, airspace) if data is None else data
        self.features, self.sources = data.features, data.sources
        self.background = {**BACKGROUND, **data.background}
        self._seed = seed
        self._by_x = sorted((*feature.at, feature.kind) for feature in self.features)

    def gives(
        self, action: str, parameters: Mapping[str, Plain], point: Point, time: float
    ) -> object:
        """Return what a built-in action gives that is done at a point."""
        if action == MEASURE:
            quantity = parameters.get("quantity", BUILT_IN[MEASURE].parameters[0].default)
            return self.measure(str(quantity), point, time)
        return self.photo(point, time) if action == "take_photo" else None

    def measure(self, quantity: str, point: Point, time: float) -> float:
        """Return what a sensor reads at a point, its small error included."""
        value = self.background.get(quantity, 0.0)
        for source in self.sources:
            if source.quantity == quantity:
                value += source.at_distance(point[0] - source.at[0], point[1] - source.at[1])
        error = self._random(quantity, point, time).gauss(0.0, _NOISE)
        return round(value * (1 + error), 3)

    def photo(self, point: Point, time: float) -> Photo:
        """Return a photo straight down from a point."""
        return take(point, self._by_x, self._random("photo", point, time))

    def _random(self, what: str, point: Point, time: float) -> Random:
        """Chance that depends on what happens, where and when, and on nothing that went before."""
        x, y, z = point
        return Random(f"{self._seed}/{what}/{x:.3f}/{y:.3f}/{z:.3f}/{time:.3f}")


def invented(seed: int, airspace: Airspace) -> WorldData:
    """Make up a world: something to find, two places with dust and a warm one."""
    chance = Random(f"{seed}/world")
    width, depth = airspace.size

    def somewhere() -> Corner:
        return round(chance.uniform(0, width), 3), round(chance.uniform(0, depth), 3)

    def source(quantity: str, lowest: float, highest: float) -> Source:
        peak = round(chance.uniform(lowest, highest), 1)
        spread = round(chance.uniform(0.05, 0.15) * min(width, depth), 3)
        return Source(quantity=quantity, at=somewhere(), peak=peak, radius=max(spread, 0.1))

    number = min(_AT_MOST, max(1, round(width * depth / _GROUND_EACH)))
    features = tuple(
        Feature(
            kind=chance.choice(_KINDS),
            at=somewhere(),
            radius=round(chance.uniform(0.1, 0.5), 2),
        )
        for _ in range(number)
    )
    sources = (
        source("pm10", 40, 120),
        source("pm10", 40, 120),
        source("temperature", 3, 8),
    )
    return WorldData(features=features, sources=sources)
