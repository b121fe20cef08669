"""Real time drives the same coroutines: short flights, no sleeping in the test itself."""

from __future__ import annotations

import asyncio
import threading

import pytest

from plutoc_runtime.actions import Action
from plutoc_runtime.airspace import Airspace
from plutoc_runtime.context import Context
from plutoc_runtime.fly import fly_simulated
from plutoc_runtime.model import Category, Drone
from plutoc_runtime.simulation.faults import Faults
from plutoc_runtime.trace import Event
from tests.runtime import apps

FAST = Category(name="scout", speed=200.0)
LOW = Airspace(cruise_height=0.003)


async def blink(drone: Drone, trip: apps.Trip, context: Context) -> int:
    """An action of the app's own that uses asyncio and its context."""
    await asyncio.sleep(0)
    await context.sleep(0.001)
    return threading.active_count()


def fly(*missions: apps.Mission) -> tuple[apps.Outcome, list[Event]]:
    seen: list[Event] = []
    for index, mission in enumerate(missions):
        mission.index = index
    outcome = asyncio.run(
        fly_simulated(
            apps.app(
                apps.flow(watch=apps.timed),
                categories=[FAST],
                actions=[Action(name="blink", hook=blink, seconds=0.01)],
            ),
            missions,
            apps.fleet((0.5, 0.5, 0.0), (1.5, 0.5, 0.0), airspace=LOW),
            seed=0,
            faults=Faults(),
            on_event=seen.append,
        )
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
    assert values == {"1"}
    launches = [event["mission"] for event in seen if event["event"] == "trip.launched"]
    assert launches[:2] == ["a", "b"]


def test_an_interrupted_flight_lands_every_drone_and_ends() -> None:
    landed: list[bool] = []

    async def main() -> None:
        seen: list[Event] = []
        mission = apps.mission("a", low("A", 19.0))
        mission.current.target = (19.0, 0.5, 0.003)
        slow = Category(name="scout", speed=0.5)
        flying = asyncio.ensure_future(
            fly_simulated(
                apps.app(
                    apps.flow(), categories=[slow], actions=[Action(name="blink", hook=blink)]
                ),
                [mission],
                apps.fleet(airspace=LOW),
                seed=0,
                faults=Faults(),
                on_event=seen.append,
            )
        )
        while not any(event["event"] == "trip.launched" for event in seen):
            await asyncio.sleep(0)
        drone = mission.current.drone
        assert drone is not None
        while drone.telemetry.landed:
            await asyncio.sleep(0)
        flying.cancel()
        with pytest.raises(asyncio.CancelledError):
            await flying
        landed.append(drone.telemetry.landed)

    asyncio.run(main())
    assert landed == [True]
