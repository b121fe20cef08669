"""Tests of hooks.py. In the package they are run by `pytest`: cp test_hooks.py drugs_distribution_timer/tests/"""

from __future__ import annotations

from drugs_distribution_timer import Mission, Status, hooks
from drugs_distribution_timer.testing import Clock, Kit, KitContext


def test_a_trip_in_time_is_left_alone(
    kit: Kit, clock: Clock, mission: Mission, context: KitContext
) -> None:
    kit.launch(mission)
    call = kit.start(hooks.limit_trip, mission, context, limit=120.0)
    clock.advance(119.0)
    assert not call.done
    kit.complete(mission)
    assert call.result() is Status.COMPLETED
    assert context.lines == []


def test_a_trip_that_takes_too_long_is_called_back(
    kit: Kit, clock: Clock, mission: Mission, context: KitContext
) -> None:
    kit.launch(mission)
    clock.advance(30.0)  # the limit counts from the trip's start, and not from the call
    call = kit.start(hooks.limit_trip, mission, context, limit=120.0)
    clock.advance(90.0)
    assert call.result() is Status.FAILED
    assert context.lines == ["trip trip 1 is called back after 120 s"]


def test_a_trip_that_fails_by_itself_stays_failed(
    kit: Kit, mission: Mission, context: KitContext
) -> None:
    kit.launch(mission)
    call = kit.start(hooks.limit_trip, mission, context, limit=120.0)
    kit.fail(mission, "its link was lost")
    assert call.result() is Status.FAILED
    assert context.lines == []
