"""The problems of a plan: the checks of a missions file, worded for pages; and promises that cannot be kept."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Collection, Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from ...files.missions import moment, read_missions
from ...files.plan_check import impossible, unflyable
from ...files.reading import Document
from ...shared.domain.values import shown
from ...shared.events.declared import OF_TARGET
from ...shared.time.hours import Hours
from .shape import MOMENTS, Shape

if TYPE_CHECKING:
    from collections.abc import Container

    from ...app import App
    from ...files.fleet import FleetFile
    from ...shared.domain.airspace import Airspace
    from ...shared.domain.model import Mission, Trip
    from ...shared.domain.values import KeyPath, Problem


_CALLED = {
    "name": "the name",
    "target": "the place",
    "source": "the place where the flight begins",
    "mass": "the mass",
    "opens": "Begins at the soonest",
    "window": "Begins at the soonest",
    "deadline": "Due",
    "after": "the mission",
}
_MISSING = {
    "action": "has no action yet: choose one",
    "target": "has no place yet: drag it onto the floor plan, or type x and y",
    "name": "the item has no name yet",
    "mass": "the item has no mass yet: write it like 4 g",
}


def _on_a_screen(app: App, problem: Problem) -> Problem:
    """Word a problem for pages, which have labels where files have keys."""
    labels = {field.name: field.label for field in app.fields}
    key = problem.path[-1] if problem.path else ""
    text = problem.text
    if problem.is_missing and key in labels:
        text = f"{labels[str(key)]} is not filled in yet"
    elif problem.is_missing and key == "item":
        text = text.partition(",")[0] + ": give its name and its mass"
    elif problem.is_missing and isinstance(key, int):
        text = "has no trips yet: drag an action onto the floor plan"
    elif problem.is_missing:
        text = _MISSING.get(str(key), f"has no {key} yet")
    elif text.startswith(f"{key} "):
        text = {**_CALLED, **labels}.get(f"{key}", f"{key}") + text.removeprefix(f"{key}")
    return problem._replace(text=text)


def own_names(app: App) -> frozenset[str]:
    """Return the app's own names with which a sentence may begin."""
    parameters = (one.name for action in app.actions.values() for one in action.parameters)
    return frozenset((*app.actions, *parameters))


def sentence(text: str, names: Container[str]) -> str:
    """Capitalize a sentence, unless it begins with one of these names."""
    return text if text.partition(" ")[0] in names else text[:1].upper() + text[1:]


def in_one_go(trips: Sequence[Trip], reason: str) -> str:
    """Return why no drone can fly these trips, worded for the first of them."""
    if len(trips) == 1:
        return reason
    return f"from here to trip {trips[-1].name} one drone must fly all: {reason}"


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanProblem:
    """A problem that keeps a plan from being flown."""

    mission: str | None
    """The key of its mission, if any."""
    trip: str | None
    field: str | None
    """Such as `safe_time`, `target`, `item.mass` or `parameters.dose`."""
    text: str
    """Its message beside that field."""
    alone: str
    """Its message elsewhere, with its subject."""


def read(
    app: App, airspace: Airspace, missions: Sequence[Shape], known: Collection[str] = ()
) -> tuple[list[Mission[Any]], list[PlanProblem]]:
    """Return the missions to fly, as far as valid, and their problems; `known` are other missions."""
    document = Document("", {"mission": [*map(as_in_a_file, missions)]})
    names = own_names(app)
    found = read_missions(document, app, airspace, known) if missions else []
    problems = [
        _problem(missions, one.path, sentence(one.text, names), sentence(one.sentence, names))
        for one in (_of_a_moment(missions, _on_a_screen(app, one)) for one in document.problems)
    ]
    return found, [_of_its_height(one, missions, airspace) for one in problems]


def unflyable_trips(
    app: App, fleet: FleetFile, airspace: Airspace, mission: Shape
) -> list[PlanProblem]:
    """Return the trips of a mission that no drone of the fleet can fly."""
    missions, found = read(app, airspace, [mission], mission.get("after", ()))
    if found:
        return []
    names, problems = own_names(app), []
    for miss in unflyable(missions, app, fleet, airspace):
        text = sentence(in_one_go(miss.trips, miss.reason), names)
        alone = sentence(f"{miss.called}: {miss.reason}", names)
        place = ("mission", 0, "trip", miss.trips[0].index)
        problems.append(_problem([mission], place, text, alone))
    return problems


def as_json(problem: PlanProblem) -> Shape:
    """Return a problem for pages."""
    return {
        "mission": problem.mission,
        "trip": problem.trip,
        "field": problem.field,
        "text": problem.text,
    }


def as_in_a_file(mission: Shape) -> dict[str, Any]:
    """Return a mission as in a missions file, without keys and empty values."""
    trips = [bare(trip) for trip in mission["trips"]]
    table = bare(mission)
    if (opens := table.pop("opens", None)) is not None:
        table["window"] = [opens, table.pop("deadline", "")]
    return {**table, "trip": trips}


