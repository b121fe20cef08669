"""Tests of hooks.py: yours. plutoc wrote this file once, and never touches it again.

Each shows how a hook is called, and passes with any result: say there what yours shall do.
conftest.py has the fixtures.
The time stands still until a test moves it, and a drone measures what the test says:

    context.sensors["range.front"] = 0.4
    call = kit.start(hooks.look, drone, trip, context)
    clock.advance(5.0)
    assert call.done and context.lines == ["what it has logged"]
"""

from __future__ import annotations

from pursue import ActionFailed, Drone, IntruderEvent, Mission, Status, Trip, hooks
from pursue.testing import Kit, KitContext


def test_look(kit: Kit, drone: Drone, trip: Trip, context: KitContext) -> None:
    """It is done, or says why it cannot be."""
    try:
        kit.call(hooks.look, drone, trip, context)
    except ActionFailed as failed:
        assert str(failed)


def test_chase(kit: Kit, context: KitContext) -> None:
    """It makes a mission of an event, or none."""
    event = IntruderEvent(name="intruder", id="1", time=0.0)
    made = kit.call(hooks.chase, event, context)
    assert made is None or made.trips


def test_release_seen(kit: Kit, mission: Mission, context: KitContext) -> None:
    """It says with which status the mission goes on."""
    mission.trips.append(kit.trip())
    kit.complete(mission)
    status = kit.call(hooks.release_seen, mission, context)
    assert status in (Status.STANDBY, Status.COMPLETED)
