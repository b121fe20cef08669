"""The firmware's rules: what a simulated Crazyflie does, and what it does not."""

from __future__ import annotations

import struct
from dataclasses import replace
from math import inf

import pytest

from pluto_fleet.crtp.battery import CHARGE
from pluto_fleet.crtp.packets import Port
from pluto_fleet.crtp.server import collide
from tests.library.crtp.bench import CF1, Bench, hovering

ARMED, CAN_FLY, FLYING, TUMBLED, LOCKED, CRASHED, ACTIVE, DONE = 1, 3, 4, 5, 6, 7, 8, 9
PLANNER_OFF = 10
BUSY, WRONG_STATE = 16, 1
ZERO_SETPOINT = bytes(14)


def test_it_takes_off_only_when_armed_and_answers_busy_before() -> None:
    bench = Bench()
    assert bench.takeoff() == BUSY
    assert bench.arm()
    assert bench.takeoff() == 0
    bench.passes(12.0)
    assert bench.z == pytest.approx(1.0, abs=0.03)
    assert bench.has(FLYING) and bench.has(ACTIVE) and bench.has(DONE)


def test_arming_is_over_three_seconds_after_it_has_landed() -> None:
    bench = hovering()
    bench.passes(12.0)
    assert bench.land() == 0
    bench.passes(2.2)
    assert bench.z == 0.0 and not bench.has(ACTIVE) and bench.has(FLYING)
    bench.passes(1.9)
    assert bench.drone.info() == 0x20A
    bench.passes(2.8)
    assert bench.drone.info() == 0x20A
    bench.passes(0.15)
    assert bench.drone.info() == 0x200
    assert bench.takeoff() == BUSY and not bench.arm()
    bench.passes(0.1)
    assert bench.drone.info() == 0x201
    assert bench.takeoff() == BUSY and bench.land() == BUSY
    assert bench.arm() and bench.takeoff() == 0


def test_to_land_on_the_ground_is_answered_as_done_and_starts_the_motors() -> None:
    bench = Bench()
    bench.arm()
    assert bench.land() == 0
    bench.passes(1.0)
    assert bench.has(FLYING) and bench.z == 0.0
    bench.passes(1.1)
    assert not bench.has(ACTIVE) and bench.z == 0.0


def test_a_zero_setpoint_in_the_air_drops_and_locks_it() -> None:
    bench = hovering()
    bench.told(Port.SETPOINT, 0, ZERO_SETPOINT)
    bench.passes(3.0)
    assert bench.z == 0.0 and bench.has(LOCKED) and not bench.has(CAN_FLY)
    assert any(command.what == "setpoint" and command.flying for command in bench.commands)
    assert not bench.arm()


@pytest.mark.parametrize(("seconds", "locks"), [(0.5, True), (1.2, True), (3.0, False)])
def test_a_link_that_closes_soon_after_landing_locks_it(seconds: float, locks: bool) -> None:
    bench = hovering()
    bench.lands()
    bench.passes(seconds)
    bench.told(Port.SETPOINT, 0, ZERO_SETPOINT)
    bench.passes(4.0)
    assert bench.has(LOCKED) is locks


def test_an_emergency_stop_locks_it_until_it_is_restarted() -> None:
    bench = hovering()
    assert bench.told(Port.SUPERVISOR, 1, b"\3") is None
    bench.passes(2.0)
    assert bench.z == 0.0 and bench.has(LOCKED)
    bench.let("fetch")
    bench.passes(1.5)
    assert not bench.has(LOCKED) and bench.arm()


def test_two_that_touch_in_the_air_tumble_and_one_that_stands_there_does_not() -> None:
    one, other, standing = Bench(), Bench(), Bench()
    for bench in (one, other):
        bench.up()
        collide([bench.drone, standing.drone])
    one.go_to(1.0, 3.0, 1.0, 4.0)
    one.passes(4.1)
    collide([one.drone, other.drone])
    assert one.drone.body.motors
    one.go_to(1.0, 2.05, 1.0, 4.0)
    one.passes(4.1)
    collide([one.drone, other.drone])
    for bench in (one, other):
        bench.passes(2.0)
        assert bench.has(TUMBLED) and bench.z == 0.0
    assert not standing.has(TUMBLED)


def test_what_no_such_drone_can_follow_tumbles_it() -> None:
    bench = hovering()
    bench.go_to(4.0, 2.0, 1.0, 0.5)
    bench.passes(2.0)
    assert bench.has(TUMBLED) and bench.has(CRASHED) and bench.z == 0.0


def test_a_tumbled_one_flies_again_once_it_stands_upright_and_has_recovered() -> None:
    bench = hovering()
    bench.let("tumble")
    bench.passes(2.0)
    assert bench.told(Port.SUPERVISOR, 1, b"\2") == b"\x82\0\0"
    bench.let("upright")
    bench.passes(0.1)
    assert bench.has(CRASHED) and not bench.has(TUMBLED) and not bench.arm()
    assert bench.told(Port.SUPERVISOR, 1, b"\2") == b"\x82\1\1"
    assert bench.arm() and bench.takeoff() == 0


def test_a_battery_sags_in_the_air_is_low_after_five_seconds_and_empty_some_time_later() -> None:
    bench = Bench()
    rest = bench.drone.carried.volts
    bench.up()
    assert rest - bench.drone.carried.volts == pytest.approx(0.3, abs=0.05)
    bench.let("volts", 3.19)
    bench.passes(4.0)
    assert bench.drone.carried.state == 0
    bench.passes(2.0)
    assert bench.drone.carried.state == 3
    bench.passes(60.0)
    assert not bench.drone.on and bench.z == 0.0
    assert bench.told(15, 0, b"hello") is None


# Low-level set-points come before the high-level commander: since the first, until they are released

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


def test_one_without_a_pad_does_not_charge_at_home() -> None:
    levels = {}
    for charge in CHARGE, inf:
        bench = Bench(replace(CF1, level=0.5, charge=charge))
        bench.passes(60.0)
        levels[charge] = bench.drone.carried.battery_level
    assert levels[CHARGE] > 0.5
    assert levels[inf] == 0.5
