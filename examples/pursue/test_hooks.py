"""Tests of hooks.py. In the package they are run by `pytest`: cp test_hooks.py pursue/tests/"""

from __future__ import annotations

from pursue import Status, hooks
from pursue.testing import Clock, Kit, KitContext


def test_who_is_seen_is_said(kit: Kit, clock: Clock, context: KitContext) -> None:
    context.see("t7", kind="person", at=(3.0, 4.0, 0.0))
    drone = kit.drone("scout")
    trip = kit.trip("take_photo")
    call = kit.start(hooks.look, drone, trip, context, reach=0.7, bound=5.0)
    clock.advance(hooks.LOOKS)
    event, facts = context.emitted[0]
    assert (event, facts["id"], facts["at"]) == ("intruder", "seen t7", (3.0, 4.0, 0.0))
    assert (facts["reach"], facts["bound"]) == (0.7, 5.0)
    call.cancel()


def test_a_chase_has_a_bound(kit: Kit, context: KitContext) -> None:
    event = kit.event("intruder", at=(3.0, 4.0, 0.0), track="t7", reach=8.0, bound=12.0)
    mission = kit.call(hooks.chase, event, context)
    assert mission is not None
    assert (mission.name, mission.promises) == ("chase t7", {"deadline": 12.0})
    assert (mission.trips[0].track, mission.trips[0].reach) == ("t7", 8.0)
    assert kit.call(hooks.chase, kit.event("intruder"), context) is None


def test_a_picture_is_said(kit: Kit, context: KitContext) -> None:
    mission = kit.mission(kit.trip("take_photo", track="t7"), kit.trip("take_photo"))
    kit.complete(mission)
    kit.call(hooks.tell_pictured, mission, context)
    assert [event for event, _ in context.emitted] == ["pictured"]


def test_a_picture_makes_a_follower(kit: Kit, context: KitContext) -> None:
    event = kit.event("pictured", at=(3.0, 4.0, 1.0), track="t7")
    mission = kit.call(hooks.stay_with, event, context)
    assert mission is not None
    assert mission.trips[0].parameters == {"for": hooks.STAYS, "every": 2.0}


def test_a_broken_bound_releases_who_is_stayed_with(kit: Kit, context: KitContext) -> None:
    follow = kit.trip("follow", parameters={"for": 30.0})
    follower = kit.mission(follow, name="stay with t7")
    assert kit.call(hooks.release, follower, context) is Status.COMPLETED
    assert follower.trips == []
