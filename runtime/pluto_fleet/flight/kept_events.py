"""Events that are raised while everything is stopped: kept in the journal, told at Resume, or dropped as too old."""

from __future__ import annotations

import json
from contextlib import closing
from functools import partial
from time import time
from typing import TYPE_CHECKING, Any

from ..journal.header import check, fleet_in
from ..journal.store import Entry, Store
from ..shared.domain.errors import BadInput
from ..shared.domain.text import duration, quoted
from ..shared.domain.values import point, point_on
from ..shared.events.declared import EventsDeclared, read_occurrence

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from ..app import App
    from ..files.fleet import FleetFile
    from ..journal.standing import Record, Standing
    from .recorded_brain import RecordedBrain

KEEP = 60.0
"""Seconds after which nothing comes of an event that was raised while everything was stopped."""

OF_AN_EVENT = ("id", "at", "track", "mission", "trip", "drone", "fields")
"""What may be said of an event that is raised."""


def given_of(facts: Mapping[str, object]) -> dict[str, Any]:
    """Return what a request says of an event."""
    return {name: facts[name] for name in OF_AN_EVENT if facts.get(name) is not None}


def events_of(app: App) -> EventsDeclared:
    """Return what an app declares of events; raise `BadInput` if it has none."""
    for part in app.parts:
        if isinstance(part, EventsDeclared):
            return part
    raise BadInput(f"{app.name} has no events")


def kept_one(
    app: App,
    fleet: FleetFile,
    standing: Standing,
    event: str,
    facts: Mapping[str, object],
) -> Record:
    """Return what is kept of an event until Resume; raise `BadInput` if it cannot happen."""
    space = fleet.airspace
    place = partial(point_on, space, space.cruise_height, point)
    types = {one.name: one for one in events_of(app).types}
    now = time()
    given = given_of(facts)
    read_occurrence(types, event, given, place)
    given.setdefault("id", f"{event}/{now:.3f}")
    if standing.missions and all(record["ended"] for record in standing.missions.values()):
        raise BadInput("the flight is over: nothing will come of an event")
    keep = facts.get("keep")
    return {
        "event": event,
        "given": given,
        "since": now,
        "keep": KEEP if keep is None else keep,
    }


def is_known(standing: Standing, id: str) -> bool:
    """Return whether an event with this id has happened, or is kept."""
    return id in standing.happenings or any(one["given"]["id"] == id for one in standing.kept)


def has_happened(id: str) -> str:
    """Return the answer to who raises an event again."""
    return f"event {quoted(id)} has happened already"


def is_kept(one: Record) -> str:
    """Return the answer to who raises an event while everything is stopped."""
    return f"event {quoted(one['event'])} is kept for {duration(one['keep'])}: it happens if the flight is resumed by then"


def noted(one: Record, now: float) -> dict[str, object]:
    """Return the event of the journal that says so."""
    facts = {"id": one["given"]["id"], "kind": one["event"], "keep": one["keep"]}
    return {"t": now, "event": "event.kept", **facts}


def record_event(app: App, journal: Path, event: str, facts: Mapping[str, object]) -> str:
    """Keep an event in an idle journal; return the answer for the user, or raise `BadInput`."""
    with closing(Store.open(journal)) as store:
        check(journal, store.header, app)
        standing = store.standing()
        one = kept_one(app, fleet_in(app, journal, store.header), standing, event, facts)
        if is_known(standing, one["given"]["id"]):
            return has_happened(one["given"]["id"])
        rows = [("app", ("kept",), {"is": [*standing.kept, one]})]
        store.append([Entry(json.dumps([noted(one, standing.time)]), rows)])
    return is_kept(one)


def tell_kept(run: RecordedBrain) -> None:
    """Have happen what was kept, unless that is too old by now."""
    kept = run.records.kept
    for one in kept:
        age = time() - one["since"]
        id = one["given"]["id"]
        if age > one["keep"]:
            why = f"it was raised {duration(age)} ago, and kept for {duration(one['keep'])}"
            run.note("event.dropped", id=id, kind=one["event"], why=why)
            continue
        try:
            run.command("raise", event=one["event"], **one["given"])
        except BadInput as error:
            run.note("event.dropped", id=id, kind=one["event"], why=str(error))
    if kept:
        run.recorder.fact("kept", [])
