"""Covers random areas, and looks whether anything that may be flown over is left out.

    python -m tests.areas --areas 1000

Each is read from a missions file: convex, concave and thin ones, some partly off the map, most with no-fly areas in
them. What is covered is judged by points strewn over the area, with the map of the brain and without the geometry
that has made the trips. The exit code is 1 if less than 99 % of an area is covered, or a trip may not be flown to,
or leads out of its area.
"""

from __future__ import annotations

import sys
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, cos, pi, sin
from random import Random

import shapely

from pluto_fleet.files.missions import missions_of
from pluto_fleet.files.reading import parsed
from pluto_fleet.files.toml import toml_text
from pluto_fleet.shared.domain.airspace import Airspace, Corner, Polygon, distance, inside
from pluto_fleet.shared.domain.errors import BadInput
from tests.kit.campaign import Campaign
from tests.library.files.an_app import APP

SIZE = (20.0, 15.0)
STREWN = 400
"""Points for each area."""
ENOUGH = 0.99
"""The least share of what may be flown over that must be covered."""
_NEARLY = 2e-6
"""Metres: trips are told to a micrometre."""


@dataclass(frozen=True, slots=True)
class Drawn:
    """An area that was drawn by chance."""

    kind: str
    corners: Polygon
    spacing: float
    airspace: Airspace


@dataclass(frozen=True, slots=True)
class Judged:
    """What has become of it."""

    trips: int
    covered: float
    """The share of what may be flown over."""
    wrong: Sequence[str]


# Drawing


def drawn(number: int) -> Drawn:
    """Return an area, the same for each number."""
    chance = Random(number)
    kind = chance.choice(list(_KINDS))
    corners = _KINDS[kind](chance)
    x, y = chance.uniform(-2, SIZE[0] - 4), chance.uniform(-2, SIZE[1] - 4)
    turn = 0.0 if kind == "box" else chance.choice([0.0, chance.uniform(0, 2 * pi)])
    moved = tuple(
        (a * cos(turn) - b * sin(turn) + x + 3, a * sin(turn) + b * cos(turn) + y + 3)
        for a, b in corners
    )
    spacing = chance.choice([0.5, 1.0, chance.uniform(0.4, 3.0)])
    no_fly = tuple(_obstacle(chance) for _ in range(chance.choice([0, 1, 2, 5])))
    return Drawn(kind, moved, spacing, Airspace(size=SIZE, no_fly=no_fly))


def _around(chance: Random, least: float = 0.2) -> list[Corner]:
    """Return corners around a point, in order: concave, and never crossing."""
    count = chance.randint(4, 12)  # of three, two may be on one side of the point
    angles = sorted(2 * pi * (i + chance.uniform(0.05, 0.95)) / count for i in range(count))
    far = [chance.uniform(least, 1.0) * 6 for _ in angles]
    return [(r * cos(a), r * sin(a)) for r, a in zip(far, angles, strict=True)]


def _convex(chance: Random) -> list[Corner]:
    """Return corners on an ellipse."""
    width, depth = chance.uniform(1, 7), chance.uniform(1, 7)
    count = chance.randint(3, 9)
    angles = sorted(2 * pi * (i + chance.uniform(0.1, 0.9)) / count for i in range(count))
    return [(width * cos(a), depth * sin(a)) for a in angles]


def _comb(chance: Random) -> list[Corner]:
    """Return a back with teeth, some of them longer than others."""
    teeth, wide, gap = chance.randint(2, 6), chance.uniform(0.1, 1.5), chance.uniform(0.1, 1.0)
    corners = [(0.0, 0.0)]
    for i in range(teeth):
        x, tall = i * (wide + gap), chance.uniform(1.0, 7.0)
        corners += [(x, 1.0), (x, tall + 1.0), (x + wide, tall + 1.0), (x + wide, 1.0)]
    return [*corners, (teeth * wide + (teeth - 1) * gap, 0.0)]


def _sliver(chance: Random) -> list[Corner]:
    """Return a strip as thin as a hair."""
    long, thin = chance.uniform(2, 15), 10 ** chance.uniform(-3, 0)
    return [(0.0, 0.0), (long, chance.uniform(0, thin)), (long, thin * 2), (0.0, thin)]


def _box(chance: Random) -> list[Corner]:
    """Return a box, as people draw."""
    wide, deep = chance.choice([1.0, 4.0, 8.0, 0.3]), chance.choice([1.0, 5.0, 7.5])
    return [(0.0, 0.0), (wide, 0.0), (wide, deep), (0.0, deep)]


_KINDS = {
    "around a point": _around,
    "convex": _convex,
    "comb": _comb,
    "sliver": _sliver,
    "box": _box,
}


