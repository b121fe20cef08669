"""Would the photos of the site make one map? If not, which must be taken again (thesis 6.1.3)?"""

from __future__ import annotations

from itertools import combinations
from math import dist
from typing import NamedTuple

from . import Mission, Photo, Result, Results, Verdict

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


class Shot(NamedTuple):
    """The last photo of a trip."""

    result: Result
    photo: Photo

    @property
    def off_target(self) -> float:
        """How many metres beside its target it was taken."""
        return dist(self.result.trip.target[:2], self.photo.position[:2])


def stitches(mission: Mission, results: Results) -> Verdict:
    """Have retaken what would spoil the map: blurred photos, and one of each pair too far apart.

    All photos are judged together, those of other missions included; but a mission has only its
    own trips flown again.
    """
    shots = latest(results)
    bad = {shot: "blurred" for shot in shots if shot.photo.sharpness < SHARP}
    for one, other in combinations(shots, 2):
        if one not in bad and other not in bad and too_far_apart(one, other):
            # The one further off its target is to blame.
            bad[max(one, other, key=lambda shot: shot.off_target)] = "overlaps too little"
    redo = {shot.result.trip: why for shot, why in bad.items() if shot.result.mission is mission}
    for trip, why in redo.items():
        if sum(result.trip is trip for result in results.all) >= TRIES:
            return Verdict(fail=f"photo {trip.name} still {why} after {TRIES} tries")
    log = [f"photo {trip.name} {why}: it is taken again" for trip, why in redo.items()]
    if not redo:
        log.append(f"{len(mission.completed_trips)} photos fit the map")
    return Verdict(redo=tuple(redo), log=tuple(log))


def latest(results: Results) -> list[Shot]:
    """Return the last photo of each trip, of all missions."""
    shots = {
        result.trip: Shot(result, result.value)
        for result in results.all
        if isinstance(result.value, Photo)
    }
    return list(shots.values())


def too_far_apart(one: Shot, other: Shot) -> bool:
    """Return whether two photos are of neighbouring places and show too little of the same ground."""
    (x, y, _), (other_x, other_y, _) = one.result.trip.target, other.result.trip.target
    along, across = abs(x - other_x), abs(y - other_y)
    if across <= STRIP:
        return along < one.photo.width * (1 - AHEAD) and overlap(one.photo, other.photo) < AHEAD
    if along <= STRIP:
        return across < one.photo.height * (1 - ASIDE) and overlap(one.photo, other.photo) < ASIDE
    return False


def overlap(a: Photo, b: Photo) -> float:
    """Return the share of a photo's ground that the other one shows too."""
    wide = (a.width + b.width) / 2 - abs(a.position[0] - b.position[0])
    high = (a.height + b.height) / 2 - abs(a.position[1] - b.position[1])
    return max(0.0, wide) * max(0.0, high) / (a.width * a.height)
