"""Tests of hooks.py: yours. plutoc wrote this file once, and never touches it again.

Each shows how a hook is called, and passes with any result: say there what yours shall do.
conftest.py has the fixtures.
The time stands still until a test moves it, and a drone measures what the test says:

    context.sensors["range.front"] = 0.4
    call = kit.start(hooks.pollinate, drone, trip, context)
    clock.advance(5.0)
    assert call.done and context.lines == ["what it has logged"]
"""

from __future__ import annotations

from alfalfa import ActionFailed, Mission, Verdict, hooks
from alfalfa.testing import Kit, KitContext


def test_pollinate(kit: Kit, context: KitContext) -> None:
    """It is done, or says why it cannot be."""
    drone = kit.drone("carrier")
    trip = kit.trip("pollinate")
    try:
        kit.call(hooks.pollinate, drone, trip, context, dose=5e-05)
    except ActionFailed as failed:
        assert str(failed)


def test_find_blooms(kit: Kit, mission: Mission) -> None:
    """It judges a mission whose trip is done."""
    kit.complete(mission, 20.0)
    verdict = kit.call(hooks.find_blooms, mission, kit.results(mission))
    assert isinstance(verdict, Verdict)
