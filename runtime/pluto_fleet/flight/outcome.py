"""What came of a flight, in an app's own classes: its missions, drones and results."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any

from ..shared.alone.simulate import Outcome
from ..shared.domain.model import Drone, Mission, Result
from ..shared.domain.status import DroneStatus, Status
from ..shared.flow import record

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.fleet_data import FleetData
    from ..shared.domain.model import Telemetry

Telling = Callable[[str], "Telemetry"]
"""Returns what tells how a drone is, by its id."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SimulationResult(Outcome):
    """The outcome of a simulation."""

    missions: tuple[Mission[Any], ...]
    drones: tuple[Drone, ...]
    results: tuple[Result[Any, Any], ...] = ()
    """Of every action that was done, in order."""

    @property
    def completed(self) -> bool:
        """Whether every mission was completed."""
        return all(mission.status is Status.COMPLETED for mission in self.missions)


def result_of(
    app: App,
    missions: Sequence[Mission[Any]],
    fleet: FleetData,
    outcome: Outcome,
    telemetry: Telling,
) -> SimulationResult:
    """Return an outcome in objects, and bring these missions up to date."""
    standing = outcome.standing
    named = {mission.name: mission for mission in missions}
    missions = [
        named.get(name) or app.mission(name=name, trips=[], index=row["index"])
        for name, row in standing["missions"].items()  # events have made some of them
    ]
    for mission in missions:
        record.update(app, mission, standing["missions"][mission.name])
    return SimulationResult(
        **{one.name: getattr(outcome, one.name) for one in fields(Outcome)},
        missions=tuple(missions),
        drones=drones_of(app, fleet, standing["drones"], telemetry),
        results=_results_of(missions, standing["results"]),
    )


def drones_of(
    app: App, fleet: FleetData, stand: Mapping[str, Any], telemetry: Telling
) -> tuple[Drone, ...]:
    """Return the drones of a fleet as they stand."""
    categories = {category.name: category for category in app.categories}
    return tuple(
        Drone(
            id=one.id,
            category=categories[one.category],
            home=one.home,
            telemetry=telemetry(one.id),
            status=DroneStatus(stand[one.id]["status"]),
            trips=stand[one.id]["trips"],
            index=index,
        )
        for index, one in enumerate(fleet.drones)
    )


def _results_of(
    missions: Sequence[Mission[Any]], stored: Sequence[Mapping[str, Any]]
) -> tuple[Result[Any, Any], ...]:
    """Return the results of these missions, which are up to date."""
    named = {one.name: one for one in missions}
    trips = {
        (one.name, trip.name): trip
        for one in missions
        for trip in (*one.trips, *one.completed_trips)
    }
    return tuple(
        record.result_of(row, named[row["mission"]], trips.get((row["mission"], row["trip"])))
        for row in stored
    )
