"""A Crazyflie follows what moves, by its high-level commander: near it, without a stop, never too fast."""

from __future__ import annotations

import asyncio
from math import dist, hypot

import pytest

from pluto_fleet.crazyflie.course import Course, Setpoint, course_to
from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.crazyflie.session import CrazyflieSession
from pluto_fleet.drones.protocol import Rejected
from pluto_fleet.shared.domain.model import Point
from tests.library.crazyflie.hangar import FAST, Hangar

LIMITS = (1.0, 1.0, 1.0)
AGAIN = 0.5
"""Seconds until it is sent on."""


def walker(seconds: float) -> Point:
    """Return where somebody is who walks around a square, at 0.3 m/s."""
    side, way = divmod(0.3 * seconds % 8.0, 2.0)
    x, y = [(way, 0.0), (2.0, way), (2.0 - way, 2.0), (0.0, 2.0 - way)][int(side)]
    return 1.0 + x, 2.0 + y, 0.5


async def test_it_stays_near_somebody_who_walks_around_corners(one: Hangar, up: Crazyflie) -> None:
    loop = asyncio.get_running_loop()
    began = loop.time()
    going: asyncio.Task[None] | None = None
    far = list[float]()
    ways = list[float]()
    here = one.position
    while (passed := loop.time() - began) < 40.0:
        if going is not None:
            going.cancel()
            await asyncio.wait([going])
        before = walker(max(0.0, passed - AGAIN))
        now = walker(passed)
        x, y, z = (a + (a - b) / AGAIN for a, b in zip(now, before, strict=True))
        going = asyncio.create_task(up.follow((x, y, z), FAST, 1.0))
        await asyncio.sleep(AGAIN)
        if passed > 4.0:
            far.append(dist(one.position, walker(loop.time() - began)))
            ways.append(dist(here, one.position))
        here = one.position
    assert going is not None
    going.cancel()
    await up.hold()
    far.sort()
    assert far[len(far) // 2] < 0.2
    assert far[int(0.95 * len(far))] < 0.5
    assert min(ways) > 0.3 * 0.3 * AGAIN  # it never stopped
    assert max(ways) < FAST * AGAIN
    assert one.did("go_to")[-1].flying


async def test_it_is_not_sent_on_from_the_ground(cf: Crazyflie) -> None:
    with pytest.raises(Rejected, match="it must take off first"):
        await cf.follow((2.0, 2.0, 0.5), FAST, 1.0)


async def test_one_that_flies_by_a_course_that_is_not_known_stops_first(
    one: Hangar, up: Crazyflie
) -> None:
    """As after a link that was lost while it flew."""
    going = asyncio.create_task(up.go_to((4.0, 2.0, 0.5), FAST))
    await asyncio.sleep(1.5)
    going.cancel()
    session = up._session
    assert isinstance(session, CrazyflieSession)
    session.sets_out(None)
    commands = len(one.did("go_to"))
    await up.follow((1.0, 3.0, 0.5), FAST, 0.0)
    first, *_ = one.did("go_to")[commands:]
    assert first.values["duration"] == pytest.approx(1.0, abs=0.2)  # it brakes
    assert dist(one.position, (1.0, 3.0, 0.5)) < 0.1


@pytest.mark.parametrize("speed", [0.3, 0.6, 1.0])
@pytest.mark.parametrize(
    "target", [(5.0, 0.0, 1.0), (0.3, 0.0, 1.0), (-2.0, 0.0, 1.0), (0.5, 1.5, 1.4)]
)
def test_no_course_is_faster_than_its_limits_however_it_moves_before(
    speed: float, target: Point
) -> None:
    here = Setpoint((0.0, 0.0, 1.0), (speed, 0.0, 0.0))
    course = course_to(here, target, LIMITS, 1.0, 0.5)
    for part in range(101):
        _, velocity, _ = course.at(course.seconds * part / 100)
        assert hypot(*velocity) < 1.1


def test_a_course_from_rest_is_the_planner_s() -> None:
    """Half-way it is at the middle, as fast as 35/16 of its mean."""
    course = Course(Setpoint((0.0, 0.0, 1.0)), (2.0, 0.0, 1.0), 4.0)
    position, velocity, _ = course.at(2.0)
    assert position == pytest.approx((1.0, 0.0, 1.0))
    assert velocity[0] == pytest.approx(0.5 * 35 / 16)
    assert course.at(9.0) == Setpoint((2.0, 0.0, 1.0))
