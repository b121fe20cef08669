"""Drones that fly alone: one flies as it does with traffic, and what goes wrong is recovered from."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import replace
from functools import partial
from math import inf
from typing import TYPE_CHECKING, Any

import pytest

from pluto_fleet.flight import simulate as library
from pluto_fleet.flight.outcome import SimulationResult
from pluto_fleet.shared.alone.drones import IdealDrones
from pluto_fleet.shared.alone.simulate import IDLE
from pluto_fleet.shared.alone.world import CARRYING_HOME, OUTAGE, Faults
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.model import AfterTrip, Drone, Trip
from pluto_fleet.shared.domain.status import DroneStatus, Status
from pluto_fleet.shared.flow.own_action import OwnAction
from tests.equivalence.fly import alone as by_itself
from tests.kit import apps
from tests.kit.apps import A_WEEK, Example

if TYPE_CHECKING:
    from pluto_fleet.app import App
    from pluto_fleet.shared.hooks.context import Context

ROUGH = Faults(crash=0.03, link=0.15, action=0.15, battery=0.1)
SEEDS = range(1)
NO_FAULTS = Faults()


fly = partial(by_itself, seed=1, faults=Faults(), until=None, on_event=None)


def seen(
    fly: Callable[..., SimulationResult], app: App, example: Example, fleet: Any, **how: Any
) -> object:
    """Return all that can be seen of a run, to the last bit."""
    try:
        flown = fly(app, deepcopy(example.missions), fleet, until=A_WEEK, on_event=None, **how)
    except BadInput as error:
        return str(error)
    levels = [drone.battery_level for drone in flown.drones]
    places = [drone.location for drone in flown.drones]
    ends = [(mission.status, mission.reason) for mission in flown.missions]
    return flown.events, flown.duration, flown.flown, levels, places, ends


@pytest.mark.parametrize("faults", [Faults(), ROUGH], ids=["well", "rough"])
def test_one_drone_flies_as_it_does_with_traffic(example: Example, faults: Faults) -> None:
    """The same events at the same times, metres and batteries, also where things go wrong."""
    if example.fleet.world is not None and example.fleet.world.movers:
        pytest.skip("a gateway looks at what moves at other instants")
    alive = 0
    for category in example.app.categories:
        first = next((d for d in example.fleet.drones if d.category == category.name), None)
        if first is None:
            continue
        for after in AfterTrip:
            if after is AfterTrip.ONWARD:
                continue  # from the air it begins where it hovers, which telemetry tells less exactly
            fleet = replace(example.fleet, drones=(first,), after_trip=after)
            for seed in SEEDS:
                runs = [
                    seen(fly, example.app, example, fleet, seed=seed, faults=faults)
                    for fly in (library.simulate, by_itself)
                ]
                assert runs[0] == runs[1], (category.name, after, seed)
                alive += not isinstance(runs[0], str)
    assert alive


def test_every_example_completes_all_its_missions_alone(example: Example) -> None:
    """Its evaluators and actions find what they need in the same world."""
    outcome = fly(example.app, deepcopy(example.missions), example.fleet, seed=0)
    assert outcome.completed
    assert outcome.given_up == ""
    assert all(drone.status is DroneStatus.FREE for drone in outcome.drones)


class Sky:
    """Ideal drones without a brain: orders by hand."""

    def __init__(self, faults: Faults = NO_FAULTS, seed: int = 3) -> None:
        self.now = 0.0
        self.drones = IdealDrones(apps.app(apps.flow()), apps.fleet(), faults, seed, self)
        self.drone = self.drones.drones["cf1"]
        self._count = 0

    def order(self, do: str, **more: object) -> int:
        """Order something, and return its id."""
        self._count += 1
        self.drones.obey({"id": self._count, "do": do, "drone": "cf1", **more})
        return self._count

    def fly(self, **more: object) -> int:
        """Order a flight straight up, or what differs from that."""
        order: dict[str, object] = {"flight": "a/1/0/1", "stops": [(1.0, 1.0, 1.2)]}
        order |= {"action": None, "parameters": {}, "item": None, "seconds": 0.0}
        return self.order("fly", **(order | more))

    def told(self, until: float = inf) -> Mapping[str, Any]:
        """Return what they tell next; nothing, if there is nothing to tell until a time."""
        while (due := self.drones.due) <= until and due < inf:
            self.now = due
            if told := self.drones.advance():
                return told
        self.now = self.now if until == inf else until
        return {}


def test_what_is_beyond_the_map_is_refused_before_take_off() -> None:
    """The drone stays where it is, and the trip says why."""
    sky = Sky()
    flight = sky.fly(stops=[(30.0, 1.0, 1.2)])
    told = sky.told()
    assert (told["failed"], told["failure"]) == (flight, "REFUSED")
    assert "is outside the map" in told["reason"]
    assert sky.drone.flown(sky.now) == 0.0


@pytest.mark.parametrize(
    ("what", "reason", "status"),
    [
        ("crash", "cf1 crashed at", DroneStatus.LOST),
        ("link", "cf1 lost its link at", DroneStatus.FREE),
        ("battery", "cf1 ran out of battery at", DroneStatus.CHARGING),
        ("action", "take_photo failed: cf1 could not do it at", DroneStatus.FREE),
    ],
)
def test_each_mishap_happens_and_is_recovered_from(
    what: str, reason: str, status: DroneStatus
) -> None:
    """A crash loses the drone, an outage lasts its time, and a person carries home who cannot fly."""
    mission = apps.mission("a", apps.trip("1", 5.0))
    outcome = fly(apps.app(apps.flow()), [mission], apps.fleet(), faults=Faults(**{what: 1.0}))
    assert mission.status is Status.FAILED
    assert mission.reason.startswith(reason)
    drone = outcome.drones[0]
    assert drone.status is status
    if status is not DroneStatus.LOST:
        assert (drone.location, drone.telemetry.landed) == ((0.5, 0.5, 0.0), True)
        ends = apps.times(outcome, "drone.free") + apps.times(outcome, "drone.charging")
        least = {"link": OUTAGE, "battery": CARRYING_HOME, "action": 0.0}[what]
        assert apps.times(outcome, "trip.failed")[0] + least <= max(ends)


def test_a_drone_that_is_told_to_break_off_hovers_and_reports_nothing() -> None:
    """Its flight says nothing more, and the next order is carried out from there."""
    sky = Sky(seed=0)
    sky.fly(stops=[(5.5, 0.5, 1.2)])
    assert sky.told(8.0) == {}
    assert sky.drone.location == pytest.approx((2.5, 0.5, 1.2))
    sky.order("break_off")
    before = sky.drone.location
    assert sky.drones.due == inf
    assert sky.told(18.0) == {}
    assert sky.drone.location == before
    landing = sky.order("land")
    assert sky.told() == {"done": landing, "value": None}
    assert sky.drone.landed


def test_an_order_that_is_cancelled_leaves_the_drone_hovering() -> None:
    """And nothing is told of it; what it does not do cannot be cancelled."""
    sky = Sky(seed=0)
    way_up = sky.order("home")
    assert sky.told(1.0) == {}
    sky.order("cancel", order=way_up + 100)
    assert sky.told(2.0) == {}
    sky.order("cancel", order=way_up)
    assert sky.told(5.0) == {}
    assert sky.drone.location == pytest.approx((0.5, 0.5, 0.6))
    assert not sky.drone.landed


def test_a_flight_that_is_broken_off_as_it_is_ordered_leaves_no_ground() -> None:
    """The drone begins after all that is ordered with it."""
    sky = Sky()
    sky.fly(stops=[(5.0, 0.5, 1.2)])
    sky.order("break_off")
    assert sky.told(10.0) == {}
    assert (sky.drone.landed, sky.drone.flown(sky.now)) == (True, 0.0)


async def turn_on(drone: Drone, trip: Trip, context: Context) -> tuple[float, float]:
    live = context.live(drone)
    before = await live.read("temperature")
    await live.write("temperature", 3.0)
    return before, await live.read("temperature")


def test_an_action_of_the_apps_own_reads_and_writes() -> None:
    """What was not written is measured where the drone is."""
    action = OwnAction(name="turn_on", hook=turn_on)
    tested = apps.app(apps.flow(), actions=[action])
    outcome = fly(tested, [apps.mission("a", apps.trip("1", 2.0, action="turn_on"))], apps.fleet())
    assert outcome.completed
    (completed,) = apps.events(outcome, "trip.completed")
    assert completed["t"] == 4.0 + 3.0


def test_what_never_ends_is_given_up() -> None:
    """As with traffic: so many flights a planned trip."""
    tested = apps.app(apps.flow(attempts=10**9))
    outcome = fly(
        tested, [apps.mission("a", apps.trip("1", 2.0))], apps.fleet(), faults=Faults(action=1.0)
    )
    assert outcome.given_up.startswith('mission "a" has set out 1000 times')


def test_a_simulation_ends_at_its_time() -> None:
    """Then nothing is over, and that is no failure."""
    tested = apps.app(apps.flow())
    mission = apps.mission("a", apps.trip("1", 9.0))
    outcome = fly(tested, [mission], apps.fleet(), seed=0, until=3.0)
    assert (outcome.duration, mission.status) == (3.0, Status.RUNNING)
    (drone,) = outcome.drones
    assert drone.location == pytest.approx((0.5, 0.5, 0.9))  # on its way up
    assert drone.battery_level == pytest.approx(1.0 - 3.0 / 420.0)


def test_a_simulation_goes_on_through_delays_of_years() -> None:
    """It is given up only when nothing is to come."""
    years = 3 * IDLE
    trips = [apps.trip("1", 2.0, delay=years), apps.trip("2", 3.0, delay=years)]
    outcome = fly(apps.app(apps.flow(clock=True)), [apps.mission("a", *trips)], apps.fleet())
    assert outcome.completed
    assert 2 * years < outcome.duration < 2 * years + 120.0
