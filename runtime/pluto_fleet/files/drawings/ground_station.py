"""Plans of ground stations: QGroundControl's `.plan`, and the waypoints of Mission Planner (`QGC WPL 110`).

Of a plan the places are taken, the areas of its surveys, and what its fence keeps vehicles out of. Taking off, landing
and flying home are no places: every flight does them by itself.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from math import cos, pi, sin
from typing import Any

from ...geodesy import LocalPlane
from ...process.untrusted import parsed
from .feature import (
    CUT_OFF,
    PLAN,
    WAYPOINTS,
    Drawing,
    Feature,
    Kind,
    Spot,
    Unusable,
    corners,
    number_in,
    refuse_if_many,
    spot,
)

_PLACES = {16, 17, 18, 19, 31, 82}
"""The commands of MAVLink that fly to a place: waypoints, loitering, splines."""
_BY_ITSELF = {20, 21, 22, 84, 85, 189, 203, 2000}
"""Those of what every flight does by itself: taking off, landing, flying home; and of a photo at a place."""
_ODD: dict[float, str] = {
    178: "changes of speed",
    201: "regions of interest",
    195: "regions of interest",
    197: "regions of interest",
    206: "camera triggers by distance",
    2001: "camera triggers by distance",
    2500: "videos",
    2501: "videos",
    93: "waits",
    112: "waits",
    177: "jumps",
    183: "servos",
    211: "grippers",
}
"""What is left out, and told."""
_RELATIVE = {3, 6}
_OVER_GROUND = {10, 11}
_ON_EARTH = {0, 3, 5, 6, 10, 11}
"""The frames of MAVLink: heights above home, above the ground; with places in degrees."""
_CORNERS = 24
"""Of a circle, which is drawn around what it keeps out."""


@dataclass(slots=True)
class _Found:
    """What has been found so far."""

    route: list[Spot] = field(default_factory=list)
    features: list[Feature] = field(default_factory=list)
    odd: Counter[str] = field(default_factory=Counter)

    def drawing(self, what: str) -> Drawing:
        if self.route:
            route = Feature(kind=Kind.ROUTE, who="its route", spots=tuple(self.route))
            self.features.insert(0, route)
        refuse_if_many(self.features)
        notes = [f"{what} are left out: {count}" for what, count in sorted(self.odd.items())]
        return Drawing(what=what, features=tuple(self.features), notes=tuple(notes))


def read(text: str) -> Drawing:
    """Return what is in a `.plan`; raise `Unusable` with what is wrong."""
    try:
        data = parsed(text)
    except ValueError as error:
        raise Unusable(f"cannot be read as {PLAN}: {error}{CUT_OFF}") from None
    if not isinstance(data, dict) or data.get("fileType") != "Plan":
        raise Unusable("is of QGroundControl, but no plan of it: export the whole plan")
    found = _Found()
    for number, item in enumerate(_dicts(_table(data, "mission").get("items")), 1):
        if item.get("type") == "ComplexItem":
            _complex(item, number, found)
        else:
            _simple(item, number, found)
    _fence(_table(data, "geoFence"), found)
    return found.drawing(PLAN)


def _simple(item: Mapping[str, Any], number: int, found: _Found) -> None:
    params = item.get("params")
    if isinstance(params, list) and len(params) == 7:
        command = number_in(item.get("command"))
        frame = number_in(item.get("frame"))
        _waypoint(command, frame, params[4:], f"item {number}", found)


def _waypoint(
    command: float | None, frame: float | None, at: Sequence[Any], who: str, found: _Found
) -> None:
    if command in _PLACES and frame in _ON_EARTH:
        latitude, longitude, up = at
        is_relative = frame in _RELATIVE or frame in _OVER_GROUND
        height, altitude = (up, None) if is_relative else (None, up)
        found.route.append(spot(latitude, longitude, who, height, altitude))
    elif command not in _BY_ITSELF:
        found.odd[_ODD.get(command or 0, "other commands")] += 1


def _complex(item: Mapping[str, Any], number: int, found: _Found) -> None:
    if item.get("complexItemType") != "survey":
        found.odd["scans of corridors and structures, and landing patterns"] += 1
        return
    who = f"survey {sum(one.kind is Kind.AREA for one in found.features) + 1} (item {number})"
    camera = _table(_table(item, "TransectStyleComplexItem"), "CameraCalc")
    prints = [camera.get(f"AdjustedFootprint{one}") for one in ("Frontal", "Side")]
    sides = [one for one in prints if isinstance(one, int | float) and one > 0]
    said: dict[str, object] = {"spacing": round(min(sides), 2)} if sides else {}
    is_relative = camera.get("DistanceToSurfaceRelative", camera.get("DistanceMode") in (None, 1))
    height = camera.get("DistanceToSurface")
    if is_relative and isinstance(height, int | float):
        said["height"] = height
    outline = corners([_pair(one, who) for one in _list(item.get("polygon"))], who)
    found.features.append(Feature(kind=Kind.AREA, who=who, spots=outline, said=said))


def _fence(fence: Mapping[str, Any], found: _Found) -> None:
    """Take what the fence keeps vehicles out of; within what, is the map's."""
    for number, one in enumerate(_dicts(fence.get("polygons")), 1):
        who = f"polygon {number} of the fence"
        if one.get("inclusion") is not False:
            found.odd["fences to stay within"] += 1
            continue
        outline = corners([_pair(at, who) for at in _list(one.get("polygon"))], who)
        found.features.append(Feature(kind=Kind.NO_FLY, who=who, spots=outline))
    for number, one in enumerate(_dicts(fence.get("circles")), 1):
        who = f"circle {number} of the fence"
        circle = _table(one, "circle")
        if one.get("inclusion") is not False:
            found.odd["fences to stay within"] += 1
            continue
        outline = _around(_pair(circle.get("center"), who), circle.get("radius"), who)
        found.features.append(Feature(kind=Kind.NO_FLY, who=who, spots=outline))


