"""Changes of what has not flown, made on the pages while it is under way: of the flight and of the plan at once."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ..flight.changing import left, refuse_if_stale
from ..shared.domain.text import quoted
from .plan.in_flight import drawn_change, named
from .plan.problems import bare
from .plan.shape import trips_from

if TYPE_CHECKING:
    from ..app import App
    from ..flight.live_flight import LiveFlight
    from ..flight.recorded_flight import RecordedFlight
    from .plan.plan import MissionPlan
    from .plan.shape import Shape

Drawn = Mapping[str, Sequence["Shape"]]
"""Trips as a page has drawn them, by the names of their missions."""


class FlightChanges:
    """Makes them, so that the plan and the flight agree at every instant."""

    def __init__(self, app: App, plan: MissionPlan, flight_now: Callable[[], LiveFlight]) -> None:
        """`flight_now` returns the run that can be commanded, or raises `BadInput`."""
        self._app, self._plan, self._flight_now = app, plan, flight_now

    async def edit(self, revision: int, missions: object) -> None:
        """Replace the plan by a page's; what has not flown of missions that fly is changed in flight.

        Raises `Stale` if it was drawn on an old revision, and `BadInput` if that cannot be flown so.
        """
        drawn = self._plan.drawn_in_flight(missions)
        if not drawn:
            self._plan.replace(revision, missions)
            return
        self._plan.check_current(revision)
        await self._flight_now().carry_out(lambda life: self._change(life, drawn, missions))

    async def change_trips(self, id: str, given: Mapping[str, Any]) -> str:
        """Change what has not flown of one mission, by a command with this id."""
        name, replaces = str(given["mission"]), given["replaces"]
        trips = trips_from(given["trips"], self._app)

        def do(life: RecordedFlight) -> str:
            record, fixed = life.control.record(name), self._plan.launched_mission(name)
            if replaces is not None:
                refuse_if_stale(name, record, replaces)
            if fixed is None:  # it was started elsewhere, by a plan that was not drawn here
                said = life.control.change_trips(name, list(map(bare, trips)), None)
            else:
                waits = [one["name"] for one in left(record)]
                kept = [one for one in named(fixed, fixed["trips"]) if one["name"] not in waits]
                said = self._change(life, {name: [*kept, *trips]}, None)
            life.control.remember(id, "change-trips")
            return said

        return await self._flight_now().carry_out(do)

    def _change(self, life: RecordedFlight, drawn: Drawn, missions: object) -> str:
        """Let missions that fly have these trips; all of that can be done, or nothing is."""
        changes = {}
        for name, trips in drawn.items():
            record, fixed = life.control.record(name), self._plan.launched_mission(name)
            if fixed is not None:
                changes[name] = drawn_change(self._app, fixed, trips, record)
        made = [
            life.control.changed(name, change.tables)
            for name, change in changes.items()
            if change.is_one
        ]
        plan = self._plan.merged(missions, {name: one.trips for name, one in changes.items()})
        for make in made:
            make()
        self._plan.take(plan)
        return f"{', '.join(map(quoted, drawn))}: what has not flown is changed"
