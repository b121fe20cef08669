"""Tests of hooks.py. In the package they are run by `pytest`: cp test_hooks.py night_round/tests/"""

from __future__ import annotations

from night_round import Mission, Photo, Trip, hooks
from night_round.testing import Clock, Kit, KitContext


def night(kit: Kit, **fields: object) -> Mission:
    """Return a mission of one bed."""
    return kit.mission(kit.trip("listen"), patient="Amato", **fields)


def photo(trip: Trip, *sees: str) -> Photo:
    return Photo(position=trip.target, width=2.0, height=1.5, sees=sees)


def test_a_drone_listens_for_its_seconds(kit: Kit, clock: Clock, context: KitContext) -> None:
    context.sensors["breaths"] = 15.0
    call = kit.start(hooks.listen, kit.drone(), kit.trip("listen"), context, seconds=6.0)
    clock.advance(5.9)
    assert not call.done
    clock.advance(0.1)
    assert call.result() == 15.0


def test_calm_breath_is_noted(kit: Kit) -> None:
    mission = night(kit)
    kit.complete(mission, 14.0)
    verdict = hooks.breathes_calmly(mission, kit.results(mission), beyond=6.0)
    assert verdict.log == ["Amato sleeps: 14 breaths a minute"] and not verdict.redo


def test_a_little_too_fast_is_listened_to_once_more(kit: Kit) -> None:
    mission = night(kit, most=12.0)
    kit.complete(mission, 14.0)
    verdict = hooks.breathes_calmly(mission, kit.results(mission), beyond=6.0)
    assert verdict.redo == [mission.completed_trips[0]] and not verdict.log


def test_far_too_fast_calls_a_nurse_at_once(kit: Kit) -> None:
    mission = night(kit)
    kit.complete(mission, 30.0)
    verdict = hooks.breathes_calmly(mission, kit.results(mission), beyond=6.0)
    assert verdict.log == ["LOOK IN: Amato breathes 30 times a minute"]


def test_what_lies_about_is_told_with_its_place(kit: Kit) -> None:
    mission = kit.mission(kit.trip("take_photo"))
    kit.complete(mission, photo(mission.current, "pest"))
    (line,) = hooks.nothing_lies_about(mission, kit.results(mission)).log
    assert f"something lies at {mission.completed_trips[0].name}; 1 photos" in line
