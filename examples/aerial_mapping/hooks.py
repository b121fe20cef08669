"""Would the photos of the site make one map? If not, which must be taken again (thesis 6.1.3)?"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import partial
from math import dist, inf
from typing import NamedTuple

from . import Mission, Photo, Results, Trip, Verdict

SHARP = 0.7
"""The least sharpness of a photo on the map."""

AHEAD = 0.55
"""The share of its ground that a photo must have in common with the next one of its strip."""

ASIDE = 0.25
"""The same for photos of two strips side by side."""

STRIP = 0.5
"""Metres: places that are no further apart across the strips are of one strip."""

TRIES = 6
"""How many photos are taken of one place before the mission gives up."""


class Place(NamedTuple):
    """Where the map needs a photo: where a trip ends, or on its way there."""

    x: float
    y: float


def stitches(mission: Mission, results: Results) -> Verdict:
    """Have retaken what would spoil the map: blurred photos, and one of each pair too far apart.

    All photos are judged together, those of other missions included; but a mission has only its own retaken: by the
    same trip, or by one to that place alone, if that was on the way.
    """
    photos = photos_of(results)
    shots = best(photos)
    bad = {place: "blurred" if photos[place] else "missing" for place in photos.keys() - shots}
    for one, other, least in neighbours(photos):
        if {one, other} & bad.keys() or not would_overlap(one, other, shots, least):
            continue
        if overlap(shots[one], shots[other]) < least:
            # The one further off its place is to blame.
            bad[max(one, other, key=lambda place: off(place, shots[place]))] = "overlaps too little"
    redo: list[Trip] = []
    add: list[Trip] = []
    log: list[str] = []
    own = places_of_all(mission.completed_trips)
    for place, (trip, name) in own.items():
        why = bad.get(place)
        if why is None:
            continue
        if len(photos[place]) >= TRIES:
            return Verdict(fail=f"photo {name} still {why} after {TRIES} tries")
        log.append(f"photo {name} {why}: it is taken again")
        if trip.along is None:
            redo.append(trip)
        else:
            add.append(Trip(name=name, action="take_photo", target=(*place, trip.target[2])))
    if not log:
        log.append(f"{len(own)} photos fit the map")
    return Verdict(redo=tuple(redo), add=tuple(add), log=tuple(log))


def places_of(trip: Trip) -> list[Place]:
    """Return the places of which a trip takes a photo, to the centimetre."""
    x, y, _ = trip.target
    if trip.along is None or trip.source is None:
        return [Place(round(x, 2), round(y, 2))]
    start_x, start_y, _ = trip.source
    parts = max(1, round(dist(trip.source, trip.target) / trip.along.get("metres", inf)))
    shares = [number / parts for number in range(parts + 1)]
    return [
        Place(round(start_x + share * (x - start_x), 2), round(start_y + share * (y - start_y), 2))
        for share in shares
    ]


def places_of_all(trips: Iterable[Trip]) -> dict[Place, tuple[Trip, str]]:
    """Return for each place the last of these trips that takes a photo of it, and the photo's name."""
    found: dict[Place, tuple[Trip, str]] = {}
    for trip in trips:
        for number, place in enumerate(places_of(trip), 1):
            found[place] = trip, trip.name if trip.along is None else f"{trip.name}, {number}"
    return found


def photos_of(results: Results) -> dict[Place, list[Photo]]:
    """Return the photos of each place, of all missions; of a place on the way there may be none."""
    photos: dict[Place, list[Photo]] = {}
    for result in results.all:
        if isinstance(result.value, Photo):
            places = places_of(result.trip)
            for place in places:
                photos.setdefault(place, [])
            nearest = min(places, key=partial(dist, result.value.position[:2]))
            photos[nearest].append(result.value)
    return photos


def best(photos: Mapping[Place, Sequence[Photo]]) -> dict[Place, Photo]:
    """Return the sharp photo of each place that is nearest to it, where there is one."""
    sharp = {
        place: [photo for photo in taken if photo.sharpness >= SHARP]
        for place, taken in photos.items()
    }
    return {place: min(taken, key=partial(off, place)) for place, taken in sharp.items() if taken}


def off(place: Place, photo: Photo) -> float:
    """Return how many metres beside its place a photo was taken."""
    return dist(place, photo.position[:2])


def neighbours(places: Iterable[Place]) -> Iterator[tuple[Place, Place, float]]:
    """Yield each two places side by side, with the share of ground that their photos must have in common."""
    known = [*places]
    for one in known:
        ahead = [b for b in known if abs(b.y - one.y) <= STRIP and b.x > one.x + STRIP]
        aside = [b for b in known if abs(b.x - one.x) <= STRIP and b.y > one.y + STRIP]
        if ahead:
            yield one, min(ahead, key=lambda place: place.x), AHEAD
        if aside:
            yield one, min(aside, key=lambda place: place.y), ASIDE


def would_overlap(one: Place, other: Place, shots: Mapping[Place, Photo], least: float) -> bool:
    """Return whether photos would have so much in common if each had been taken right at its place."""
    a, b = (
        replace(shots[place], position=(*place, shots[place].position[2])) for place in (one, other)
    )
    return overlap(a, b) >= least


def overlap(a: Photo, b: Photo) -> float:
    """Return the share of the smaller photo's ground that the other one shows too."""
    wide = (a.width + b.width) / 2 - abs(a.position[0] - b.position[0])
    high = (a.height + b.height) / 2 - abs(a.position[1] - b.position[1])
    common = max(0.0, min(wide, a.width, b.width)) * max(0.0, min(high, a.height, b.height))
    return common / min(a.width * a.height, b.width * b.height)
