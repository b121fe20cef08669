"""Real time drives the same coroutines: short flights, no sleeping in the test itself."""

from __future__ import annotations

import asyncio
import threading
from collections.abc import Callable
from functools import partial

import pytest

from pluto_fleet.process.realtime import RealTime
from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import Category, Drone
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.hooks.context import Context
from pluto_fleet.shared.time.kernel import EventKind
from tests.kit import apps, in_real_time

FAST = Category(name="scout", speed=200.0)
LOW = Airspace(cruise_height=0.003)


async def blink(drone: Drone, trip: apps.Trip, context: Context) -> int:
    """An action of the app's own that uses asyncio and its context; it gives the thread."""
    await asyncio.sleep(0)
    await context.sleep(0.001)
    return threading.get_ident()


def fly(*missions: apps.Mission) -> tuple[apps.SimulationResult, list[Event]]:
    seen: list[Event] = []
    for index, mission in enumerate(missions):
        mission.index = index
    outcome = in_real_time.fly(
        apps.app(
            apps.flow(watch=apps.timed),
            categories=[FAST],
            actions=[OwnAction(name="blink", hook=blink, takes=0.01)],
        ),
        missions,
        apps.fleet((0.5, 0.5, 0.0), (1.5, 0.5, 0.0), airspace=LOW),
        seen.append,
    )
    return outcome, seen


def low(name: str, x: float) -> apps.Trip:
    return apps.Trip(name=name, action="blink", target=(x, 0.5, 0.003))


def test_missions_fly_side_by_side_in_one_thread() -> None:
    outcome, seen = fly(
        apps.mission("a", low("A", 3.0), low("B", 4.0), safe_time=60.0),
        apps.mission("b", low("A", 3.0), safe_time=60.0),
    )
    assert outcome.completed
    values = {event["value"] for event in seen if event["event"] == "trip.completed"}
    assert values == {str(threading.get_ident())}
    launches = [event["mission"] for event in seen if event["event"] == "trip.launched"]
    assert launches[:2] == ["a", "b"]


def hooked(hook: Callable[..., object]) -> str:
    """Fly a mission with this action, and say why it failed or what it gave."""
    seen: list[Event] = []
    mission = apps.mission("m", low("A", 3.0))
    in_real_time.fly(
        apps.app(
            apps.flow(),
            categories=[FAST],
            actions=[OwnAction(name="blink", hook=hook, takes=0.01)],
        ),
        [mission],
        apps.fleet(airspace=LOW),
        seen.append,
    )
    return mission.reason or next(
        str(event["value"]) for event in seen if event["event"] == "trip.completed"
    )


@pytest.mark.parametrize(
    ("error", "says"),
    [
        (StopIteration(), "raised StopIteration"),
        (SystemExit(3), "hook raises raised SystemExit: 3"),
        (asyncio.CancelledError(), "hook raises raised CancelledError"),
    ],
)
def test_any_error_of_a_hook_ends_its_mission_and_never_hangs(
    error: BaseException, says: str
) -> None:
    def raises(drone: Drone, trip: apps.Trip, context: Context) -> None:
        raise error

    assert says in hooked(raises)


def test_real_time_takes_the_same_events_in_the_same_order() -> None:
    async def main() -> list[str]:
        kernel, seen = RealTime(), list[str]()
        when = kernel.now + 0.05  # a busy machine may need some of it to get there
        for kind, key in [(EventKind.TIMER, 0), (EventKind.FLIGHT, 1), (EventKind.FLIGHT, 0)]:
            kernel.at(when, kind, key, partial(seen.append, f"{kind.name} {key}"))
        task = kernel.spawn(kernel.sleep(0.09), 0, "sleeper")
        await kernel.run(task)
        return seen

    assert asyncio.run(main()) == ["FLIGHT 0", "FLIGHT 1", "TIMER 0"]
