"""Flights that follow what moves and act on the way: without traffic, and over the end of a brain."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from pluto_fleet.app import described
from pluto_fleet.flight.simulate import simulate
from pluto_fleet.shared.domain.fleet_data import WorldData
from tests.brain.events.test_pursuit import Trip, following, pursuing, walker
from tests.kit import apps
from tests.kit.living import Living


def test_drones_that_are_not_kept_apart_see_what_moves_too() -> None:
    mover = walker((8.0, 8.0), (2.0, 2.0))
    fleet = replace(apps.fleet(apart=0.0), world=WorldData(movers=(mover,)))
    mission = apps.mission("m", following())
    how: Any = {"seed": 1, "faults": apps.NO_FAULTS, "until": None, "on_event": None}
    assert simulate(described(pursuing()), [mission], fleet, **how).completed


def patrol() -> Any:
    """Return a mission that looks along its way."""
    trip = Trip(name="p", action="take_photo", target=(15.0, 0.5, 1.2), along={"action": "look"})
    return apps.mission("m", trip)


def test_an_action_on_the_way_begins_again_with_the_next_brain() -> None:
    """Of a flight that flies on: once in each brain, and never when none lives, or the flight is over."""
    looked: list[list[float]] = []

    async def look(drone: Any, trip: Any, context: Any) -> None:
        looked.append([])
        while True:
            looked[-1].append(context.now)
            await context.sleep(0.5)

    living = Living(described(pursuing(look)), patrol())
    living.crash(5.0, down=3.0)
    assert living.run() == ["COMPLETED"]
    first, second = looked
    assert max(first) <= 5.0
    assert min(second) >= 8.0
    (done,) = living.times("trip.completed")
    assert max(second) <= done
    assert len(living.times("trip.launched")) == 1


def test_what_is_told_of_a_track_has_its_time_as_all_else() -> None:
    """Rounded to milliseconds, it would be later than what comes just after it."""
    trip = Trip(name="1", action="take_photo", target=(9.0, 0.5, 1.2))
    living = Living(described(pursuing()), apps.mission("m", trip))
    walks = {"tracks": {"t1": {"kind": "person", "at": [3.0, 3.0, 0.0]}}}
    living.at(1.0006, lambda: living.life.told(walks))
    living.at(1.0007, lambda: living.life.note("log", text="later", mission=None))
    living.run()
    times = [float(str(event["t"])) for event in living.memory.events]
    assert "tracked" in [event["event"] for event in living.memory.events]
    assert times == sorted(times)
