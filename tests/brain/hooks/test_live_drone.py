"""An action of the app's own asks its drone, and sets what is on it, while it hovers."""

from __future__ import annotations

from asyncio import wait_for
from collections.abc import Callable
from contextlib import suppress
from functools import partial, wraps

import pytest

from pluto_fleet.jobs.controls import Read
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import ActionFailed, Failure, FlightFailed
from pluto_fleet.shared.domain.model import Category, Drone
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.hooks.context import Context, LiveDrone, can_wait
from pluto_fleet.shared.time.kernel import Future
from pluto_fleet.simulation.drones import CARRIES_OUT, SimulatedNavigation
from tests.kit import apps, in_real_time

Hook = Callable[..., object]

FAST = Category(name="scout", speed=200.0)


def flown(hook: Hook, *, real: bool = False, apart: float = 0.0) -> apps.SimulationResult:
    """Return what comes of a mission with this action, in virtual or in real time.

    In virtual time only drones that are kept apart are flown by a navigation.
    """
    action = OwnAction(name="grip", hook=hook)
    height = 0.003 if real else 1.2
    trip = apps.Trip(name="A", action="grip", target=(3.0, 0.5, height))
    homes, space = ((0.5, 0.5, 0.0), (1.5, 0.5, 0.0)), Airspace(cruise_height=height)
    fleet = apps.fleet(*homes, airspace=space, apart=apart)
    app = apps.app(apps.flow(), categories=[FAST], actions=[action])
    mission = apps.mission("field", trip)
    if real:
        return in_real_time.fly(app, [mission], fleet, lambda _: None)
    return apps.fly(app, mission, on=fleet)


def reason(hook: Hook, *, real: bool = False, apart: float = 0.0) -> str:
    """Return why the mission with this action fails."""
    (mission,) = flown(hook, real=real, apart=apart).missions
    assert mission.status is Status.FAILED
    return mission.reason


@pytest.mark.parametrize("real", [False, True])
def test_what_was_set_is_read_again(real: bool) -> None:
    """In a simulation a drone keeps what it was set to, and measures its world otherwise."""
    seen: list[object] = []

    async def grip(drone: Drone, trip: apps.Trip, context: Context) -> float:
        live = context.live(drone)
        seen.append(await live.read("gripper.closed"))
        await live.write("gripper.closed", 1)
        seen.append(await live.read("gripper.closed"))
        seen.extend([live.position == drone.location, live.battery <= 1.0])
        return await live.read("temperature")

    outcome = flown(grip, real=real)
    assert outcome.completed
    assert seen == [0.0, 1.0, True, True]


@pytest.mark.parametrize("real", [False, True])
@pytest.mark.parametrize("failure", [Failure.ACTION, Failure.LINK])
def test_a_drone_that_has_it_not_fails_the_action(
    monkeypatch: pytest.MonkeyPatch, real: bool, failure: Failure
) -> None:
    """The trip fails with what the drone says; the hook may catch it and do without."""

    async def refuse(_: object, drone: str, name: str) -> float:
        raise FlightFailed(failure, f"{drone} has no log variable {name}")

    async def grip(drone: Drone, trip: apps.Trip, context: Context) -> object:
        return await context.live(drone).read("range.front")

    async def without(drone: Drone, trip: apps.Trip, context: Context) -> object:
        try:
            return await grip(drone, trip, context)
        except ActionFailed:
            return None

    monkeypatch.setitem(CARRIES_OUT, Read, refuse)
    expected = "has no log variable range.front"
    said = reason(grip, real=real, apart=0.5)
    assert said.endswith(expected)
    assert "grip failed" in said
    assert flown(without, real=real, apart=0.5).completed


@pytest.mark.parametrize("real", [False, True])
def test_a_drone_is_let_go_when_the_action_is_over(real: bool) -> None:
    """One that keeps the handle can neither ask nor set anything any more."""
    kept: list[LiveDrone] = []

    async def grip(drone: Drone, trip: apps.Trip, context: Context) -> None:
        kept.append(context.live(drone))

    assert flown(grip, real=real).completed
    (live,) = kept
    for use in (lambda: live.position, lambda: live.battery):
        with pytest.raises(RuntimeError, match="is over"):
            use()
    for ask in (live.read("range.front"), live.write("gripper.closed", 0)):
        with pytest.raises(RuntimeError, match="is over"):
            ask.send(None)