def _of_a_moment(missions: Sequence[Shape], problem: Problem) -> Problem:
    """Assign a problem of a window to that of its two fields which is wrong, in its words."""
    match problem.path:
        case ("mission", int(i), "window"):
            field, text = _wrong_in_window(missions[i])
            return problem._replace(path=("mission", i, field), text=text)
    return problem


def _wrong_in_window(mission: Shape) -> tuple[str, str]:
    for field in MOMENTS:
        if (given := mission.get(field)) is not None:
            try:
                moment(given)
            except ValueError as error:
                return field, f"{_CALLED[field]} {shown(given)} {error}"
    if mission.get("deadline") is None:
        return "opens", "it needs an end as well: fill in by when it is due"
    return "deadline", "there is no time between when it may begin and when it is due"


def _of_its_height(
    problem: PlanProblem, missions: Sequence[Shape], airspace: Airspace
) -> PlanProblem:
    """Assign a problem to the field of the height, if only that is wrong."""
    if problem.field != "target":
        return problem
    trips = [one for mission in missions for one in mission["trips"] if one["key"] == problem.trip]
    match trips[0]["target"]:
        case [int() | float() as x, int() | float() as y, _] if (
            airspace.problem((x, y, 0.0)) is None
        ):
            return replace(problem, field="z")
    return problem


def bare(given: Mapping[str, object]) -> dict[str, object]:
    """Return a trip, or a mission but for its trips, as in a missions file."""
    ours = ("key", "launched", "ended", "done", "trips")
    table = {
        key: value
        for key, value in given.items()
        if key not in ours and value is not None and (key, value) != ("parameters", {})
    }
    if "track" in table and "target" not in table:
        table["target"] = {key: table.pop(key) for key in OF_TARGET if key in table}
    return table


def _problem(missions: Sequence[Shape], place: KeyPath, text: str, alone: str) -> PlanProblem:
    """Convert a problem of a file, with the keys of its mission and trip."""
    mission = trip = None
    inside: Sequence[str | int] = ()
    match place:
        case ("mission", int(i), "trip", int(j), *inside):
            mission = missions[i]["key"]
            trip = missions[i]["trips"][j]["key"]
        case ("mission", int(i), *inside):
            mission = missions[i]["key"]
    return PlanProblem(
        mission=mission,
        trip=trip,
        field=".".join(part for part in inside if isinstance(part, str)) or None,
        text=text,
        alone=alone,
    )


class FlyabilityCache:
    """Caches which missions the fleet can fly, by their keys."""

    def __init__(self, app: App, fleet: FleetFile) -> None:
        self._app, self._fleet = app, fleet
        self._known: dict[object, tuple[Shape, Sequence[PlanProblem]]] = {}
        self._beside = replace(fleet.airspace)  # its cache of routes must not be shared by threads
        self._one_at_a_time = asyncio.Lock()

    def known(self, missions: Collection[Shape]) -> Iterator[PlanProblem]:
        """Yield the known problems of these missions, and forget all others."""
        keys = [one["key"] for one in missions]
        self._known = {key: self._known[key] for key in keys if key in self._known}
        for mission in missions:
            if self._is_known(mission):
                yield from self._known[mission["key"]][1]

    def unknown(self, missions: Collection[Shape]) -> list[Shape]:
        """Return the missions that have not been checked as they are."""
        return [mission for mission in missions if not self._is_known(mission)]

    async def ask(self, missions: Collection[Shape]) -> None:
        """Check those, in a thread."""
        async with self._one_at_a_time:
            for mission in self.unknown(missions):
                found = await asyncio.to_thread(self._found, mission, self._beside)
                self._known[mission["key"]] = mission, found

    def ask_at_once(self, missions: Collection[Shape]) -> None:
        """Check those at once."""
        for mission in self.unknown(missions):
            self._known[mission["key"]] = mission, self._found(mission, self._fleet.airspace)

    def _is_known(self, mission: Shape) -> bool:
        return self._known.get(mission["key"], (None, ()))[0] == mission

    def _found(self, mission: Shape, airspace: Airspace) -> Sequence[PlanProblem]:
        return unflyable_trips(self._app, self._fleet, airspace, mission)


MOST = 10


def promised(missions: Sequence[Mission[Any]]) -> Sequence[Mission[Any]]:
    """Return copies of missions, as their flight changes them; none if nothing is promised of any."""
    return deepcopy(missions) if any(one.promises for one in missions) else ()


async def broken(missions: Sequence[Mission[Any]], app: App, fleet: FleetFile) -> Sequence[str]:
    """Return a sentence for each promise that cannot be kept, found in a thread: flights go on meanwhile."""
    if not missions:
        return ()
    beside = replace(fleet, airspace=replace(fleet.airspace))  # threads share no cache of routes
    return await asyncio.to_thread(_sentences, missions, app, beside, Hours(time.time(), ""))


def _sentences(
    missions: Sequence[Mission[Any]], app: App, fleet: FleetFile, hours: Hours
) -> Sequence[str]:
    found = [sentence(one, ()) for one in impossible(missions, app, fleet, hours)]
    more = len(found) - MOST
    return found if more <= 0 else [*found[:MOST], f"… and {more} more"]
