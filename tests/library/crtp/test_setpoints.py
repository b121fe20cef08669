"""Low-level setpoints come before the high-level commander: since the first, until they are released."""

from __future__ import annotations

import struct

import pytest

from pluto_fleet.crtp.packets import Port
from tests.library.crtp.bench import Bench, hovering

LOCKED, ACTIVE, PLANNER_OFF = 6, 8, 10
NO_THRUST = (Port.SETPOINT, 0, bytes(14))
STOP = (Port.GENERIC_SETPOINT, 0, b"\0")
HOVER = (Port.GENERIC_SETPOINT, 0, struct.pack("<Bffff", 10, 0.0, 0.0, 0.0, 0.4))
POSITION = (Port.GENERIC_SETPOINT, 0, struct.pack("<Bffff", 7, 2.0, 2.0, 0.4, 0.0))
RELEASE = (Port.GENERIC_SETPOINT, 1, struct.pack("<BI", 0, 0))

Packet = tuple[int, int, bytes]


@pytest.mark.parametrize("setpoint", [NO_THRUST, STOP, HOVER, POSITION])
def test_after_any_setpoint_since_its_start_commands_are_answered_and_ignored(
    setpoint: Packet,
) -> None:
    bench = Bench()
    bench.told(*setpoint)
    bench.passes(60.0)
    assert bench.arm() and bench.takeoff() == 0
    bench.passes(5.0)
    assert bench.z == 0.0


@pytest.mark.parametrize("setpoint", [NO_THRUST, STOP, HOVER, POSITION])
def test_once_setpoints_are_released_commands_are_flown_again(setpoint: Packet) -> None:
    bench = Bench()
    bench.told(*setpoint)
    assert bench.has(PLANNER_OFF)
    bench.passes(3.0)
    bench.told(*RELEASE)
    assert bench.arm() and bench.takeoff() == 0
    assert not bench.has(PLANNER_OFF)
    bench.passes(6.0)
    assert bench.z == pytest.approx(1.0, abs=0.05)


def test_a_drone_in_the_air_locks_two_seconds_after_a_stranger_s_last_setpoint() -> None:
    bench = hovering()
    bench.let("setpoint", 1.0)
    assert bench.go_to(3.0, 2.0, 1.0, 5.0) == 0
    bench.passes(1.9)
    assert bench.z > 0.9 and not bench.has(LOCKED)
    assert bench.x == pytest.approx(1.0, abs=0.05)
    bench.passes(2.0)
    assert bench.has(LOCKED) and bench.z == 0.0
