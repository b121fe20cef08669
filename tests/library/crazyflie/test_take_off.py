"""Take-offs of simulated Crazyflies that have landed, that were disarmed, and that others have steered."""

from __future__ import annotations

import asyncio

import pytest

from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.crtp.commander import Supervisor
from pluto_fleet.crtp.drone import Build
from pluto_fleet.crtp.packets import Port, unpacked
from pluto_fleet.drones.protocol import NotReady, Rejected
from tests.kit.unthreaded import passes, the_air
from tests.library.crazyflie.hangar import FAST, Hangar

ENDLESS = {"least_voltage": 0.0}
"""Options of one that flies on with an empty battery."""


@pytest.mark.parametrize(
    "one",
    [
        {"build": Build(id="cf1", home=(1.0, 2.0, 0.0), auto_arm=arms), "options": ENDLESS}
        for arms in (False, True)
    ],
    indirect=True,
    ids=["on request", "by itself"],
)
@pytest.mark.parametrize("every", [0.05, pytest.param(0.01, marks=pytest.mark.long)])
async def test_it_takes_off_however_long_ago_it_has_landed(
    every: float, one: Hangar, cf: Crazyflie
) -> None:
    """Some 3 s after a landing the firmware disarms by itself: a take-off must outlive that at any moment."""
    pauses = [0.0, *(2.9 + every * number for number in range(round(0.3 / every) + 1)), 6.0]
    for pause in pauses:
        await passes(pause)
        await cf.takeoff(0.3, FAST)
        assert one.position[2] == pytest.approx(0.3, abs=0.15), pause
        await cf.land(0.5)
        assert not one.flies and not one.drone.supervisor.locked, pause


class OnRequest(Supervisor):
    """It says that it arms by itself, and once it was disarmed it waits to be asked."""

    def info(self, *, high_level: bool, finished: bool, planner_off: bool = False) -> int:
        bits = super().info(high_level=high_level, finished=finished, planner_off=planner_off)
        return bits | 1 << 2


async def test_one_that_says_that_it_arms_itself_and_does_not_is_asked_to(one: Hangar) -> None:
    one.drone.supervisor = OnRequest(armed=True)
    cf = await one.connected()
    await cf.takeoff(0.4, FAST)
    assert one.flies and len(one.did("arm")) == 1
    await cf.land(FAST)


class Slow(Supervisor):
    """It arms, and its motors are not ready to fly for long."""

    can_fly = False


async def test_one_that_is_slow_to_arm_is_not_left_armed(one: Hangar) -> None:
    one.drone.supervisor = Slow()
    cf = await one.connected()
    with pytest.raises(NotReady, match="will not arm"):
        await cf.takeoff(0.4, FAST)
    assert len(one.did("arm")) == 1
    assert not one.drone.supervisor.armed and not one.did("takeoff")


async def test_one_that_is_let_go_of_as_it_takes_off_is_landed_first(
    one: Hangar, cf: Crazyflie
) -> None:
    """What it tells in that moment is from before."""
    await one.let("latency", 0.1)
    rising = asyncio.create_task(cf.takeoff(0.4, FAST))
    while not one.did("takeoff"):
        await asyncio.sleep(0.002)
    rising.cancel()
    await cf.close()
    assert one.did("land") and not one.flies


async def test_one_that_is_down_is_not_told_to_land_again(one: Hangar, cf: Crazyflie) -> None:
    """The answers are lost: on the ground, the command would start its motors once more."""
    await cf.takeoff(0.3, FAST)
    the_air().loses = lambda raw: unpacked(raw).port == Port.HIGH_LEVEL
    await cf.land(FAST)
    told = [command.what for command in one.commands]
    assert told.count("land") > 2 and told[-1] == "down" and told.count("down") == 1


async def test_a_take_off_that_a_disarming_cancels_is_commanded_once_more(
    one: Hangar, cf: Crazyflie
) -> None:
    await asyncio.gather(cf.takeoff(0.5, FAST), _disarmed_once(one, 1))
    assert one.flies and len(one.did("takeoff")) == 2
    await cf.land(FAST)


async def test_twice_cancelled_it_is_a_refusal(one: Hangar, cf: Crazyflie) -> None:
    disarming = asyncio.create_task(_disarmed_once(one, 2))
    with pytest.raises(Rejected, match="accepted the take-off, and was disarmed at once"):
        await cf.takeoff(0.5, FAST)
    await disarming
    assert not one.flies and len(one.did("takeoff")) == 2


async def test_one_that_another_program_steers_while_it_is_armed_takes_off(
    one: Hangar, cf: Crazyflie
) -> None:
    """Arming takes its time, some seconds after a landing."""
    taking_off = asyncio.create_task(cf.takeoff(0.5, FAST))
    while not one.did("arm"):
        await asyncio.sleep(0.002)
    await one.let("setpoint")
    await taking_off
    assert one.position[2] > 0.4
    await cf.land(FAST)


async def _disarmed_once(one: Hangar, times: int) -> None:
    """Disarm it just when it has accepted a take-off, so many times."""
    for number in range(1, times + 1):
        while len(one.did("takeoff")) < number:
            await asyncio.sleep(0.01)
        one.drone.supervisor.armed = False
