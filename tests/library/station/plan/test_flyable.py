"""Whether the fleet can fly what is drawn is found out beside the loop, and never forgotten."""

from __future__ import annotations

import asyncio
from dataclasses import replace
from typing import Any

import pytest

from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.plan.plan import MOST_SHOWN, MissionPlan
from tests.library.station.plan.drawing import FLEET, a_plan, drawn, mission, said, trip

WALL = ((8.0, 0.0), (9.0, 0.0), (9.0, 20.0), (8.0, 20.0))
WALLED = replace(FLEET, airspace=Airspace(no_fly=(WALL,)))
FAR = trip(target=[12, 1])


def told(plan: MissionPlan) -> int:
    """Return how many problems a page would see now."""
    problems: Any = plan.data()["problems"]
    return len(problems)


def test_it_is_told_once_it_is_known() -> None:
    """What can be seen at once is told at once."""
    unread = mission("mission-two", trip("trip-two", target=None))
    plan = drawn(mission("mission-one", FAR), unread, fleet=WALLED)
    assert told(plan) == 1
    asyncio.run(plan.examined())
    assert told(plan) == 2


def test_what_has_changed_is_asked_again() -> None:
    """By itself, and not because others have changed."""
    plan = drawn(mission("mission-one", FAR), mission("mission-two"), fleet=WALLED)
    assert [one[0] for one in said(plan)] == ["mission-one"]
    near = mission("mission-one", trip(target=[2, 1]))
    plan.replace(plan.revision, [near, mission("mission-two", trip("trip-two", target=[13, 1]))])
    assert told(plan) == 0
    assert [one[0] for one in said(plan)] == ["mission-two"]
    plan.replace(plan.revision, [mission("mission-one", FAR)])
    assert [one[0] for one in said(plan)] == ["mission-one"]


def test_start_does_not_wait() -> None:
    """What is not known then is found out then."""
    plan = drawn(mission("mission-one", FAR), fleet=WALLED)
    with pytest.raises(BadInput, match="finds no permitted way"):
        plan.launchable()
    assert told(plan) == 1


def test_drawing_meanwhile_is_waited_for() -> None:
    """The answer is about the newest plan."""

    async def both(plan: MissionPlan) -> None:
        asking = asyncio.ensure_future(plan.examined())
        await asyncio.sleep(0)
        plan.replace(plan.revision, [mission("mission-two", FAR)])
        await asking

    plan = drawn(mission("mission-one", FAR), fleet=WALLED)
    asyncio.run(both(plan))
    assert told(plan) == 1


def test_the_thousandth_problem_is_left_out() -> None:
    """So no page is sent more."""
    plan = a_plan()
    trips = [trip(f"trip-{i:05}", target=None) for i in range(MOST_SHOWN + 1)]
    plan.replace(plan.revision, [mission("mission-one", *trips)])
    assert len(said(plan)) == MOST_SHOWN