def _around(middle: Spot, radius: Any, who: str) -> tuple[Spot, ...]:
    """Return the corners of a polygon around a circle."""
    if isinstance(radius, bool) or not isinstance(radius, int | float) or not 0 < radius <= 10_000:
        raise Unusable(f"{who} has no radius of up to 10 km")
    plane = LocalPlane(middle.latitude, middle.longitude)
    far = radius / cos(pi / _CORNERS)
    turns = [2 * pi * number / _CORNERS for number in range(_CORNERS)]
    return tuple(
        Spot(*plane.to_degrees((far * sin(turn), far * cos(turn), 0.0))[:2]) for turn in turns
    )


def _pair(value: Any, who: str) -> Spot:
    if not isinstance(value, list) or len(value) < 2:
        raise Unusable(f"{who} has a corner without latitude and longitude")
    return spot(value[0], value[1], who)


def _table(data: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    found = data.get(key)
    return found if isinstance(found, dict) else {}


def _list(value: Any) -> list[Any]:
    return value if isinstance(value, list) else []


def _dicts(value: Any) -> Iterator[dict[str, Any]]:
    return (one for one in _list(value) if isinstance(one, dict))


# Waypoints


def read_waypoints(text: str) -> Drawing:
    """Return what is in a list of waypoints; raise `Unusable` with what is wrong."""
    first, *lines = text.splitlines()
    if first.split()[:3] != ["QGC", "WPL", "110"]:
        raise Unusable("is a list of waypoints of another version than 110: save it again")
    found = _Found()
    for row, line in enumerate(lines, 2):
        if not line.strip():
            continue
        parts = line.split()
        try:
            number, _, frame, command = (int(float(part)) for part in parts[:4])
            at = [float(part) for part in parts[8:11]]
        except (ValueError, OverflowError):
            raise Unusable(f"has no waypoint in row {row}: a row has 12 numbers") from None
        if len(at) < 3:
            raise Unusable(f"has no waypoint in row {row}: a row has 12 numbers")
        if number:  # the first is home
            _waypoint(command, frame, at, f"the waypoint in row {row}", found)
    return found.drawing(WAYPOINTS)
