"""What another program has drawn, as a missions file has it: in metres of the map, a mission for each feature."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from itertools import count
from typing import Any

from ..app import App
from ..geodesy import LocalPlane
from ..shared.alone.files import with_fields
from ..shared.domain.actions import PHOTO
from ..shared.domain.errors import BadInput
from ..shared.domain.fields import Entity
from ..shared.domain.model import Mission, Point
from ..shared.domain.text import counted
from ..shared.domain.values import Read
from .drawings.feature import Drawing, Feature, Kind, Spot, Unusable, name_in
from .drawings.on_map import metres_of
from .lists import is_number
from .reading import Document

_OF_AREA = ("spacing", "height")
Data = dict[str, Any]


def take_drawing(document: Document, app: App) -> None:
    """Replace a document's drawing by the missions that it makes; raise `BadInput` if it makes none.

    A property of a feature that is called as a field of the app is that field; so are `action`, which is a photo
    otherwise, `parameters`, and of an area its `spacing`. Features with the same `mission` are one mission.
    """
    drawing = document.drawing
    assert drawing is not None
    plane = document.landmarks.plane
    try:
        if plane is None:
            raise Unusable(no_origin(drawing))
        missions = _Missions(plane, app)
        for feature in drawing.features:
            if feature.kind is not Kind.NO_FLY:
                missions.add(feature)
        if not missions.made:
            raise Unusable(f"is {drawing.what}, and has no places and no areas")
    except Unusable as error:
        raise BadInput(f"{document.name}: {error}") from None
    document.notes += drawing.notes
    if closed := sum(one.kind is Kind.NO_FLY for one in drawing.features):
        said = f"{counted(closed, 'no-fly area')} in it"
        document.notes.append(f"{said}: `pluto-fleet map` puts such into a fleet file")
    document.data = {"mission": missions.made}
    document.drawing = None
    document.is_made = True


def no_origin(drawing: Drawing) -> str:
    """Say that a map needs an origin, and a good one for this drawing."""
    spots = [spot for feature in drawing.features for spot in feature.spots]
    said = f"is {drawing.what}, whose places are degrees on the Earth, and the map has no origin"
    if not spots:
        return said
    south = min(one.latitude for one in spots)
    west = min(one.longitude for one in spots)
    such = f"origin = {{ latitude = {south:.6f}, longitude = {west:.6f} }}"
    return f"{said}: write one below [map] of the fleet file, such as {such}"


class _Missions:
    """The missions that have been made so far."""

    def __init__(self, plane: LocalPlane, app: App) -> None:
        self.made: list[Data] = []
        self._plane = plane
        self._of_mission = with_fields(app, Entity.MISSION, {}, {})[1]
        self._of_trip = with_fields(app, Entity.TRIP, {}, {})[1]
        self._by_name: dict[str, Data] = {}

    def add(self, feature: Feature) -> None:
        """Add what a feature makes: trips, or an area."""
        mission = self._mission(feature)
        common = {"action": feature.said.get("action", PHOTO)}
        common |= _fields(feature.said, self._of_trip)
        if isinstance(feature.said.get("parameters"), dict):
            common["parameters"] = feature.said["parameters"]
        if feature.kind is Kind.AREA:
            mission.setdefault("area", []).append({**self._area(feature), **common})
            return
        trips: list[Data] = mission.setdefault("trip", [])
        for spot in feature.spots:
            trip = {**common, "target": metres_of(self._plane, spot, feature.who)}
            if feature.kind is Kind.PLACE and "mission" in feature.said and feature.name:
                trip = {"name": _free(feature.name, [one.get("name") for one in trips]), **trip}
            trips.append(trip)

    def _mission(self, feature: Feature) -> Data:
        """Return the mission that a feature belongs to; usually a new one."""
        together = name_in(feature.said.get("mission"))
        if together in self._by_name:
            return self._by_name[together]
        fields = _fields(feature.said, self._of_mission)
        mission: Data = dict(fields)
        name = together or feature.name
        if name:
            mission = {"name": _free(name, self._by_name), **mission}
            self._by_name[mission["name"]] = mission
        self.made.append(mission)
        return mission

    def _area(self, feature: Feature) -> Data:
        if feature.has_holes:
            raise Unusable(
                f"{feature.who} has a hole, and an area is flown over as a whole:"
                " cut it in two, or draw the hole as a no-fly area"
            )
        if "spacing" not in feature.said:
            raise Unusable(
                f"{feature.who} is an area, and does not say how far its places are apart: give it a"
                ' property spacing, such as "10 m"; or make it a zone of the map with `pluto-fleet map`'
            )
        corners = [metres_of(self._plane, Spot(*one[:2]), feature.who) for one in feature.spots]
        given = {key: _plain(feature.said[key]) for key in _OF_AREA if key in feature.said}
        return {"polygon": corners, **given}


def _fields(said: Mapping[str, object], keys: Mapping[str, Read | None]) -> Data:
    """Return what a feature says of fields that the app has."""
    return {
        key: _as_wanted(read, said[key])
        for key, read in keys.items()
        if read is not None and key in said
    }


def _as_wanted(read: Read, value: object) -> object:
    """Return a value as the field takes it: a text of a list may be a number."""
    with suppress(ValueError):
        read(value)
        return value
    return _plain(value)


def _plain(value: object) -> object:
    """Return a number that a text is written as, or the value itself."""
    if not isinstance(value, str):
        return value
    if value.lower() in ("true", "false"):
        return value.lower() == "true"
    if not is_number(value):
        return value
    return float(value) if set(value) & set(".eE") else int(value)


def _free(name: str, taken: Sequence[object] | Mapping[str, object]) -> str:
    """Return a name that is not taken yet: `North`, or else `North 2`."""
    if name not in taken:
        return name
    return next(such for number in count(2) if (such := f"{name} {number}") not in taken)


def features_of(missions: Sequence[Mission[Any]], plane: LocalPlane) -> list[Feature]:
    """Return the trips of missions as places, in degrees; what they have beside names and actions is left out."""
    return [
        Feature(
            kind=Kind.PLACE,
            who=trip.name,
            name=trip.name,
            spots=(_spot_of(plane, trip.target),),
            said={"mission": mission.name, "action": trip.action},
        )
        for mission in missions
        for trip in mission.trips
    ]


def _spot_of(plane: LocalPlane, place: Point) -> Spot:
    latitude, longitude, _ = plane.to_degrees(place)
    return Spot(latitude, longitude, height=place[2])
