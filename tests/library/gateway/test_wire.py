"""What goes over the wire, and into the settings of the gateway's process, comes out as it was."""

from __future__ import annotations

import json
from collections.abc import Mapping

from hypothesis import given
from hypothesis import settings as limited
from hypothesis import strategies as st

from pluto_fleet.gateway.settings import data_of, settings_of
from pluto_fleet.gateway.wire import order_of
from pluto_fleet.jobs.controls import FleetDrone
from pluto_fleet.jobs.reports import (
    DroneReport,
    Entry,
    FleetReport,
    JobState,
    fleet_report_data,
    fleet_report_of,
    result_data,
)
from pluto_fleet.process.ipc import line, message_in
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from pluto_fleet.shared.domain.fleet_data import Feature, Source, WorldData
from pluto_fleet.shared.domain.model import Category, Photo
from pluto_fleet.shared.fleet.orders import failure_of
from pluto_fleet.shared.hooks.plain_data import value_of
from tests.library.gateway.flights import Task
from tests.library.gateway.processes import settings

names = st.text(max_size=12)
numbers = st.floats(allow_nan=False)
places = st.tuples(numbers, numbers, numbers)
photos = st.builds(
    Photo,
    position=places,
    width=numbers,
    height=numbers,
    sees=st.lists(names).map(tuple),
    sharpness=numbers,
)
results = st.one_of(st.none(), st.booleans(), numbers, names, photos)
failures = st.builds(FlightFailed, st.sampled_from(Failure), names)


def sent(message: Mapping[str, object]) -> dict[str, object]:
    told = line(message)
    assert told.count(b"\n") == 1
    heard = message_in(told)
    assert heard is not None
    return dict(heard)


@given(results)
def test_results_arrive_as_they_were(result: object) -> None:
    """Numbers to the last digit, photos with all they show."""
    assert value_of(sent(result_data(result))["value"]) == result


@given(failures)
def test_failures_arrive_as_they_were(error: FlightFailed) -> None:
    """Their kind, and every word."""
    heard = failure_of(sent(result_data(error)))
    assert (heard.failure, str(heard)) == (error.failure, str(error))


@given(names, st.lists(places).map(tuple), st.sampled_from([None, "measure"]), numbers)
def test_orders_arrive_as_they_were(
    id: str, stops: tuple[tuple[float, float, float], ...], action: str | None, amount: float
) -> None:
    """With their stops, their items and their parameters."""
    job = Task(id=id, stops=stops, action=action, parameters={"amount": amount, "what": id})
    order = job.order(1)
    assert order_of(sent(order), ["cf1"]) == {**order, "stops": [*map(list, stops)]}


@limited(max_examples=30)
@given(
    st.lists(
        st.builds(
            DroneReport,
            drone=names,
            reached=st.booleans(),
            location=places,
            landed=st.booleans(),
            battery_level=numbers,
            boot=st.integers(),
            carrying=st.none() | names,
            done=st.none() | st.dictionaries(names, results),
        )
    ),
    st.lists(
        st.builds(
            Entry,
            id=names,
            drone=names,
            state=st.sampled_from(JobState),
            boot=st.integers(),
            flies=st.booleans(),
            value=results,
            failure=names,
            reason=names,
        )
    ),
)
def test_a_roll_call_arrives_as_it_was(drones: list[DroneReport], jobs: list[Entry]) -> None:
    """Of all drones and of all jobs."""
    fleet_report = FleetReport(
        drones={report.drone: report for report in drones},
        jobs={entry.id: entry for entry in jobs},
    )
    assert fleet_report_of(sent(fleet_report_data(fleet_report))) == fleet_report


def test_settings_are_read_as_they_were_written() -> None:
    """All that the process must know, and nothing of the app."""
    category = Category(name="scout", actions=frozenset({"measure", "take_photo"}))
    whole = settings(
        drones=(FleetDrone(id="a", category=category, home=(1.0, 2.0, 0.0), index=3),),
        airspace=Airspace(size=(5.0, 6.0), no_fly=(((1.0, 1.0), (2.0, 1.0), (2.0, 2.0)),)),
        world=WorldData(
            features=(Feature(kind="bloom", at=(1.0, 2.0)),),
            sources=(Source(quantity="pm10", at=(1.0, 2.0), peak=3.0, radius=4.0),),
            background={"pm10": 2.0},
        ),
        faults=Faults(crash=0.5),
    )
    again = settings_of(json.loads(json.dumps(data_of(whole))))
    assert data_of(again) == data_of(whole)
    assert again.drones[0].category.can("measure")
    assert not again.drones[0].category.can("pick_item")
    assert again.airspace == whole.airspace
    assert again.world == whole.world
