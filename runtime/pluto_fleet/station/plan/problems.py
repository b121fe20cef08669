"""What is wrong with a plan, and where: the checks of a missions file, in a screen's words."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from ...files.missions import read_missions
from ...files.plan_check import unflyable
from ...files.reading import Document
from .shape import Shape, trips_of
from .words import in_one_go, on_a_screen, own_names, sentence

if TYPE_CHECKING:
    from plutoc_runtime.domain.airspace import Airspace
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Mission

    from ...files.fleet import FleetFile
    from ...files.toml_places import Place


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanProblem:
    """Something that keeps a plan from being flown."""

    mission: str | None
    """The key of the mission that it is about, if it is about one."""
    trip: str | None
    field: str | None
    """Such as `safe_time`, `target`, `item.mass` or `parameters.dose`."""
    text: str
    """As it stands beside that field."""
    alone: str
    """As it stands where nothing else shows what it is about."""


def read(
    app: App, airspace: Airspace, missions: Sequence[Shape]
) -> tuple[list[Mission[Any]], list[PlanProblem]]:
    """Return the missions to fly, as far as they can be read, and what is wrong with them."""
    document, names = _document(app, missions), own_names(app)
    found = read_missions(document, app, airspace) if missions else []
    problems = [
        _problem(missions, one.place, sentence(one.text, names), sentence(one.sentence, names))
        for one in document.problems
    ]
    return found, [_of_its_height(one, missions, airspace) for one in problems]


def nobody_can_fly(
    app: App, fleet: FleetFile, airspace: Airspace, mission: Shape
) -> list[PlanProblem]:
    """Return what no drone of the fleet could ever do of a mission that can be read."""
    missions, found = read(app, airspace, [mission])
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
    """Return a problem as pages get it."""
    return {
        "mission": problem.mission,
        "trip": problem.trip,
        "field": problem.field,
        "text": problem.text,
    }


def as_in_a_file(mission: Mapping[str, object]) -> dict[str, object]:
    """Return a mission as a missions file would have it: no keys, and nothing that is not given."""
    trips = [_bare(trip) for trip in trips_of(mission)]
    return {**_bare(mission), "trip": trips}


def _of_its_height(
    problem: PlanProblem, missions: Sequence[Shape], airspace: Airspace
) -> PlanProblem:
    """Tell it of the field of the height, where a place is wrong for that alone."""
    if problem.field != "target":
        return problem
    trips = [one for mission in missions for one in trips_of(mission) if one["key"] == problem.trip]
    match trips[0]["target"]:
        case [int() | float() as x, int() | float() as y, _] if (
            airspace.problem((x, y, 0.0)) is None
        ):
            return replace(problem, field="z")
    return problem


def _bare(given: Mapping[str, object]) -> dict[str, object]:
    ours = ("key", "launched", "ended", "trips")
    return {
        key: value
        for key, value in given.items()
        if key not in ours and value is not None and (key, value) != ("parameters", {})
    }


def _document(app: App, missions: Sequence[Shape]) -> Document:
    data: dict[str, object] = {"mission": [as_in_a_file(mission) for mission in missions]}
    return Document("", data, {}, on_a_screen(app))


def _problem(missions: Sequence[Shape], place: Place, text: str, alone: str) -> PlanProblem:
    """Find the keys of what is at this place of a file."""
    mission = trip = None
    inside: Sequence[str | int] = ()
    match place:
        case ("mission", int(i), "trip", int(j), *inside):
            mission, trip = missions[i]["key"], trips_of(missions[i])[j]["key"]
        case ("mission", int(i), *inside):
            mission = missions[i]["key"]
    return PlanProblem(
        mission=None if mission is None else str(mission),
        trip=None if trip is None else str(trip),
        field=".".join(part for part in inside if isinstance(part, str)) or None,
        text=text,
        alone=alone,
    )
