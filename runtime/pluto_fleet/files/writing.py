"""Writing fleets and missions as files, and landmarks into a fleet file: all else in it keeps its bytes.

For that the file is cut at its headers. Of each part what stands before the end of its last value may be changed;
blank lines and comments behind that belong to what follows.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from itertools import dropwhile
from typing import Any

from ..app import App
from ..geodesy import LocalPlane
from ..jobs.reports import SILENCE
from ..shared.domain.errors import BadInput
from ..shared.domain.fields import Entity, FieldType
from ..shared.domain.fleet_data import WorldData
from ..shared.domain.model import Mission, Trip
from ..shared.domain.motion import CRAZYFLIE as CRAZYFLIE_MOTION
from ..shared.domain.motion import Motion, motion_of
from ..shared.domain.values import MOTION, KeyPath
from ..shared.events.declared import Along
from ..shared.events.world import Mover
from ..wind import Wind
from .fleet import CRAZYFLIE, OWN, DroneEntry, FleetFile
from .landmarks import Landmarks, Picture
from .toml import headers, places, toml_text, toml_value


def fleet_text(fleet: FleetFile) -> str:
    """Return the fleet file, without its floor plan, which lies beside the file that names it."""
    airspace = fleet.airspace
    of_map: dict[str, Any] = {
        "size": _floats(airspace.size),
        "cruise_height": float(airspace.cruise_height),
        "ceiling": float(airspace.ceiling),
    }
    if airspace.no_fly:
        of_map["no_fly"] = [[_floats(corner) for corner in area] for area in airspace.no_fly]
    north = 0.0 if fleet.plane else float(fleet.landmarks.north)
    shown = {"north": north, **landmark_tables(fleet.landmarks)}
    of_map |= {key: value for key, value in shown.items() if value}
    if fleet.plane:
        of_map |= _on_earth(fleet.plane)
    behaviour: dict[str, Any] = {
        "after_trip": fleet.after_trip.value,
        "apart": float(fleet.apart),
        "max_airborne": fleet.max_airborne,
        "silence": None if fleet.silence == SILENCE else fleet.silence,
        "charges_at_home": None if fleet.charges_at_home else False,
        "navigation": None if fleet.navigation == CRAZYFLIE else fleet.navigation,
        "localization": None if fleet.localization == OWN else fleet.localization,
        "tracker": fleet.tracker,
    }
    file: dict[str, Any] = {
        "map": of_map,
        "fleet": _given(behaviour),
        "motion": motion_data(fleet.motion) or None,
        "localization": fleet.localization_options or None,
        "tracker": fleet.tracker_options or None,
        "navigation": fleet.options or None,
        "drone": [_drone(drone) for drone in fleet.drones],
        "world": _world(fleet.world, fleet.wind),
    }
    return toml_text(_given(file))


def _on_earth(plane: LocalPlane) -> dict[str, Any]:
    """Return what says where a map lies; its bearing in radians, as that is exact."""
    origin = {key: getattr(plane, key) for key in ("latitude", "longitude", "altitude")}
    return {"origin": origin} | ({"bearing": plane.bearing} if plane.bearing else {})


def motion_data(motion: Motion) -> dict[str, Any]:
    """Return the `[motion]` of a fleet file: what differs from its defaults."""
    data = asdict(motion)
    usual = asdict(motion_of({"legs": motion.legs}))
    usual["legs"] = CRAZYFLIE_MOTION.legs
    return {key: data[key] for key in MOTION if data[key] != usual[key]}


def _drone(drone: DroneEntry) -> dict[str, Any]:
    return _given(
        {
            "id": drone.id,
            "category": drone.category,
            "home": _floats(drone.home if drone.home[2] else drone.home[:2]),
            "uri": drone.uri,
            "navigation": drone.navigation,
            "options": drone.options or None,
            "parameters": dict(drone.parameters) or None,
        }
    )


def _world(world: WorldData | None, wind: Wind | None) -> dict[str, Any] | None:
    """Return what there is to see, and the wind; its direction in radians, as that is exact."""
    blows = None if wind is None else {"speed": wind.speed, "from": wind.origin}
    if blows is not None and wind is not None and wind.gusts:
        blows["gusts"] = wind.gusts
    if world is None:
        return None if blows is None else {"wind": blows}
    given = {
        "background": {**world.background},
        "source": [asdict(source) | {"at": [*source.at]} for source in world.sources],
        "feature": [asdict(feature) | {"at": [*feature.at]} for feature in world.features],
        "mover": [_mover(mover) for mover in world.movers],
        "event": [*world.events],
    }
    return given if blows is None else {**given, "wind": blows}


def _mover(mover: Mover) -> dict[str, Any]:
    given = asdict(mover)
    return {**given, "path": [[*corner] for corner in mover.path], "from": given.pop("starts")}


def _floats(numbers: Sequence[float]) -> list[float]:
    return [float(number) for number in numbers]


def _given(table: dict[str, Any]) -> dict[str, Any]:
    """Leave out what is not given."""
    return {key: value for key, value in table.items() if value is not None}


def missions_text(app: App, missions: Sequence[Mission[Any]]) -> str:
    """Return the missions file."""
    return toml_text({"mission": [mission_table(app, mission) for mission in missions]})


def mission_table(app: App, mission: Mission[Any]) -> dict[str, Any]:
    """Return one mission of a missions file."""
    trips = [trip_table(app, trip) for trip in mission.trips]
    fields = {**_promises(mission), **_fields(app, Entity.MISSION, mission)}
    return {"name": mission.name, **fields, "trip": trips}


def _promises(mission: Mission[Any]) -> dict[str, Any]:
    """Return what is promised of a mission as a file says it."""
    said = mission.promises
    when = {} if "deadline" not in said else {"deadline": said["deadline"]}
    if "opens" in said:
        when = {"window": [said["opens"], said["deadline"]]}
    return when | ({"after": [*said["after"]]} if "after" in said else {})


def trip_table(app: App, trip: Trip) -> dict[str, Any]:
    """Return one trip of a missions file."""
    table: dict[str, Any] = {"name": trip.name, "action": trip.action}
    if trip.source is not None:
        table["source"] = [float(along) for along in trip.source]
    table["target"] = [float(along) for along in trip.target]
    table.update(_fields(app, Entity.TRIP, trip))
    if trip.parameters:
        table["parameters"] = {**trip.parameters}
    if trip.item is not None:
        table["item"] = {"name": trip.item.name, "mass": trip.item.mass}
    return table


def _fields(app: App, entity: Entity, of: Mission[Any] | Trip) -> dict[str, Any]:
    fields: dict[str, Any] = {}
    for field in app.fields:
        given = getattr(of, field.name) if field.on is entity else None
        if given is not None and field.type is FieldType.TIME_OF_DAY:
            minutes = round(given / 60)
            fields[field.name] = f"{minutes // 60:02}:{minutes % 60:02}"
        elif given is not None and field.type is FieldType.ALONG:
            fields[field.name] = _along(given)
        elif given is not None:
            fields[field.name] = given
    return fields


def _along(along: Along) -> dict[str, Any]:
    """Return what is done on the way as a file says it."""
    table: dict[str, Any] = {"action": along["action"]}
    if "metres" in along:
        table["every"] = f"{along['metres']:.12g} m"
    elif "seconds" in along:
        table["every"] = f"{along['seconds']:.12g} s"
    if along.get("parameters"):
        table["parameters"] = {**along["parameters"]}
    return table


_MAP: KeyPath = ("map",)
_IMAGE: KeyPath = ("map", "image")

Table = dict[str, Any]
Size = tuple[float, float]


def landmark_tables(landmarks: Landmarks) -> dict[str, list[Table]]:
    """Return the tables of `places` and of `zones`."""
    return {
        "places": [{"name": one.name, "at": _floats(one.at)} for one in landmarks.places],
        "zones": [
            {"name": one.name, "corners": [_floats(corner) for corner in one.corners]}
            for one in landmarks.zones
        ],
    }


def with_landmarks(text: str, was: Landmarks, landmarks: Landmarks, size: Size) -> str:
    """Return the text of a fleet file whose landmarks `was` are, with others; `size` is that of its map.

    Raises `BadInput` if its map is written so that it cannot be changed without touching the rest.
    """
    if "\r\n" in text and text.count("\n") == text.count("\r\n"):
        return _changed(text.replace("\r\n", "\n"), was, landmarks, size).replace("\n", "\r\n")
    return _changed(text, was, landmarks, size)


@dataclass(slots=True)
class _Part:
    """A header with its values, and what stands between them and the next."""

    path: KeyPath
    lines: list[str]
    rest: list[str]

    def get(self, key: str) -> object:
        """Return the value of a key under this header, or None."""
        import tomlkit  # only to write

        return _under(tomlkit.parse("\n".join(self.lines)), self.path).get(key)

    def put(self, values: Mapping[str, object]) -> None:
        """Set the values of keys; None takes one out."""
        import tomlkit

        document = tomlkit.parse("\n".join(self.lines))
        table, new = _under(document, self.path), []
        for key, value in values.items():
            if value is None:
                table.pop(key, None)
            elif key in table:
                table[key] = tomlkit.value(toml_value(value))
            else:
                new.append(f"{key} = {toml_value(value)}")
        self.lines = [*tomlkit.dumps(document).split("\n"), *new]


def _changed(text: str, was: Landmarks, landmarks: Landmarks, size: Size) -> str:
    parts = _parts(text)
    own = next((part for part in parts if part.path == _MAP), None)
    if own is None:
        if _MAP in places(text):
            raise BadInput("its map has no header of its own: write the line [map] above its keys")
        own = _Part(_MAP, ["[map]"], [""])
        between = [] if text.endswith("\n") else [_Part((), [], [""])]
        parts = [*parts, *between, own] if text else [own]
    own.put(_plain_values(parts, was, landmarks, size))
    old, new = landmark_tables(was), landmark_tables(landmarks)
    last = own
    for key in ("places", "zones"):
        sections = [part for part in parts if part.path[:2] == ("map", key)]
        if own.get(key) is not None:  # they stand in one list
            if old[key] != new[key]:
                own.put({key: new[key]})
            continue
        last = _change_sections(parts, sections, key, old[key], new[key], last)
    return "\n".join(line for part in parts for line in (*part.lines, *part.rest))


def _plain_values(
    parts: Sequence[_Part], was: Landmarks, landmarks: Landmarks, size: Size
) -> Table:
    """Return what is to be set beneath [map]; a picture with a header of its own is set there."""
    values: Table = {} if was.north == landmarks.north else {"north": float(landmarks.north)}
    picture = landmarks.picture
    if picture == was.picture:
        return values
    table: Table | None = None
    if picture is not None:
        table = {"file": picture.file, "at": _floats(picture.at), "size": _floats(picture.size)}
        table["turn"] = float(picture.turn)
    for part in parts:
        if part.path == _IMAGE:
            if table is None:
                part.lines = []
            else:
                part.put(table)
            return values
    fits = picture and picture == Picture(file=picture.file, size=size)
    return {**values, "image": picture.file if picture and fits else table}


def _change_sections(
    parts: list[_Part],
    sections: Sequence[_Part],
    key: str,
    old: Sequence[Table],
    new: Sequence[Table],
    after: _Part,
) -> _Part:
    """Change what stands beneath `[[map.key]]`, new ones behind the others; return the last part of them."""
    wanted, known = {one["name"]: one for one in new}, {one["name"]: one for one in old}
    for part in sections:
        name = part.get("name")
        if name not in wanted:
            before = [
                line for one in parts[: parts.index(part)] for line in (*one.lines, *one.rest)
            ]
            part.lines = []
            if before and _is_blank(before[-1]):
                part.rest = [*dropwhile(_is_blank, part.rest)]
        elif wanted[name] != known[name]:
            part.put(wanted[name])
        after = part
    added = [one for name, one in wanted.items() if name not in known]
    for number, one in enumerate(added):
        lines = [
            f"[[map.{key}]]",
            *(f"{word} = {toml_value(value)}" for word, value in one.items()),
        ]
        part = _Part(("map", key, len(sections) + number), lines, after.rest)
        after.rest = [""] if after.lines else []
        parts.insert(parts.index(after) + 1, part)
        after = part
    return after


def _parts(text: str) -> list[_Part]:
    """Cut a text at its headers; the first part has none."""
    lines, found = text.split("\n"), headers(text)
    starts = [0, *(line - 1 for line, _ in found)]
    paths: list[KeyPath] = [(), *(path for _, path in found)]
    return [
        _part(path, lines[start:end])
        for path, start, end in zip(paths, starts, [*starts[1:], len(lines)], strict=True)
    ]


def _part(path: KeyPath, lines: Sequence[str]) -> _Part:
    end = len(lines)
    while end and (not lines[end - 1].strip() or lines[end - 1].lstrip().startswith("#")):
        end -= 1
    return _Part(path, [*lines[:end]], [*lines[end:]])


def _under(document: Any, path: KeyPath) -> Any:
    """Return the table of a path in a text that has just this one."""
    for step in path:
        document = document[0 if isinstance(step, int) else step]
    return document


def _is_blank(line: str) -> bool:
    return not line.strip()
