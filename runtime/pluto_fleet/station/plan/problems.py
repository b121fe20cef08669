"""What is wrong with a plan, and where: the checks of a missions file, in the words of a screen."""

from __future__ import annotations

import asyncio
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from ...files.missions import read_missions
from ...files.plan_check import unflyable
from ...files.reading import Document, Wording
from .shape import Shape, trips_of

if TYPE_CHECKING:
    from collections.abc import Container

    from plutoc_runtime.domain.airspace import Airspace
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Mission, Trip

    from ...files.fleet import FleetFile
    from ...files.toml import TomlPath


_CALLED = {
    "name": "the name",
    "target": "the place",
    "source": "the place where the flight begins",
    "mass": "the mass",
}
_MISSING = {
    "action": "has no action yet: choose one",
    "target": "has no place yet: drag it onto the floor plan, or type x and y",
    "name": "the item has no name yet",
    "mass": "the item has no mass yet: write it like 4 g",
}


def on_a_screen(app: App) -> Wording:
    """Return the words for screens, which have labels where files have keys."""
    called = {**_CALLED, **{field.name: field.label for field in app.fields}}
    return Wording(
        called=lambda key: called.get(key, key),
        missing=lambda key: _MISSING.get(key, f"has no {called.get(key, key)} yet"),
        no_trips=lambda: "has no trips yet: drag an action onto the floor plan",
        item_missing=lambda action: f"{action} needs an item: give its name and its mass",
    )


def own_names(app: App) -> frozenset[str]:
    """Return the names of the app's that a sentence may begin with."""
    parameters = (one.name for action in app.actions.values() for one in action.parameters)
    return frozenset((*app.actions, *parameters))


def sentence(text: str, names: Container[str]) -> str:
    """Begin a sentence with a capital, unless one of these names begins it."""
    return text if text.partition(" ")[0] in names else text[:1].upper() + text[1:]


def in_one_go(trips: Sequence[Trip], reason: str) -> str:
    """Say why no drone can fly these trips, beside the first of them."""
    if len(trips) == 1:
        return reason
    return f"from here to trip {trips[-1].name} one drone must fly all: {reason}"


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


def unflyable_trips(
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


def _problem(missions: Sequence[Shape], place: TomlPath, text: str, alone: str) -> PlanProblem:
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


class FlyabilityCache:
    """What is known of each mission, by its key: it is asked about again when it has changed."""

    def __init__(self, app: App, fleet: FleetFile) -> None:
        self._app, self._fleet = app, fleet
        self._known: dict[object, tuple[Shape, Sequence[PlanProblem]]] = {}
        self._beside = replace(fleet.airspace)  # routes are remembered: by one thread each
        self._one_at_a_time = asyncio.Lock()

    def known(self, missions: Collection[Shape]) -> Iterator[PlanProblem]:
        """Yield what keeps these missions from being flown, as far as it has been asked."""
        for mission in missions:
            if self._is_known(mission):
                yield from self._known[mission["key"]][1]

    def knows(self, missions: Collection[Shape]) -> bool:
        """Say whether everything has been asked about these missions."""
        return not self._unknown(missions)

    async def ask(self, missions: Collection[Shape]) -> None:
        """Find out what is not known of these missions, in a thread."""
        async with self._one_at_a_time:
            for mission in self._unknown(missions):
                found = await asyncio.to_thread(self._found, mission, self._beside)
                self._known[mission["key"]] = mission, found
            self._forget_all_but(missions)

    def ask_at_once(self, missions: Collection[Shape]) -> None:
        """Find it out before anything else happens."""
        for mission in self._unknown(missions):
            self._known[mission["key"]] = mission, self._found(mission, self._fleet.airspace)
        self._forget_all_but(missions)

    def _unknown(self, missions: Collection[Shape]) -> list[Shape]:
        return [mission for mission in missions if not self._is_known(mission)]

    def _forget_all_but(self, missions: Collection[Shape]) -> None:
        keys = [mission["key"] for mission in missions]
        self._known = {key: self._known[key] for key in keys if key in self._known}

    def _is_known(self, mission: Shape) -> bool:
        return self._known.get(mission["key"], (None, ()))[0] == mission

    def _found(self, mission: Shape, airspace: Airspace) -> Sequence[PlanProblem]:
        return unflyable_trips(self._app, self._fleet, airspace, mission)
