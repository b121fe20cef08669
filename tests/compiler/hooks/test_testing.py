"""The kit that packages carry: a hook is called as in flight, and a test moves the time by hand."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest

from pluto_fleet.shared.alone.testing import AppKit
from pluto_fleet.shared.domain.actions import BUILT_IN, Action, Parameter
from pluto_fleet.shared.domain.app import App
from pluto_fleet.shared.domain.errors import ActionFailed
from pluto_fleet.shared.domain.model import Category, Drone, Mission, Results, Trip
from pluto_fleet.shared.domain.quantities import Type
from pluto_fleet.shared.domain.status import Status, TripStatus
from pluto_fleet.shared.hooks.context import Context, LiveDrone

SCOUT = Category(name="scout", actions=frozenset({"take_photo"}))
CARRIER = Category(name="carrier", payload=0.2, actions=frozenset({"pour"}))
POUR = Action(
    name="pour",
    parameters=(
        Parameter(name="amount", type=Type.MASS),
        Parameter(name="height", type=Type.LENGTH, default=1.5),
    ),
)


async def _no_flow(run: Any) -> Status:
    raise AssertionError("nothing flies in a test of a hook")


APP = App(
    name="greenhouse",
    title="",
    flow=_no_flow,
    mission=Mission,
    trip=Trip,
    fields=(),
    categories=(SCOUT, CARRIER),
    actions={**BUILT_IN, "pour": POUR},
)


@pytest.fixture
def kit() -> AppKit[Mission[Trip], Trip, Results[Mission[Trip], Trip]]:
    return AppKit(APP)


Kit = AppKit[Mission[Trip], Trip, Results[Mission[Trip], Trip]]


async def pour(drone: Drone, trip: Trip, context: Context, *, amount: float) -> float:
    live = context.live(drone)
    if await live.read("range.zrange") > 1500.0:
        raise ActionFailed("there is nothing below it")
    await live.write("pump.ml", amount)
    await context.sleep(5.0)
    context.log(f"{drone.id} has poured at {context.now:g} s")
    return await live.read("pump.poured")


def test_a_hook_goes_on_with_the_clock(kit: Kit) -> None:
    """And what it has set, logged and given is read back."""
    context, drone = kit.context(), kit.drone("carrier")
    context.sensors |= {"range.zrange": 900.0, "pump.poured": lambda: 19.0 + kit.clock.now / 5.0}
    call = kit.start(pour, drone, kit.trip("pour"), context, amount=20.0)
    kit.clock.advance(4.9)
    assert not call.done and context.written == {"pump.ml": 20.0} and context.lines == []
    kit.clock.advance(0.1)
    assert call.done and call.result() == 20.0
    assert context.lines == ["carrier 1 has poured at 5 s"]


def test_what_a_hook_raises_reaches_the_test_as_it_is(kit: Kit) -> None:
    """`ActionFailed`, a mistake, and what pytest itself raises."""
    context = kit.context()
    context.sensors["range.zrange"] = 2000.0
    with pytest.raises(ActionFailed, match=r"^there is nothing below it$"):
        kit.call(pour, kit.drone(), kit.trip(), context, amount=20.0)
    mine = ZeroDivisionError()

    def wrong(mission: Mission[Trip], context: Context) -> None:
        raise mine

    call = kit.start(wrong, kit.mission(), kit.context())
    with pytest.raises(ZeroDivisionError) as raised:
        call.result()
    assert raised.value is mine

    def unexpected(mission: Mission[Trip], results: Results[Mission[Trip], Trip]) -> None:
        pytest.fail("it is not to be asked")

    with pytest.raises(pytest.fail.Exception, match="it is not to be asked"):
        kit.call(unexpected, kit.mission(), kit.results(kit.mission()))
    assert kit.call(lambda: 1) == 1, "the kit goes on"


def test_a_name_that_the_drone_has_not_fails_the_action(kit: Kit) -> None:
    """As in flight; so does a sensor that a test has made fail."""
    with pytest.raises(ActionFailed, match=r"^scout 1 has no range.zrange$"):
        kit.call(pour, kit.drone(), kit.trip(), kit.context(), amount=1.0)

    def broken() -> float:
        raise ActionFailed("the link is gone")

    context = kit.context()
    context.sensors["range.zrange"] = broken
    with pytest.raises(ActionFailed, match="the link is gone"):
        kit.call(pour, kit.drone(), kit.trip(), context, amount=1.0)


def test_the_live_drone_is_the_actions_and_ends_with_it(kit: Kit) -> None:
    """It says where the drone is, and what its battery has, as the test changes it."""
    kept: list[LiveDrone] = []
    drone, other = kit.drone(at=(1.0, 2.0, 1.0), battery=0.5), kit.drone()

    async def look(drone: Drone, trip: Trip, context: Context) -> tuple[object, ...]:
        live = context.live(drone)
        kept.append(live)
        with pytest.raises(RuntimeError, match="scout 2 does not do this action"):
            context.live(other)
        before = (live.position, live.battery)
        await context.sleep(1.0)
        return (*before, live.position, live.battery)

    call = kit.start(look, drone, kit.trip(), kit.context())
    kit.move(drone, battery=0.25)
    kit.clock.advance(1.0)
    assert call.result() == ((1.0, 2.0, 1.0), 0.5, (1.0, 2.0, 1.0), 0.25)
    with pytest.raises(RuntimeError, match="the action of scout 1 is over"):
        _ = kept[0].battery


def test_only_an_action_that_may_wait_has_a_live_drone(kit: Kit) -> None:
    """A test does not pass with what fails in flight; the same context has one again later."""
    context = kit.context()

    def plain(drone: Drone, trip: Trip, context: Context) -> float:
        return context.live(drone).battery

    async def modifier(mission: Mission[Trip], context: Context) -> float:
        return context.live(kit.drone()).battery

    async def waiting(drone: Drone, trip: Trip, context: Context) -> float:
        return context.live(drone).battery

    for _ in range(2):
        with pytest.raises(RuntimeError, match="only an action that is an `async def`"):
            kit.call(plain, kit.drone(), kit.trip(), context)
        with pytest.raises(RuntimeError, match="only an action that is an `async def`"):
            kit.call(modifier, kit.mission(), context)
        assert kit.call(waiting, kit.drone(), kit.trip(), context) == 1.0


async def limit_trip(mission: Mission[Trip], context: Context, *, limit: float) -> Status:
    if not await context.trip_ended(mission.current, within=limit):
        return Status.FAILED
    return mission.status


def test_a_modifier_waits_for_the_end_of_a_trip(kit: Kit) -> None:
    """Which is the test's to say."""
    mission = kit.mission(kit.trip(), kit.trip())
    kit.launch(mission)
    assert (mission.status, mission.attempts) == (Status.RUNNING, 1)
    call = kit.start(limit_trip, mission, kit.context(), limit=60.0)
    kit.clock.advance(30.0)
    assert not call.done and mission.current.elapsed == 30.0 and not mission.current.expired(60.0)
    kit.complete(mission)
    assert call.result() is Status.STANDBY
    (done,) = mission.completed_trips
    assert (done.status, done.end_time) == (TripStatus.COMPLETED, 30.0)


