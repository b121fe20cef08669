"""Following with a Crazyflie: its high-level commander is sent elsewhere again and again, while it flies."""

from __future__ import annotations

import asyncio

from ..drones.protocol import Rejected
from ..shared.domain.model import Point
from . import commander
from .course import course_to
from .flying import NEAR, hold, hovering, speed_limits_of
from .session import CrazyflieSession

AGAIN = 0.4
"""Seconds on a course to a place on the way, until it is led on."""


async def follow(
    session: CrazyflieSession, target: Point, speed: float, seconds: float = 0.0
) -> None:
    """Fly on to a place without a stop, to be there in so many seconds, and return when it hovers there.

    What is on its way by a trajectory that is not known stops first.
    """
    if not session.well().steered:
        raise Rejected(f"{session.drone} does not fly: it must take off first")
    if not session.is_under_way and not session.now().finished:
        await hold(session)
    session.commanded = True
    limits = speed_limits_of(session).limits
    while True:
        course = course_to(session.setpoint, target, limits, speed, seconds)
        await commander.go_to(session, course.end, course.seconds, NEAR)
        if course.end == target:
            break
        await asyncio.sleep(AGAIN)
    await hovering(session, lambda state: state.distance(target), course.seconds, "arrived")
