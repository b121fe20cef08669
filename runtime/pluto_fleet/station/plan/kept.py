"""The plan's file: replaced atomically, and never deleted for being unreadable."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ...files.reading import listed
from ...shared.domain.errors import BadInput
from ...shared.domain.fields import Entity
from ...shared.domain.text import printable
from ...shared.domain.values import shown
from ..whole_file import write_whole
from .shape import MISSION_KEYS, TRIP_KEYS, Shape, fields_of, missions_from

if TYPE_CHECKING:
    from ...app import App

LARGEST = 1 << 25
"""The largest file in bytes; the largest possible plan is smaller."""

VERSION = 1

_NOT_JSON = "it is damaged, or is something else"


@dataclass(frozen=True, slots=True, kw_only=True)
class KeptPlan:
    """A stored plan."""

    missions: Sequence[Shape] = ()
    revision: int = 0
    said: str = ""
    """A message about it for users."""


class _Unreadable(Exception):
    """The file is not a plan of this app."""


def write(path: Path, app: App, revision: int, missions: Sequence[Shape]) -> None:
    """Store a plan atomically; raise `OSError` if that fails."""
    data = {"version": VERSION, "app": app.name, "revision": revision, "missions": missions}
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":"))
    write_whole(path, text.encode())


def read(path: Path, app: App) -> KeptPlan:
    """Return the stored plan; an unreadable one is renamed, with a message."""
    if not os.path.lexists(path):
        return KeptPlan()
    try:
        data = _data(path)
        if data.get("app") != app.name:
            raise _Unreadable(f"it is of {shown(data.get('app'))}, and this is {app.name}")
        return _kept(path, data, app)
    except _Unreadable as error:
        why = str(error)
    aside = _aside(path)
    try:
        os.replace(path, aside)
    except OSError as error:
        raise _in_the_way(path, why, error) from None
    return KeptPlan(
        said=f"The plan that was kept cannot be read: {why}. It lies in {printable(str(aside))}, "
        f"and {printable(str(path))} begins anew."
    )


def _data(path: Path) -> dict[str, object]:
    try:
        if not path.is_file():
            raise _Unreadable(_NOT_JSON)
        with path.open("rb") as file:
            content = file.read(LARGEST + 1)
    except OSError as error:
        raise _Unreadable(_unreadable(error)) from None
    if len(content) > LARGEST:
        raise _Unreadable("it is larger than any plan")
    try:
        data = json.loads(content)
    except (ValueError, RecursionError):
        raise _Unreadable(_NOT_JSON) from None
    if not isinstance(data, dict) or data.get("version") != VERSION:
        raise _Unreadable(_NOT_JSON)
    return data


def _kept(path: Path, data: Mapping[str, object], app: App) -> KeptPlan:
    revision, given = data.get("revision"), data.get("missions")
    if isinstance(revision, bool) or not isinstance(revision, int) or revision < 0:
        raise _Unreadable(_NOT_JSON)
    missions, gone = _without_gone(given, app)
    try:
        shapes = missions_from(missions, app)
    except BadInput as error:
        raise _Unreadable(str(error)) from None
    for shape, was in zip(shapes, missions, strict=True):
        shape["launched"], shape["ended"] = was.get("launched") is True, was.get("ended")
        if done := was.get("done"):
            shape["done"] = done
    if not gone:
        return KeptPlan(missions=shapes, revision=revision)
    aside = _aside(path)
    try:
        aside.write_bytes(path.read_bytes())
    except OSError as error:
        raise _in_the_way(path, _unreadable(error), error) from None
    said = (
        f"The plan that was kept has {listed(gone)}, which this app does not have any more. The "
        f"rest is here; as it was, it lies in {printable(str(aside))}."
    )
    return KeptPlan(missions=shapes, revision=revision, said=said)


def _without_gone(given: object, app: App) -> tuple[list[Shape], list[str]]:
    """Remove fields that only an earlier graph of the app had."""
    gone: dict[str, None] = {}

    def known(one: object, keys: Sequence[str]) -> Shape:
        if not isinstance(one, dict):
            raise _Unreadable(_NOT_JSON)
        gone.update(dict.fromkeys(key for key in one if key not in keys))
        return {key: value for key, value in one.items() if key in keys}

    if not isinstance(given, list):
        raise _Unreadable(_NOT_JSON)
    missions = []
    for element in given:
        mission = known(element, (*MISSION_KEYS, *fields_of(app, Entity.MISSION)))
        trips = mission.get("trips")
        if isinstance(trips, list):
            keys = (*TRIP_KEYS, *fields_of(app, Entity.TRIP))
            mission["trips"] = [known(trip, keys) for trip in trips]
        missions.append(mission)
    return missions, list(gone)


def _unreadable(error: OSError) -> str:
    return (error.strerror or str(error)).lower()


def _in_the_way(path: Path, why: str, error: OSError) -> BadInput:
    return BadInput(
        f"{path}: the plan that was kept cannot be read ({why}), and cannot be put aside either: "
        f"{error.strerror or error}"
    )


def _aside(path: Path) -> Path:
    """Return an unused name beside the plan's."""
    aside, number = path.with_name(f"{path.name}.bad"), 1
    while os.path.lexists(aside):
        number += 1
        aside = path.with_name(f"{path.name}.bad-{number}")
    return aside
