"""Holds the metres of maps in degrees to those of PROJ, at random places of the Earth.

    python -m tests.geodesy --places 10000

Each is a map with its own origin and bearing, from pole to pole, and a place on it within 20 km. PROJ knows nothing
of a map's heights, which follow the ground: its plane is asked for the place at the level of the origin. The exit
code is 1 if a place is more than a millimetre off, does not come back to where it was to a millimetre, or to a
centimetre through a file of another program. What is printed beside that is by how much the map itself is wrong, as
every plane is: its straight lines against PROJ's geodesics, in maps at sea level.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from math import asin, atan2, cos, degrees, dist, hypot, pi, sin, sqrt
from random import Random

from pyproj import Geod, Transformer

from pluto_fleet.files.drawings.feature import Feature, Kind, Spot
from pluto_fleet.files.drawings.on_map import metres_of
from pluto_fleet.files.drawings.writing import WRITERS
from pluto_fleet.files.kinds import drawing_in
from pluto_fleet.geodesy import REACH, LocalPlane, Metres
from tests.kit.campaign import Campaign

ENOUGH = 0.001
"""Metres."""
ENOUGH_OF_FILES = 0.01
NEAR = 2_000.0
"""Metres: within them a map's lines are to be right to 5 cm."""


@dataclass(frozen=True, slots=True)
class Judged:
    """How far a place is from where it should be, in metres."""

    off: float
    back: float
    """After there and back again."""
    bent: float
    """By how much its distance from the origin differs from that along the ground."""
    far: float
    through_files: float
    """After it was written as each kind of drawing, and read again."""


def drawn(number: int) -> tuple[LocalPlane, Metres]:
    """Return a map and a place on it, the same for each number."""
    chance = Random(number)
    plane = LocalPlane(
        latitude=degrees(asin(chance.uniform(-1, 1))),
        longitude=chance.uniform(-180, 180),
        altitude=chance.choice([0.0, chance.uniform(-400, 5000)]),
        bearing=chance.choice([0.0, chance.uniform(-pi, pi)]),
    )
    far = REACH * sqrt(chance.random()) if number % 4 else NEAR * sqrt(chance.random())
    way = chance.uniform(0, 2 * pi)
    return plane, (far * cos(way), far * sin(way), chance.uniform(0, 1000))


def judged(number: int) -> Judged:
    """Compare one place with PROJ's."""
    plane, place = drawn(number)
    latitude, longitude, altitude = plane.to_degrees(place)
    x, y, z = place
    cartesian = _cartesian().transform
    theirs = Transformer.from_pipeline(
        f"+proj=topocentric +ellps=WGS84 +lat_0={plane.latitude!r} +lon_0={plane.longitude!r}"
        f" +h_0={plane.altitude!r}"
    )
    east, north, _ = theirs.transform(*cartesian(longitude, latitude, plane.altitude))
    turn = atan2(x, y) + plane.bearing
    far = hypot(x, y)
    off = dist((east, north, altitude), (far * sin(turn), far * cos(turn), plane.altitude + z))
    back = dist(plane.to_metres((latitude, longitude, altitude)), place)
    bent = 0.0
    if plane.altitude == 0.0:
        _, _, along = _geodesics().inv(plane.longitude, plane.latitude, longitude, latitude)
        bent = abs(along - far)
    return Judged(off, back, bent, far, through_files(plane, place))


def through_files(plane: LocalPlane, place: Metres) -> float:
    """Return how far a place is from where it was, in metres, after it was written and read as each kind of drawing."""
    latitude, longitude, _ = plane.to_degrees(place)
    spot = Spot(latitude, longitude, height=place[2])
    feature = Feature(kind=Kind.PLACE, who="it", name="A", spots=(spot,))
    worst = 0.0
    for write in WRITERS.values():
        drawing = drawing_in(write([feature]))
        assert drawing is not None
        [found] = drawing.features
        worst = max(worst, dist(metres_of(plane, found.spots[0], found.who), place))
    return worst


@cache
def _cartesian() -> Transformer:
    return Transformer.from_pipeline("+proj=pipeline +step +proj=cart +ellps=WGS84")


@cache
def _geodesics() -> Geod:
    return Geod(ellps="WGS84")


def main(arguments: Sequence[str] | None = None) -> int:
    """Compare places, and print the largest error."""
    campaign = Campaign("tests.geodesy", __doc__)
    campaign.draws("places", 10_000)
    campaign.parse(arguments)
    off, back, bent, bent_near, files = 0.0, 0.0, 0.0, 0.0, 0.0
    for number, found in campaign.each(judged, campaign.numbers):
        off, back, bent = max(off, found.off), max(back, found.back), max(bent, found.bent)
        if found.far <= NEAR:
            bent_near = max(bent_near, found.bent)
        files = max(files, found.through_files)
        if not (max(found.off, found.back) <= ENOUGH and found.through_files <= ENOUGH_OF_FILES):
            campaign.found(f"place {number}: {found}")
    return campaign.over(
        f"largest error {off * 1000:.6f} mm, there and back {back * 1000:.6f} mm",
        f"through GeoJSON, KML, .plan and CSV {files * 1000:.3f} mm",
        f"distances along the ground differ by {bent * 100:.2f} cm at most, {bent_near * 100:.4f} cm within 2 km",
    )


if __name__ == "__main__":
    sys.exit(main())
