"""The example: this very app and fleet can fly it on this very map."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from pluto_fleet.app import App
from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.flight.simulate import simulate
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.actions import Action, Parameter
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.model import Category, Mission
from pluto_fleet.shared.domain.quantities import Type
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.station.plan.plan import MissionPlan
from tests.kit import apps
from tests.kit.apps import EXAMPLES
from tests.library.files.an_app import APP, PLAIN
from tests.library.station.plan.drawing import FLEET, drawn, mission
from tests.trials.examples import example, fleet_of

NAMES = sorted(path.parent.name for path in EXAMPLES.glob("*/app.pluto"))


def shown(app: App, fleet: FleetFile) -> MissionPlan:
    plan = MissionPlan(app, fleet, None)
    plan.example(plan.revision)
    return plan


def fly(app: App, fleet: FleetFile, missions: list[Mission[Any]]) -> None:
    simulate(app, missions, fleet, seed=1, faults=Faults(), until=None, on_event=lambda _: None)


@pytest.mark.parametrize("name", NAMES)
def test_every_example_app_flies_its_example(name: str) -> None:
    """Two or three missions of two or three trips, and all is completed."""
    app = example(name)
    fleet = fleet_of(name, app)
    missions, _ = shown(app, fleet).launchable()
    assert len(missions) in (2, 3)
    assert all(len(one.trips) in (2, 3) for one in missions)
    fly(app, fleet, missions)
    assert [one.status for one in missions] == [Status.COMPLETED] * len(missions)


def test_every_action_of_the_app_is_shown() -> None:
    """With an item where one is needed, and what its parameters need."""
    missions, _ = shown(APP, FLEET).launchable()
    assert {trip.action for one in missions for trip in one.trips} == set(APP.actions)
    weights = [trip.item.mass for one in missions for trip in one.trips if trip.item]
    assert weights == [0.0025, 0.0025]  # a carrier carries 5 g


def test_parameters_of_every_type_are_given() -> None:
    """Those without a default."""
    parameters = tuple(Parameter(name=kind.name.lower(), type=kind) for kind in Type)
    app = replace(PLAIN, actions={"do": Action(name="do", parameters=parameters)})
    missions, _ = shown(app, replace(FLEET, drones=of_category("drone"))).launchable()
    assert missions[0].trips[0].parameters.keys() == {kind.name.lower() for kind in Type}


def of_category(name: str) -> tuple[Any, ...]:
    return tuple(replace(drone, category=name) for drone in FLEET.drones)


def test_where_nothing_can_be_done_there_is_none() -> None:
    """And it is said why."""
    idle = Category(name="idle", actions=frozenset())
    app = apps.changed(PLAIN, categories=(idle,))
    with pytest.raises(BadInput, match="no example could be made: no drone of the fleet can do"):
        shown(app, replace(FLEET, drones=of_category("idle")))


def test_an_example_is_added_to_what_was_drawn() -> None:
    """With names of its own, and the same each time."""
    plan = drawn(mission("mission-one", name="Example 1"))
    plan.example(plan.revision)
    plan.example(plan.revision)
    missions: Any = plan.data()["missions"]
    assert [one["name"] for one in missions] == [f"Example {i}" for i in range(1, 8)]
    assert plan.launchable()[1] == [one["key"] for one in missions]
    assert shown(APP, FLEET).export_toml() == shown(APP, FLEET).export_toml()
