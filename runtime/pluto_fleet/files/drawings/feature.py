"""What is in a drawing of another program, whatever its format: places, ways and areas in degrees."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum
from math import isfinite
from typing import NamedTuple

from ...shared.domain.text import cut_off, printable, quoted
from ...shared.domain.values import LONGEST_NAME

GEOJSON = "GeoJSON"
KML = "KML"
PLAN = "a plan of QGroundControl"
WAYPOINTS = "a list of waypoints of a ground station"
LIST = "a list of places"
"""What messages call the files that are taken."""

MOST_FEATURES = 10_000
MOST_SPOTS = 200_000
"""The most features of a drawing, and the most places and corners of all of them."""


CUT_OFF = "; if it was cut off, save it again"
"""What there is to do about a file that ends too soon, as a message continues."""


class Kind(Enum):
    """What a feature is."""

    PLACE = "place"
    ROUTE = "route"
    AREA = "area"
    NO_FLY = "no-fly area"


class Spot(NamedTuple):
    """A place on the Earth: latitude and longitude of WGS 84, in degrees."""

    latitude: float
    longitude: float
    height: float | None = None
    """In metres above the ground where the map's z is 0."""
    altitude: float | None = None
    """In metres above sea level. One of the two is given, or none."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Feature:
    """Something that was drawn."""

    kind: Kind
    who: str
    """What messages call it."""
    name: str | None = None
    spots: tuple[Spot, ...]
    """One of a place; the corners of an area, in their order, the first not twice."""
    has_holes: bool = False
    """Whether something is cut out of the area."""
    said: Mapping[str, object] = field(default_factory=dict)
    """What the file says of it besides, by the names that it has there."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Drawing:
    """All that is in a file."""

    what: str
    """What the file is, such as "KML"."""
    features: tuple[Feature, ...]
    notes: tuple[str, ...] = ()
    """What was left out, in sentences."""


class Unusable(ValueError):
    """What is wrong with a drawing; the message continues after the name of the file."""


def spot(
    latitude: object,
    longitude: object,
    who: str,
    height: float | None = None,
    altitude: float | None = None,
) -> Spot:
    """Return a place; raise `Unusable` if these are no degrees."""
    return Spot(
        _degrees(latitude, 90.0, f"{who} has a latitude"),
        _degrees(longitude, 180.0, f"{who} has a longitude"),
        number_in(height),
        number_in(altitude),
    )


def _degrees(value: object, most: float, who: str) -> float:
    found = number_in(value)
    if found is None:
        raise Unusable(f"{who} that is no number of degrees")
    if abs(found) > most:
        save = "save it in WGS 84, which is EPSG:4326"
        raise Unusable(f"{who} of {found:g}, which is none in degrees: {save}")
    return found


def number_in(value: object) -> float | None:
    """Return a number that something is, if it is one."""
    if isinstance(value, bool) or not isinstance(value, int | float):
        return None
    return float(value) if isfinite(value) else None


def corners(spots: Sequence[Spot], who: str) -> tuple[Spot, ...]:
    """Return the corners of an area, of which files often have the first again at the end."""
    found = [one for one, before in zip(spots, (None, *spots), strict=False) if one != before]
    while len(found) > 1 and found[0][:2] == found[-1][:2]:
        found.pop()
    if len(found) < 3:
        raise Unusable(f"{who} is no area: it has fewer than three corners")
    return tuple(found)


_NO_FLY = re.compile(r"\bno[ _-]?fly\b|\bnfz\b", re.IGNORECASE)


def is_no_fly(*names: object) -> bool:
    """Return whether one of these names says that something is a no-fly area."""
    return any(isinstance(name, str) and _NO_FLY.search(name[:1000]) for name in names)


def name_in(value: object) -> str | None:
    """Return the name of a feature as plans may have it, if this is one."""
    if isinstance(value, bool) or not isinstance(value, str | int | float):
        return None
    text = printable(" ".join(str(value).split()))
    return cut_off(text, LONGEST_NAME) or None


def called(what: str, number: int, name: str | None) -> str:
    """Return what messages call a feature: `feature 3, "North"`."""
    return f"{what} {number}" + (f", {quoted(name)}," if name else "")


def refuse_if_many(features: Sequence[Feature]) -> None:
    """Raise `Unusable` if a drawing has more than a plan can have."""
    if len(features) > MOST_FEATURES:
        raise Unusable(f"has more than {MOST_FEATURES:,} features")
    if sum(len(one.spots) for one in features) > MOST_SPOTS:
        raise Unusable(f"has more than {MOST_SPOTS:,} places and corners")
