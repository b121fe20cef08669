"""Simulated Crazyflies that need a person: crashed, with a deck that fails, with more cells than said."""

from __future__ import annotations

import pytest

from pluto_fleet.crazyflie.navigation import Crazyflie
from pluto_fleet.crtp.drone import Build
from pluto_fleet.drones.protocol import BATTERY_LOW, NotReady
from pluto_fleet.lithium import volts_at
from tests.kit.unthreaded import passes
from tests.library.crazyflie.hangar import FAST, Hangar, drone

TELLS = 0.3
"""Seconds in which a drone tells how it is more than once."""
FULL = volts_at(1.0)
TWO_CELLS = Build(id="cf1", home=(1.0, 2.0, 0.0), cells=2)
CRASHED = (
    "it has crashed: once it stands upright and is whole, bring it back, or switch it off and on"
)


async def test_one_that_crashed_and_stands_flies_again_once_a_person_says_so(
    one: Hangar, cf: Crazyflie
) -> None:
    await cf.takeoff(0.3, FAST)
    await one.let("tumble")
    await passes(2.0)  # until it has fallen, and told so
    with pytest.raises(NotReady, match="does not forget that it has crashed: set it upright"):
        await cf.looked_after()
    await one.let("upright")
    await passes(TELLS)
    assert await cf.preflight() == [CRASHED] and not one.did("recover")[1:]
    await cf.looked_after()
    assert await cf.preflight() == []
    await cf.takeoff(0.3, FAST)
    assert one.flies


async def test_a_deck_that_fails_is_said_by_name(one: Hangar, cf: Crazyflie) -> None:
    await one.let("deck")
    await passes(TELLS)
    reason = "one of its decks reports a fault: see that all sit well, and switch it off and on"
    assert await cf.preflight() == [reason]
    with pytest.raises(NotReady, match="one of its decks reports a fault"):
        await cf.takeoff(0.5, FAST)
    assert not one.did("arm")


@drone(build=TWO_CELLS)
async def test_one_with_more_cells_than_the_fleet_file_says_does_not_fly(
    one: Hangar, cf: Crazyflie
) -> None:
    (reason,) = await cf.preflight()
    assert reason == (
        f"its battery has {2 * FULL:.2f} V, more than one cell has: say in the fleet file how"
        " many it has, such as cells = 2"
    )
    with pytest.raises(NotReady, match="more than one cell has"):
        await cf.takeoff(0.5, FAST)


@drone(options={"cells": 2, "least_voltage": 3.0}, build=TWO_CELLS)
async def test_one_with_two_cells_is_as_full_as_each_of_them(one: Hangar, cf: Crazyflie) -> None:
    assert cf.telemetry.voltage == pytest.approx(2 * FULL, abs=0.01)
    await one.let("volts", 7.6)
    await passes(TELLS)
    assert 0.35 < cf.telemetry.battery_level < 0.45
    await cf.takeoff(0.5, FAST)
    await one.let("volts", 6.3)
    assert (await one.hears(BATTERY_LOW)).reason.startswith("its battery is down to 6.")
    await cf.land(FAST)
    assert [event.kind for event in one.events] == [BATTERY_LOW]