def test_a_modifier_waits_no_longer_than_its_limit(kit: Kit) -> None:
    """A trip that has failed has ended, and can be put back."""
    mission = kit.mission()
    kit.launch(mission)
    kit.clock.advance(20.0)
    call = kit.start(limit_trip, mission, kit.context(), limit=60.0)
    kit.clock.advance(39.0)
    assert not call.done
    kit.clock.advance(1.0)
    assert call.result() is Status.FAILED
    kit.fail(mission, "its link was lost")
    trip = mission.current
    assert (mission.status, trip.reason, mission.reason) == (
        Status.FAILED,
        "its link was lost",
        "its link was lost",
    )
    assert kit.call(limit_trip, mission, kit.context(), limit=60.0) is Status.FAILED
    kit.launch(mission)
    with pytest.raises(ValueError, match="trip 1 is in flight"):
        kit.launch(mission)
    assert (trip.attempt, mission.attempts, trip.reason) == (2, 2, "")


def test_a_hook_that_never_ends_is_not_waited_for(kit: Kit) -> None:
    """Neither without an event, nor with events without end."""
    mission = kit.mission()
    kit.launch(mission)
    with pytest.raises(
        RuntimeError, match=r"^wait has not ended at 0 s: it waits for the clock, or"
    ):
        kit.call(wait, mission, kit.context())

    async def poll(mission: Mission[Trip], context: Context) -> None:
        while True:
            await context.sleep(600.0)

    with pytest.raises(RuntimeError, match=r"^poll has not ended at 86400 s"):
        kit.call(poll, mission, kit.context())


