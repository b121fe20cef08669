"""How fast simulated Crazyflies are let fly, and that they are at rest where they have arrived."""

from __future__ import annotations

from math import dist, hypot

import pytest

from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.drones.errors import NotReady
from tests.library.crazyflie.hangar import Hangar, drone


@drone(speed=2.0)
async def test_one_that_is_to_fly_faster_than_its_controller_follows_is_not_ready(
    one: Hangar, cf: Crazyflie
) -> None:
    across, aside = await cf.preflight()
    assert across == (
        "it is to fly at up to 2 m/s, and its firmware follows no course faster than 1 m/s"
        " (posCtlPid.xVelMax): give its category a lower speed, or set that parameter"
    )
    assert "posCtlPid.yVelMax" in aside
    with pytest.raises(NotReady, match="follows no course faster than 1 m/s"):
        await cf.takeoff(0.5, 0.5)
    assert not one.did("arm")


@drone(speed=0.8)
async def test_one_that_is_still_telling_its_parameters_is_waited_for(one: Hangar) -> None:
    """Over a busy radio they take longer than it takes to be sure where it is."""
    cf = one.navigation
    await one.let("latency", 0.03)
    await cf.connect()
    one.drone.parameters.put("posCtlPid.yVelMax", 0.5)
    (reason,) = await cf.preflight()
    assert "than 0.5 m/s (posCtlPid.yVelMax)" in reason


async def test_a_course_is_as_slow_as_its_controller_though_more_is_asked_for(
    one: Hangar, cf: Crazyflie
) -> None:
    """A drone that is met in the air must come home, however fast its category is."""
    await cf.takeoff(0.5, 3.0)
    await cf.go_to((5.0, 2.0, 0.5), 3.0)
    assert dist(one.position, (5.0, 2.0, 0.5)) < 0.12
    assert hypot(*one.drone.body.velocity) < 0.25
    await cf.land(3.0)
    went = one.did("go_to")[0].values
    assert went["duration"] >= 2.18 * 4.0
    assert not one.drone.supervisor.crashed
