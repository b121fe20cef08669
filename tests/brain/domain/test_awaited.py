"""What a hook calls and does not await is not done: the hook's error says so, with the place."""

from __future__ import annotations

import inspect
import sys
import warnings
from collections.abc import Callable, Coroutine
from typing import Any

import pytest

from pluto_fleet.shared.alone.testing import AppKit
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.awaited import all_awaited
from pluto_fleet.shared.domain.model import Category
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.fleet.own_policy import own_policy
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.hooks.context import Context, Verdict
from tests.kit import apps, in_real_time

Fly = Callable[..., apps.SimulationResult]

pytestmark = pytest.mark.filterwarnings("error::RuntimeWarning")
"""Python itself has nothing left to warn of."""


async def later() -> None:
    """One of the developer's own."""


def dropped(drone: Any, trip: Any, context: Context) -> None:
    context.sleep(1.0)  # type: ignore[unused-coroutine]


async def at_the_end(drone: Any, trip: Any, context: Context) -> None:
    await context.sleep(0.001)
    context.live(drone).write("pump.ml", 1.0)  # type: ignore[unused-coroutine]


async def before_it_waits(drone: Any, trip: Any, context: Context) -> None:
    later()  # type: ignore[unused-coroutine]
    await context.sleep(1e6)


async def straight_through(drone: Any, trip: Any, context: Context) -> None:
    later()  # type: ignore[unused-coroutine]


async def returned(drone: Any, trip: Any, context: Context) -> object:
    await context.sleep(0.001)
    return context.live(drone).read("pump.ml")


def in_virtual_time(app: Any, mission: apps.Mission) -> apps.SimulationResult:
    return apps.fly(app, mission)


def in_true_time(app: Any, mission: apps.Mission) -> apps.SimulationResult:
    fleet = apps.fleet((0.5, 0.5, 0.0), airspace=Airspace(cruise_height=0.003))
    return in_real_time.fly(app, [mission], fleet, lambda event: None)


def flown_with(fly: Fly, hook: Callable[..., object]) -> apps.SimulationResult:
    app = apps.app(
        apps.flow(),
        categories=[Category(name="scout", speed=200.0)],
        actions=[OwnAction(name="act", hook=hook)],
    )
    return fly(app, apps.mission("m", apps.Trip(name="A", action="act", target=(0.6, 0.5, 0.003))))


@pytest.mark.parametrize("fly", [in_virtual_time, in_true_time])
@pytest.mark.parametrize(
    ("hook", "called", "line"),
    [
        (dropped, "Context.sleep", 1),
        (at_the_end, "LiveDrone.write", 2),
        (before_it_waits, "later", 1),
        (straight_through, "later", 1),
        (returned, "LiveDrone.read", 2),
    ],
)
def test_the_mission_fails_and_says_where(
    fly: Fly, hook: Callable[..., object], called: str, line: int
) -> None:
    """In virtual and in real time, at once, even if the hook would catch it."""
    outcome = flown_with(fly, hook)
    (mission,) = outcome.missions
    place = f"{__file__}:{inspect.getsourcelines(hook)[1] + line}"
    why = f"hook {hook.__name__} raised RuntimeError: it does not await {called}: {place}"
    assert (mission.status, mission.reason) == (Status.FAILED, why)
    assert place in outcome.log[0]


def test_evaluators_modifiers_and_policies_are_told_as_well() -> None:
    """A policy cannot wait; it can forget as much."""

    def judges(mission: Any, results: Any) -> Verdict:
        later()  # type: ignore[unused-coroutine]
        return Verdict()

    def changes(mission: Any, context: Context) -> None:
        context.trip_ended(mission.current)  # type: ignore[unused-coroutine]

    def chooses(trip: Any, candidates: Any) -> Any:
        later()  # type: ignore[unused-coroutine]
        return candidates[0]

    for flow, said in (
        (apps.flow(evaluator=judges), "hook judges raised RuntimeError: it does not await later"),
        (apps.flow(prepare=changes), "RuntimeError: it does not await Context.trip_ended: "),
        (apps.flow(policy=own_policy(chooses)), "RuntimeError: it does not await later: "),
    ):
        (mission,) = apps.fly(apps.app(flow), apps.mission("m", apps.trip("A", 2.0))).missions
        assert mission.status is Status.FAILED
        assert said in mission.reason


def test_a_test_of_the_hook_is_told_as_well() -> None:
    """The kit raises what the app is told."""
    kit = AppKit[Any, Any, Any](apps.app(apps.flow()))
    with pytest.raises(
        RuntimeError, match=r"it does not await Context\.sleep: .*test_awaited.*:\d+"
    ):
        kit.call(dropped, kit.drone(), kit.trip(), kit.context())


def test_what_is_awaited_later_or_closed_is_no_mistake() -> None:
    """Only what is gone is."""

    async def hook(drone: Any, trip: Any, context: Context) -> int:
        pause: Coroutine[Any, Any, None] = context.sleep(1.0)
        await context.sleep(1.0)
        await pause
        later().close()
        return 3

    outcome = flown_with(in_virtual_time, hook)
    assert outcome.completed
    assert [result.value for result in outcome.results] == [3]


def test_outside_of_a_hook_python_is_as_it_was() -> None:
    """Its own warning, and no traces of where coroutines come from."""
    before = vars(warnings)["_warn_unawaited_coroutine"]
    with pytest.raises(ValueError, match="of its own"):
        all_awaited(lambda: int("of its own"))
    assert vars(warnings)["_warn_unawaited_coroutine"] is before
    assert sys.get_coroutine_origin_tracking_depth() == 0
    with pytest.warns(RuntimeWarning, match="'later' was never awaited"):
        later()  # type: ignore[unused-coroutine]
