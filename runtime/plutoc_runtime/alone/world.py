"""The simulated world: what drones see and measure in it, and what befalls them.

The same seed gives the same world. Faults are drawn for each flight at its start from its id alone.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Mapping
from dataclasses import dataclass, fields
from math import inf
from operator import attrgetter
from random import Random
from typing import TYPE_CHECKING

from ..domain.errors import Failure
from ..domain.fleet_data import Feature, Source, WorldData
from ..domain.model import Photo
from ..domain.quantities import Type, parse_quantity
from ..domain.text import quoted

if TYPE_CHECKING:
    from ..domain.airspace import Airspace, Corner
    from ..domain.model import Point

BACKGROUND: Mapping[str, float] = {"temperature": 21.0, "pm10": 20.0}
"""What is measured far from every source, in °C and µg/m³. Any other quantity is 0 there."""

_NOISE = 0.001  # the sensors' error, as a share of what they measure

_KINDS = ("bloom", "pest", "disease")
_GROUND_EACH = 4.0  # square metres for each feature of a world that is made up
_AT_MOST = 10_000  # such features: more would take longer to make than the missions to fly

WIDTH = 1.6
HEIGHT = 1.2
"""Metres of ground on a photo for each metre of height: a 4:3 camera sees 77° across and 62° along."""
_DRIFT = 0.05  # the standard deviation of a drone's horizontal position, in metres
_at = attrgetter("at")
_BLURRED = 0.1  # the share of photos that are not sharp


class World:
    """What can be seen and measured on a map; without data it is made up from the seed."""

    def __init__(self, seed: int, airspace: Airspace, data: WorldData | None = None) -> None:
        data = invented(seed, airspace) if data is None else data
        self.features = sorted(data.features, key=_at)
        self.sources = data.sources
        self.background = {**BACKGROUND, **data.background}
        self.seed = seed

    def measure(self, quantity: str, point: Point, time: float) -> float:
        """Return what a sensor reads at a point, its small error included."""
        value = self.background.get(quantity, 0.0)
        for source in self.sources:
            if source.quantity == quantity:
                value += source.at_distance(point[0] - source.at[0], point[1] - source.at[1])
        error = self._random(quantity, point, time).gauss(0.0, _NOISE)
        return round(value * (1 + error), 3)

    def photo(self, point: Point, time: float) -> Photo:
        """Return a photo straight down from about this point.

        Each thing whose middle is on it is seen once, be the photo sharp or not.
        """
        chance = self._random("photo", point, time)
        x, y = (round(along + chance.gauss(0.0, _DRIFT), 3) for along in point[:2])
        z = round(point[2], 3)
        width = round(z * WIDTH, 3)
        height = round(z * HEIGHT, 3)
        first = bisect_left(self.features, (x - width / 2,), key=_at)
        end = bisect_left(self.features, (x + width / 2, inf), key=_at)
        near = self.features[first:end]
        sees = tuple(sorted(one.kind for one in near if abs(one.at[1] - y) <= height / 2))
        sharpness = round(chance.uniform(0.3, 0.6), 3) if chance.random() < _BLURRED else 1.0
        return Photo(position=(x, y, z), width=width, height=height, sees=sees, sharpness=sharpness)

    def _random(self, what: str, point: Point, time: float) -> Random:
        """Randomness that depends on the event, its place and its time, and not on earlier draws."""
        x, y, z = point
        return Random(f"{self.seed}/{what}/{x:.3f}/{y:.3f}/{z:.3f}/{time:.3f}")


def invented(seed: int, airspace: Airspace) -> WorldData:
    """Make up a world: something to find, two places with dust and a warm one."""
    chance = Random(f"{seed}/world")
    width, depth = airspace.size
    number = min(_AT_MOST, max(1, round(width * depth / _GROUND_EACH)))

    def somewhere() -> Corner:
        return round(chance.uniform(0, width), 3), round(chance.uniform(0, depth), 3)

    def feature() -> Feature:
        kind = chance.choice(_KINDS)
        return Feature(kind=kind, at=somewhere(), radius=round(chance.uniform(0.1, 0.5), 2))

    def source(quantity: str, lowest: float, highest: float) -> Source:
        peak = round(chance.uniform(lowest, highest), 1)
        spread = round(chance.uniform(0.05, 0.15) * min(width, depth), 3)
        return Source(quantity=quantity, at=somewhere(), peak=peak, radius=max(spread, 0.1))

    features = tuple(feature() for _ in range(number))
    dust = source("pm10", 40, 120), source("pm10", 40, 120)
    return WorldData(features=features, sources=(*dust, source("temperature", 3, 8)))


OUTAGE = 20.0  # seconds until a lost link is restored
CARRYING_HOME = 300.0  # seconds until someone has carried a drone home

BEFALL = {  # what happens at one moment of a flight
    Failure.CRASH: "crashed",
    Failure.LINK: "lost its link",
    Failure.BATTERY: "ran out of battery",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Faults:
    """The probability of each fault on a flight, from 0 to 1."""

    crash: float = 0.0
    link: float = 0.0
    action: float = 0.0
    battery: float = 0.0


FAULTS = tuple(fault.name for fault in fields(Faults))  # the faults of `--fail`


def draw(faults: Faults, seed: int, flight: str, seconds: float) -> dict[Failure, float]:
    """Draw the faults of `mission/trip/round/attempt`, so many seconds after its take-off at most."""
    drawn = dict[Failure, float]()
    if faults == Faults():
        return drawn
    chance = Random(f"{seed}/{flight}")
    for what in BEFALL:
        # Both numbers are drawn in any case, so one probability does not change the other's outcome.
        happens = chance.random() < getattr(faults, what.value)
        when = chance.random() * seconds
        if happens:
            drawn[what] = when
    if chance.random() < faults.action:
        drawn[Failure.ACTION] = inf  # at no moment by itself
    return drawn


def shares(text: str) -> dict[str, float]:
    """Read crash=10%,link=5%."""
    found: dict[str, float] = {}
    for part in text.split(","):
        what, equals, amount = (piece.strip() for piece in part.partition("="))
        if not equals:
            raise ValueError(f"{quoted(part)} is not written like crash=10%")
        if what not in FAULTS:
            raise ValueError(f"{quoted(what)} cannot go wrong; what can: {', '.join(FAULTS)}")
        if what in found:
            raise ValueError(f"{what} is given twice")
        try:
            found[what] = parse_quantity(amount, Type.PERCENT)
        except ValueError:
            wrong = f"{what}={amount} is not a percentage: write it like {what}=10%"
            raise ValueError(wrong) from None
        if not 0 <= found[what] <= 1:
            raise ValueError(f"{what}={amount} is not between 0% and 100%")
    return found