def _obstacle(chance: Random) -> Polygon:
    """Return a no-fly area: small or large, concave too."""
    scale = chance.choice([0.05, 0.2, 0.5])
    x, y = chance.uniform(0, SIZE[0]), chance.uniform(0, SIZE[1])
    return tuple((x + scale * a, y + scale * b) for a, b in _around(chance, 0.3))


# Judging


def judged(area: Drawn, number: int) -> Judged:
    """Cover an area, and judge that."""
    points = strewn(area, number)
    entry = {
        "polygon": [list(corner) for corner in area.corners],
        "action": "take_photo",
        "spacing": area.spacing,
    }
    text = toml_text({"mission": [{"area": [entry]}]})
    try:
        [mission] = missions_of(parsed("area.toml", text), APP, area.airspace)
    except BadInput as error:
        nothing = "covers nothing that may be flown over" in str(error)
        least = len(points) <= (1 - ENOUGH) * STREWN
        return Judged(0, 1.0, [] if nothing and least else [f"it is refused: {error}"])
    targets = [trip.target for trip in mission.trips]
    wrong = [said for target in targets if (said := area.airspace.problem(target))]
    wrong += [
        f"({x}, {y}) is out of the area"
        for x, y, _ in targets
        if not inside((x, y), area.corners) and _from_edge((x, y), area.corners) > _NEARLY
    ]
    return Judged(len(targets), share_covered(points, targets, area.spacing), wrong)


def strewn(area: Drawn, number: int) -> list[Corner]:
    """Return points all over what may be flown over of an area."""
    points = _strewn(area.corners, Random(f"strewn {number}"))
    return [point for point in points if area.airspace.problem((*point, 0.0)) is None]


def _strewn(corners: Polygon, chance: Random) -> list[Corner]:
    """Return points all over a polygon."""
    triangles = shapely.constrained_delaunay_triangles(shapely.Polygon(corners)).geoms
    found = []
    for one in chance.choices(triangles, [one.area for one in triangles], k=STREWN):
        (ax, ay), (bx, by), (cx, cy), _ = one.exterior.coords
        s, t = chance.random(), chance.random()
        if s + t > 1:
            s, t = 1 - s, 1 - t
        found.append((ax + s * (bx - ax) + t * (cx - ax), ay + s * (by - ay) + t * (cy - ay)))
    return found


def _from_edge(point: Corner, polygon: Polygon) -> float:
    edges = zip(polygon, (*polygon[1:], polygon[0]), strict=True)
    return min(distance(point, a, b) for a, b in edges)


def share_covered(
    points: Sequence[Corner], targets: Sequence[Sequence[float]], spacing: float
) -> float:
    """Return the share of points in the square of this side around some target."""
    if not points:
        return 1.0
    near = defaultdict[tuple[int, int], list[Sequence[float]]](list)
    for target in targets:
        near[int(target[0] // spacing), int(target[1] // spacing)].append(target)
    half = spacing / 2 + _NEARLY
    covered = 0
    for x, y in points:
        column, row = int(x // spacing), int(y // spacing)
        around = [near.get((column + i, row + j), ()) for i in (-1, 0, 1) for j in (-1, 0, 1)]
        covered += any(
            abs(one[0] - x) <= half and abs(one[1] - y) <= half for cell in around for one in cell
        )
    return covered / len(points)


def main(arguments: Sequence[str] | None = None) -> int:
    """Cover areas, and print what is wrong."""
    campaign = Campaign("tests.areas", __doc__)
    campaign.draws("areas", 1000)
    campaign.parse(arguments)
    least, trips, cells = 1.0, 0, 0
    for number, found in campaign.each(_one, campaign.numbers):
        area = drawn(number)
        least, trips = min(least, found.covered), trips + found.trips
        cells += _cells(area) if found.trips else 0
        if found.wrong or found.covered < ENOUGH:
            what = f"area {number} ({area.kind}, {area.spacing:.3f} m)"
            campaign.found(f"{what}: {found.covered:.1%} covered", *found.wrong[:5])
    return campaign.over(
        f"each is covered to {least:.2%} at least",
        f"{trips} trips, where boxes around the areas have {cells} squares",
    )


def _one(number: int) -> Judged:
    return judged(drawn(number), number)


def _cells(area: Drawn) -> int:
    """Return how many squares the box around an area has, as sides are rounded up."""
    xs, ys = [x for x, _ in area.corners], [y for _, y in area.corners]
    wide, deep = max(xs) - min(xs), max(ys) - min(ys)
    return ceil(wide / area.spacing) * ceil(deep / area.spacing)


if __name__ == "__main__":
    sys.exit(main())
