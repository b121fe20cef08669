"""What survives an app is rows: a brain made of them stands as the one before, and hooks see the same."""

from __future__ import annotations

import json
from typing import Any

import pytest

from pluto_fleet.app import App
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.model import Results
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.flow.record import fleet_data
from pluto_fleet.shared.hooks.context import Verdict
from tests.kit import apps
from tests.kit.living import Living, enterable


def plain(standing: Any) -> Any:
    """Return rows as a journal gives them back, without what a new brain is told of drones."""
    data = json.loads(json.dumps(standing))
    told = ("status", "at", "battery", "landed", "low", "aside", "ready_at", "unready")
    for drone in data["drones"].values():
        for fact in told:
            drone.pop(fact, None)
    return {fact: data[fact] for fact in ("missions", "drones", "results")}


def restored(app: App, living: Living, rows: Any) -> Any:
    """Return how a new brain stands that has these rows."""
    brain = app.new_brain(
        {**fleet_data(living.fleet), "recorded": True}, space=living.fleet.airspace
    )
    brain.restore(rows, living.kernel.now)
    found = plain(brain.standing())
    brain.close()
    return found


async def look(drone: Any, trip: Any, context: Any) -> float:
    """Wait a while, and give a number that JSON has not."""
    await context.sleep(2.0)
    return float("nan")


def judge(mission: Any, results: Results[Any, Any]) -> Verdict:
    """Have the first trip flown again, and add one, in the first round."""
    if mission.round or any(trip.added for trip in mission.completed_trips):
        return Verdict()
    new = type(mission.completed_trips[0])(name="new", action="measure", target=(4.0, 0.5, 1.2))
    return Verdict(redo=mission.completed_trips[:1], add=(new,))


def missions() -> list[apps.Mission]:
    """Return missions with items, delays, own actions, rounds and an order."""
    return [
        apps.mission("a", apps.pick("p", 3), apps.release("r", 6)),
        apps.mission("b", apps.trip("1", 4, delay=9.0), apps.trip("2", 5, action="look"), repeat=1),
        apps.mission("c", apps.trip("1", 3), promises={"after": ["a"], "deadline": 60.0}),
    ]


@pytest.mark.parametrize("seed", range(4))
def test_a_brain_that_is_made_of_rows_stands_as_the_one_before_at_every_event(seed: int) -> None:
    """With faults, commands of a person, and a restart on the way."""
    action = OwnAction(name="look", hook=look)
    app = enterable(clock=True, attempts=5, evaluator=judge, actions=(action,))
    faults = Faults(crash=0.05, link=0.1, action=0.2, battery=0.02)
    homes = ((0.5, 0.5, 0.0), (1.5, 0.5, 0.0), (2.5, 0.5, 0.0))
    living = Living(app, *missions(), on=apps.fleet(*homes), faults=faults)
    checked = 0

    def check(event: Event) -> None:
        nonlocal checked
        if not living.life.is_set_out:
            return
        rows = json.loads(json.dumps(living.life.brain.standing()))
        assert restored(app, living, rows) == plain(rows), event
        checked += 1

    def listen() -> None:
        living.life._listeners = (*living.life._listeners, check)

    listen()
    living.at(5.0 + seed, lambda: living.life.control.pause("b"))
    living.at(20.0 + seed, lambda: living.life.control.go_on("b"))
    living.at(31.0, lambda: living.life.control.retire("cf3"))
    living.at(33.0, lambda: living.life.control.skip("b"))
    living.crash(12.0 + 7 * seed)
    living.at(13.5 + 7 * seed, listen)
    living.kernel.run(living.done, 400.0)
    assert checked > 40


def test_hooks_see_of_earlier_trips_the_same_with_and_without_a_restart() -> None:
    """Start, end, how long, by which drone, and the results with their places."""

    def seen(*, restart: bool) -> list[object]:
        told: list[object] = []

        def note(mission: Any, results: Results[Any, Any]) -> Verdict:
            for trip in mission.completed_trips:
                told.append(
                    (trip.name, trip.start_time, trip.end_time, trip.elapsed, trip.drone.id)
                )
            told.extend((one.trip.name, one.value, one.time, one.place) for one in results.all)
            return Verdict()

        app = enterable(evaluator=note)
        living = Living(app, apps.mission("m", apps.trip("1", 3), apps.trip("2", 5)))
        if restart:
            living.crash(12.0, down=0.0)
        assert living.run() == ["COMPLETED"]
        return told

    assert seen(restart=True) == seen(restart=False)