def test_only_its_own_drone_is_live() -> None:
    """Another drone may fly for another mission."""
    others: list[Drone] = []

    async def grip(drone: Drone, trip: apps.Trip, context: Context) -> None:
        if others:
            context.live(others[0])
        others.append(drone)

    trips = [apps.Trip(name=name, action="grip", target=(3.0, 0.5, 1.2)) for name in "AB"]
    app = apps.app(apps.flow(), actions=[OwnAction(name="grip", hook=grip)])
    fleet = apps.fleet((0.5, 0.5, 0.0), (9.5, 9.5, 0.0))
    outcome = apps.fly(app, apps.mission("1", trips[0]), apps.mission("2", trips[1]), on=fleet)
    failed = [one for one in outcome.missions if one.status is Status.FAILED]
    assert [one.reason for one in failed] == [
        f"hook grip raised RuntimeError: {others[0].id} does not do this action"
    ]


@pytest.mark.parametrize("real", [False, True])
def test_a_plain_function_is_told_that_it_must_be_async(real: bool) -> None:
    """It could not wait for an answer."""

    def grip(drone: Drone, trip: apps.Trip, context: Context) -> None:
        context.live(drone)

    assert "only an action that is an `async def` has a live drone" in reason(grip, real=real)


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("gripper.closed", float("nan"), "gripper.closed cannot be set to nan"),
        ("gripper.closed", float("inf"), "gripper.closed cannot be set to inf"),
        ("", 1.0, "a text of 1 to 100 characters"),
        ("x" * 101, 1.0, "a text of 1 to 100 characters"),
    ],
)
def test_what_no_drone_can_be_set_to_is_the_hooks_fault(name: str, value: float, says: str) -> None:
    """It never reaches the drone."""

    async def grip(drone: Drone, trip: apps.Trip, context: Context) -> None:
        await context.live(drone).write(name, value)

    assert says in reason(grip)


def unanswered(
    monkeypatch: pytest.MonkeyPatch,
    asked: Callable[[SimulatedNavigation, str], object] = lambda navigation, drone: None,
) -> list[str]:
    """Let no drone answer when it is asked; return the questions that are called off."""
    over: list[str] = []

    async def never(navigation: SimulatedNavigation, drone: str, name: str) -> float:
        asked(navigation, drone)
        try:
            await Future[None]()
        finally:
            over.append(name)
        return 0.0

    monkeypatch.setitem(CARRIES_OUT, Read, never)
    return over


@pytest.mark.parametrize("real", [False, True])
def test_an_answer_that_never_comes_ends_with_the_flight(
    monkeypatch: pytest.MonkeyPatch, real: bool
) -> None:
    """Something else fails the trip: the question is called off, and keeps no drone."""

    async def grip(drone: Drone, trip: apps.Trip, context: Context) -> None:
        await context.sleep(0.01)
        await context.live(drone).read("range.front")

    over = unanswered(monkeypatch, lambda navigation, it: navigation.strike(it, Failure.CRASH))
    assert "crashed at" in reason(grip, real=real, apart=0.5)
    assert over == ["range.front"]


def test_a_question_that_its_hook_gives_up_is_called_off(monkeypatch: pytest.MonkeyPatch) -> None:
    """The drone is not kept busy with it while the action goes on."""
    over = unanswered(monkeypatch)
    seen: list[str] = []

    async def grip(drone: Drone, trip: apps.Trip, context: Context) -> None:
        with suppress(TimeoutError):
            await wait_for(context.live(drone).read("range.front"), 0.01)
        await context.sleep(0.05)
        seen.extend(over)

    assert flown(grip, real=True).completed
    assert seen == ["range.front"]


def test_which_hooks_can_wait() -> None:
    """Decorated ones, too."""

    def noted(hook: Hook) -> Hook:
        @wraps(hook)
        def noting(*args: object) -> object:
            return hook(*args)

        return noting

    async def waits() -> None:
        """Nothing."""

    def does_not() -> None:
        """Nothing."""

    assert [can_wait(hook) for hook in (waits, noted(waits), partial(waits))] == [True] * 3
    assert not can_wait(does_not)
    assert not can_wait(noted(does_not))
