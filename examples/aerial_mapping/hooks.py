"""Would the photos of the site make one map? If not, which must be taken again (thesis 6.1.3)?"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import combinations
from math import dist

from . import Mission, Photo, Results, Trip, Verdict

SHARP = 0.7
"""The least sharpness of a photo on the map."""

AHEAD = 0.55
"""The share of its ground that a photo must have in common with the next one of its strip."""

ASIDE = 0.25
"""The same for photos of two strips side by side."""

STRIP = 0.5
"""Metres: photos whose targets are no further apart across the strips are of one strip."""

TRIES = 6
"""How often one photo is taken before the mission gives up."""

Photos = Mapping[Trip, Photo]


def stitches(mission: Mission, results: Results) -> Verdict:
    """Have retaken what would spoil the map: blurred photos, and one of each pair too far apart.

    All photos are judged together, those of other missions included; but a mission has only its
    own trips flown again.
    """
    photos = latest(results)
    bad = {trip: "blurred" for trip, photo in photos.items() if photo.sharpness < SHARP}
    for one, other in combinations(photos, 2):
        if one not in bad and other not in bad and too_far_apart(one, other, photos):
            # The one further off its target is to blame.
            bad[max(one, other, key=lambda trip: off_target(trip, photos))] = "overlaps too little"
    redo = {trip: why for trip, why in bad.items() if trip in mission.completed_trips}
    for trip, why in redo.items():
        if sum(result.trip is trip for result in results.all) >= TRIES:
            return Verdict(fail=f"photo {trip.name} still {why} after {TRIES} tries")
    log = [f"photo {trip.name} {why}: it is taken again" for trip, why in redo.items()]
    if not redo:
        log.append(f"{len(mission.completed_trips)} photos fit the map")
    return Verdict(redo=tuple(redo), log=tuple(log))


def latest(results: Results) -> dict[Trip, Photo]:
    """Return the last photo of each trip, of all missions."""
    return {result.trip: result.value for result in results.all if isinstance(result.value, Photo)}


def too_far_apart(one: Trip, other: Trip, photos: Photos) -> bool:
    """Say whether two photos are of neighbouring places and show too little of the same ground."""
    along, across = (abs(a - b) for a, b in zip(one.target[:2], other.target[:2], strict=True))
    a, b = photos[one], photos[other]
    if across <= STRIP:
        return along < a.width * (1 - AHEAD) and overlap(a, b) < AHEAD
    if along <= STRIP:
        return across < a.height * (1 - ASIDE) and overlap(a, b) < ASIDE
    return False


def overlap(a: Photo, b: Photo) -> float:
    """Return the share of a photo's ground that the other one shows too."""
    wide = (a.width + b.width) / 2 - abs(a.position[0] - b.position[0])
    high = (a.height + b.height) / 2 - abs(a.position[1] - b.position[1])
    return max(0.0, wide) * max(0.0, high) / (a.width * a.height)


def off_target(trip: Trip, photos: Photos) -> float:
    """Return how many metres beside its target a photo was taken."""
    return dist(trip.target[:2], photos[trip].position[:2])