async def wait(mission: Mission[Trip], context: Context) -> None:
    await context.trip_ended(mission.current)


def test_a_hook_can_be_called_off(kit: Kit) -> None:
    """As when its drone fails: what it has as `finally` is run."""
    closed: list[bool] = []

    async def grip(drone: Drone, trip: Trip, context: Context) -> None:
        try:
            await context.sleep(10.0)
        finally:
            closed.append(True)

    call = kit.start(grip, kit.drone(), kit.trip(), kit.context())
    call.cancel()
    assert closed == [True] and call.done


def test_an_evaluator_gets_what_is_new_once(kit: Kit) -> None:
    """And what all missions ever gave, as a context has it."""
    mission, other = kit.mission(kit.trip(), kit.trip()), kit.mission()
    kit.complete(mission, 1.0)
    kit.complete(other, 2.0)
    kit.complete(mission, 3.0)
    assert mission.status is Status.COMPLETED
    results = kit.results(mission)
    assert [(r.trip.name, r.value) for r in results.new] == [("trip 1", 1.0), ("trip 2", 3.0)]
    assert [r.value for r in results.all] == [1.0, 2.0, 3.0]
    assert list(kit.results(mission).new) == []
    assert [r.value for r in kit.context().results] == [1.0, 2.0, 3.0]


def test_trips_missions_and_drones_have_defaults(kit: Kit) -> None:
    """Those of the app: its first category, what its drones can do, its actions' parameters."""
    assert kit.trip().action == "take_photo", "no drone can measure"
    trip = kit.trip("pour", parameters={"amount": 0.02}, name="roses", target=(1.0, 1.0, 2.0))
    assert trip.parameters == {"amount": 0.02, "height": 1.5}
    assert (trip.name, trip.target) == ("roses", (1.0, 1.0, 2.0))
    mission = kit.mission(trip, kit.trip(), name="m")
    assert [one.index for one in mission.trips] == [0, 1] and mission.name == "m"
    assert (kit.mission().name, len(kit.mission().trips)) == ("mission 2", 1)
    drone = kit.drone(at=(3.0, 4.0, 0.0), battery=0.3)
    assert (drone.id, drone.category, drone.index) == ("scout 1", SCOUT, 0)
    assert (drone.battery_level, drone.distance((0.0, 0.0, 0.0))) == (0.3, 5.0)
    assert kit.drone("carrier").category is CARRIER


def test_a_policy_chooses_among_drones_that_a_test_has_placed(kit: Kit) -> None:
    def nearest(trip: Trip, candidates: Sequence[Drone]) -> Drone | None:
        return min(candidates, key=lambda drone: drone.distance(trip.target), default=None)

    near, far = kit.drone(at=(3.0, 3.0, 0.0)), kit.drone(at=(9.0, 9.0, 0.0))
    assert kit.call(nearest, kit.trip(), [far, near]) is near
    kit.move(near, to=(20.0, 20.0, 0.0))
    assert kit.call(nearest, kit.trip(), [far, near]) is far


@pytest.mark.parametrize("seconds", [-1.0, float("inf"), float("nan")])
def test_time_passes_forwards_and_ends(kit: Kit, seconds: float) -> None:
    with pytest.raises(ValueError, match="time cannot pass by"):
        kit.clock.advance(seconds)
