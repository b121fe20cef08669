"""Drones that fly alone: one flies as it does with traffic, and what goes wrong is recovered from."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from copy import deepcopy
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any, cast

import pytest

from pluto_fleet.flight import simulate as library
from plutoc_runtime.alone import simulate as alone
from plutoc_runtime.alone.faults import CARRYING_HOME, OUTAGE, Faults
from plutoc_runtime.alone.ideal import IdealNavigation
from plutoc_runtime.alone.simulate import SimulationResult
from plutoc_runtime.domain.actions import Plain
from plutoc_runtime.domain.airspace import Airspace
from plutoc_runtime.domain.errors import BadInput, Cancelled, Failure, FlightFailed
from plutoc_runtime.domain.model import AfterTrip, Category, Drone, Item, Point, Trip
from plutoc_runtime.domain.status import DroneStatus, Status
from plutoc_runtime.flow.engine import Session
from plutoc_runtime.flow.own_action import OwnAction
from plutoc_runtime.time.future import Future
from plutoc_runtime.time.kernel import FLEET
from plutoc_runtime.time.virtual import VirtualTime
from tests.flying import A_WEEK, Example
from tests.runtime import apps

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.hooks.context import Context
    from plutoc_runtime.trips.flight import Flight

ROUGH = Faults(crash=0.03, link=0.15, action=0.15, battery=0.1)
SEEDS = range(6)
NO_FAULTS = Faults()


fly = partial(alone.simulate, seed=1, faults=Faults(), until=None, on_event=None)


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
def test_one_drone_flies_as_it_does_with_traffic(
    example: Example, example_app: App, faults: Faults
) -> None:
    """The same events at the same times, metres and batteries, also where things go wrong."""
    alive = 0
    for category in example_app.categories:
        first = next((d for d in example.fleet.drones if d.category == category.name), None)
        if first is None:
            continue
        for after in AfterTrip:
            fleet = replace(example.fleet, drones=(first,), after_trip=after)
            for seed in SEEDS:
                runs = [
                    seen(fly, example_app, example, fleet, seed=seed, faults=faults)
                    for fly in (library.simulate, alone.simulate)
                ]
                assert runs[0] == runs[1], (category.name, after, seed)
                alive += not isinstance(runs[0], str)
    assert alive


def test_every_example_completes_all_its_missions_alone(example: Example, example_app: App) -> None:
    """Its evaluators and actions find what they need in the same world."""
    outcome = fly(example_app, deepcopy(example.missions), example.fleet, seed=0)
    assert outcome.completed
    assert outcome.given_up == ""
    assert all(drone.status is DroneStatus.FREE for drone in outcome.drones)


def test_drones_pass_through_each_other() -> None:
    """Two on one line arrive as each would alone: none waits."""
    on = apps.fleet((1.0, 1.0, 0.0), (5.0, 1.0, 0.0), apart=0.5)
    missions = [
        apps.mission("a", apps.trip("1", 5.0, 1.0), index=0),
        apps.mission("b", apps.trip("1", 1.0, 1.0), index=1),
    ]
    outcome = fly(apps.app(apps.flow()), missions, on)
    assert outcome.completed
    assert apps.times(outcome, "trip.completed") == [
        5.0,
        5.0,
    ]  # above their homes: their ways do not cross
    far = [
        apps.mission("c", apps.trip("1", 5.0, 1.0)),
        apps.mission("d", apps.trip("1", 5.0, 1.0), index=1),
    ]
    outcome = fly(apps.app(apps.flow()), far, on)
    assert apps.times(outcome, "trip.completed") == [5.0, 13.0]  # both at one place


def track(airspace: Airspace, mission: Any, home: Point, faults: Faults, seed: int) -> list[Point]:
    """Fly a mission and return where its drone was, every tenth of a second."""
    kernel = VirtualTime()
    on = apps.fleet(home, airspace=airspace)
    tested = apps.app(apps.flow())
    navigation = IdealNavigation(kernel, tested, on, faults, seed)
    over = Session(tested, on, kernel, navigation, []).start([mission])
    places, now = [], 0.0
    while not kernel.run(over, now):
        places.append(navigation.telemetry("cf1").location)
        now += 0.1
    kernel.close()
    assert mission.status in (Status.COMPLETED, Status.FAILED)
    return places


WALL = ((4.0, 0.0), (5.0, 0.0), (5.0, 8.0), (4.0, 8.0))


@pytest.mark.parametrize("faults", [Faults(), Faults(link=1.0), Faults(action=1.0)])
def test_no_drone_is_ever_in_a_no_fly_area(faults: Faults) -> None:
    """Neither on its way nor on the way home, nor where it sinks."""
    airspace = Airspace(no_fly=(WALL,))
    for seed in range(5):
        mission = apps.mission("a", apps.trip("1", 8.0, 2.0), apps.trip("2", 1.0, 7.0))
        places = track(airspace, mission, (1.0, 1.0, 0.0), faults, seed)
        assert max(place[0] for place in places) > (5.0 if faults == Faults() else 0.9)
        assert [place for place in places if airspace.problem(place)] == []
        steps = [abs(a[0] - b[0]) for a, b in pairwise(places)]
        assert max(steps) < 0.06 or faults == Faults(link=1.0)


@dataclass(frozen=True, kw_only=True)
class Told:
    """A job as the brain gives it."""

    id: str = "a/1/0/1"
    drone: str = "cf1"
    stops: tuple[Point, ...] = ((1.0, 1.0, 1.2),)
    action: str | None = None
    parameters: Mapping[str, Plain] = field(default_factory=dict)
    item: Item | None = None
    seconds: float = 0.0

    def begins(self) -> None:
        """Nothing waits for this."""


def reported(job: Told, faults: Faults = NO_FAULTS) -> tuple[object, IdealNavigation]:
    """Fly one job, and return what was reported of it."""
    kernel, over = VirtualTime(), Future[object]()
    navigation = IdealNavigation(kernel, apps.app(apps.flow()), apps.fleet(), faults, 3)
    navigation.fly(cast("Flight", job), over.set)
    assert kernel.run(over)
    return over.result(), navigation


def test_what_is_beyond_the_map_is_refused_before_take_off() -> None:
    """The drone stays where it is, and the trip says why."""
    said, navigation = reported(Told(stops=((30.0, 1.0, 1.2),)))
    assert isinstance(said, FlightFailed) and said.failure is Failure.REFUSED
    assert "is outside the map" in str(said)
    assert navigation.telemetry("cf1").flown == 0.0


def test_a_battery_drains_in_the_air_and_charges_at_home() -> None:
    """It is empty after its flight time, and full again after its charge time."""
    weak = Category(name="scout", flight_time=20.0, charge_time=100.0, reserve=0.0)
    hold = OwnAction(name="wait", hook=wait_long)
    tested = apps.app(apps.flow(), categories=[weak], actions=[hold])
    mission = apps.mission("a", apps.trip("1", 1.0, action="wait"))
    outcome = fly(tested, [mission], apps.fleet())
    assert "ran out of battery" in mission.reason
    assert apps.times(outcome, "trip.failed") == [20.0]
    (charging,) = apps.events(outcome, "drone.charging")
    assert (charging["t"], charging["battery"]) == (20.0 + CARRYING_HOME, 0.0)
    assert charging["at"] == [0.5, 0.5, 0.0]


async def wait_long(drone: Drone, trip: Trip, context: Context) -> None:
    await context.sleep(1000.0)


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


def test_what_was_picked_is_carried_and_grips_can_fail() -> None:
    """A drone carries one item, of no more than its payload, and releases what it carries."""
    tested = apps.app(apps.flow())
    well = apps.mission("a", apps.pick("1", 2.0), apps.release("2", 4.0))
    assert fly(tested, [well], apps.fleet()).completed
    item = Item(name="pills", mass=0.02)
    for job, why in (
        (Told(action="release_item"), "release_item failed: cf1 carries nothing at (1, 1)"),
        (
            Told(action="pick_item", item=item),
            "pick_item failed: pills weighs 20 g, cf1 carries at most 10 g at (1, 1)",
        ),
    ):
        assert str(reported(job)[0]) == why


def test_a_drone_that_is_told_to_break_off_hovers_and_reports_nothing() -> None:
    """A command raises; a job says nothing more."""
    kernel, tested = VirtualTime(), apps.app(apps.flow())
    navigation = IdealNavigation(kernel, tested, apps.fleet(), Faults(), 0)
    ends: list[str] = []

    async def trip() -> None:
        await navigation.takeoff("cf1", 1.2)
        try:
            await navigation.go_to("cf1", (5.5, 0.5, 1.2))
        except FlightFailed as error:
            ends.append(str(error))
        before = navigation.telemetry("cf1").location
        await kernel.sleep(10.0)
        ends.append(str(navigation.telemetry("cf1").location == before))
        await navigation.land("cf1")

    task = kernel.spawn(trip(), FLEET, "trip")
    assert not kernel.run(task, 8.0)
    assert navigation.telemetry("cf1").location == pytest.approx((2.5, 0.5, 1.2))
    navigation.break_off("cf1")
    assert kernel.run(task)
    assert ends == ["cf1 was told to break it off", "True"]
    assert navigation.telemetry("cf1").landed


def test_a_command_that_is_cancelled_leaves_the_drone_hovering() -> None:
    """As the protocol has it."""
    kernel, tested = VirtualTime(), apps.app(apps.flow())
    navigation = IdealNavigation(kernel, tested, apps.fleet(), Faults(), 0)
    up = kernel.spawn(navigation.takeoff("cf1", 1.2), FLEET, "up")
    assert not kernel.run(up, 2.0)
    up.cancel()
    assert isinstance(up.error, Cancelled)
    kernel.now = 5.0
    assert navigation.telemetry("cf1").location == pytest.approx((0.5, 0.5, 0.6))
    assert not navigation.telemetry("cf1").landed


def test_a_drone_that_has_crashed_is_lost() -> None:
    """It lies where it fell, and cannot be brought home."""
    said, navigation = reported(Told(stops=((4.0, 0.5, 1.2),)), Faults(crash=1.0))
    assert isinstance(said, FlightFailed) and said.failure is Failure.CRASH
    with pytest.raises(StopIteration, match="False"):
        navigation.recover("cf1").send(None)
    where = navigation.telemetry("cf1")
    assert (where.landed, where.location[2]) == (True, 0.0)
    with pytest.raises(FlightFailed, match="cf1 crashed at"):
        navigation.takeoff("cf1", 1.2).send(None)


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
