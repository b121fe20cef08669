"""A simulated ArduPilot copter: its modes, its commands and its failsafes.

Each behaviour names the source of ArduPilot that it follows; parameters have the values with which it comes.
"""

from __future__ import annotations

from math import hypot, inf, isfinite
from typing import ClassVar

from pymavlink.dialects.v20 import common as mavlink

from .body import Limits, Metres, root
from .equipment import Around, Gripper
from .vehicle import (
    ACCEPTED,
    DEEP,
    DENIED,
    FAILED,
    FORCED,
    Asked,
    Build,
    Doing,
    Parameter,
    Vehicle,
    leaning,
)

STABILIZE = 0
GUIDED = 4
LOITER = 5
RTL = 6
LAND = 9
BRAKE = 17
"""ArduCopter/mode.h."""
_HOLDS = {STABILIZE: Doing.HOLD, GUIDED: Doing.GO, LOITER: Doing.HOLD, BRAKE: Doing.HOLD}
_SERVO_MOVES = 0.5
"""Seconds: SERVO_ACTUATION_TIME of libraries/AP_Gripper/AP_Gripper_Servo.cpp."""
_BY_NUMBER = {**_HOLDS, RTL: Doing.RETURN, LAND: Doing.LAND}


def _approach(metres: float, acceleration: float, jerk: float) -> float:
    """Return how fast it may be so far from its goal: libraries/AP_Math/control.cpp, shape_pos_vel_accel (4.5)."""
    return root(metres, 0.5 * jerk / acceleration, 0.5 * acceleration)


def _parameters() -> dict[str, Parameter]:
    return {
        "WPNAV_SPEED": Parameter(1000.0),
        "WPNAV_SPEED_UP": Parameter(250.0),
        "WPNAV_SPEED_DN": Parameter(150.0),
        "WPNAV_ACCEL": Parameter(250.0),
        "WPNAV_ACCEL_Z": Parameter(100.0),
        "PSC_JERK_XY": Parameter(5.0),
        "ANGLE_MAX": Parameter(3000.0, whole=True),
        "LAND_SPEED": Parameter(50.0, whole=True),
        "LAND_ALT_LOW": Parameter(1000.0, whole=True),
        "RTL_ALT": Parameter(1500.0, whole=True),
        "FS_GCS_ENABLE": Parameter(0.0, whole=True),
        "FS_GCS_TIMEOUT": Parameter(5.0),
        "SYSID_MYGCS": Parameter(255.0, whole=True),
        "BATT_FS_LOW_ACT": Parameter(0.0, whole=True),
        "BATT_LOW_VOLT": Parameter(10.5),
        "BATT_LOW_TIMER": Parameter(10.0, whole=True),
        "FENCE_ENABLE": Parameter(0.0, whole=True),
        "FENCE_TYPE": Parameter(7.0, whole=True),
        "FENCE_ACTION": Parameter(1.0, whole=True),
        "FENCE_ALT_MAX": Parameter(100.0),
        "FENCE_RADIUS": Parameter(300.0),
        "DISARM_DELAY": Parameter(10.0, whole=True),
        "GRIP_ENABLE": Parameter(0.0, whole=True),
        "GRIP_TYPE": Parameter(0.0, whole=True),
    }


class ArduPilot(Vehicle):
    MAKE = mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA
    MODES: ClassVar = {
        Doing.HOLD: STABILIZE,
        Doing.TAKE_OFF: GUIDED,
        Doing.GO: GUIDED,
        Doing.RETURN: RTL,
        Doing.LAND: LAND,
        Doing.SINK: LOITER,
    }
    disarms_after = 1.0

    def __init__(self, build: Build, around: Around | None = None) -> None:
        parameters = _parameters()
        for name in ("GRIP_ENABLE", "GRIP_TYPE"):
            parameters[name].value = float(build.grips)
        limits = Limits(
            level=parameters["WPNAV_SPEED"].value / 100,
            up=parameters["WPNAV_SPEED_UP"].value / 100,
            down=parameters["WPNAV_SPEED_DN"].value / 100,
            level_acceleration=parameters["WPNAV_ACCEL"].value / 100,
            up_acceleration=parameters["WPNAV_ACCEL_Z"].value / 100,
            down_acceleration=parameters["WPNAV_ACCEL_Z"].value / 100,
            # not WPNAV_JERK: mode_guided.cpp, pos_control_run, unless GUID_OPTIONS says otherwise
            jerk=parameters["PSC_JERK_XY"].value,
            approach=_approach,
            gain=lambda acceleration, jerk: jerk / acceleration,
            airspeed=leaning(parameters["ANGLE_MAX"].value / 100),
        )
        gripper = Gripper(closed=None, moves_for=_SERVO_MOVES)
        super().__init__(build, limits, parameters, gripper, around)
        self.mode = STABILIZE
        self._speed = limits.level
        self._lost = False
        self._low_since: float | None = None

    @property
    def mode_number(self) -> int:
        return self.mode

    # ArduCopter/GCS_MAVLink_Copter.cpp

    def arm_or_disarm(self, asked: Asked) -> int:
        arms, forced, *_ = asked.values
        if arms == 1.0:
            if self.armed:
                return ACCEPTED
            if self.problem or self.mode in (RTL, LAND, BRAKE):  # their allows_arming is false
                why = self.problem or "Mode not armable"
                self.tell(mavlink.MAV_SEVERITY_CRITICAL, f"Arm: {why}")
                return FAILED
            self.arm()
            return ACCEPTED
        if self.flies and forced != FORCED:
            return FAILED
        self.disarm()
        return ACCEPTED

    def take_off(self, asked: Asked) -> int:
        """Rise in GUIDED to a height above home: handle_MAV_CMD_NAV_TAKEOFF, and do_user_takeoff of takeoff.cpp."""
        if asked.exact and asked.frame != mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT:
            return DENIED
        if not self.armed or self.high or self.mode != GUIDED or not isfinite(asked.height):
            return FAILED
        if asked.height <= self.body.at[2]:
            return FAILED
        self.doing = Doing.TAKE_OFF
        self.body.goal = (self.body.at[0], self.body.at[1], asked.height)
        return ACCEPTED

    def go_to(self, asked: Asked) -> int:
        """Fly to a place in GUIDED, at the speed of before: handle_command_int_do_reposition."""
        _, flags, *_ = asked.values
        changes = int(flags) & mavlink.MAV_DO_REPOSITION_FLAGS_CHANGE_MODE
        if not asked.exact or (self.mode != GUIDED and not changes):
            return DENIED
        if self._is_beyond(self.goal_of(asked)):
            return FAILED
        if not self.flies:  # its guided target is set, and nothing moves before a take-off
            return ACCEPTED
        self.mode = GUIDED
        self.doing = Doing.GO
        self.body.goal = self.goal_of(asked)
        return ACCEPTED

    def set_mode(self, asked: Asked) -> int:
        number = int(asked.values[1])
        doing = _BY_NUMBER.get(number)
        if doing is None or (self.faults.blind and number not in (STABILIZE, LAND)):
            return FAILED
        self.mode = number
        self.doing = doing
        self.stop_here()
        return ACCEPTED

    def change_speed(self, asked: Asked) -> int:
        kind, speed, *_ = asked.values
        if speed <= 0:
            return DENIED
        if kind in (0.0, 1.0):
            self._speed = speed
        return ACCEPTED

    def terminate(self, asked: Asked) -> int:
        if asked.values[0] <= 0.5:
            return FAILED
        self.disarm()
        return ACCEPTED

    def grip(self, asked: Asked) -> int:
        """Move the servo: MAV_CMD_DO_GRIPPER, and libraries/AP_Gripper/AP_Gripper_Servo.cpp.

        That is accepted at once, also if no kind of gripper is set, and nothing is told of when it has moved.
        """
        action = asked.values[1]
        if (
            not self.value("GRIP_ENABLE")
            or self.faults.slack
            or not isfinite(action)
            or int(action) not in (0, 1)
        ):
            return FAILED
        closes = int(action) == mavlink.GRIPPER_ACTION_GRAB
        gripper = self.gripper
        moves = gripper.wanted is not closes and gripper.closed is not closes
        if self.value("GRIP_TYPE") and moves:
            gripper.move(closes, self.now)
            does = "grabbing" if closes else "releasing"
            self.tell(mavlink.MAV_SEVERITY_INFO, f"Gripper load {does}")
        return ACCEPTED

    def switch(self, doing: Doing) -> int:
        if self.faults.blind and doing is not Doing.LAND:
            return FAILED
        self.doing = doing
        self.mode = self.MODES[doing]
        self.stop_here()
        return ACCEPTED

    # ArduCopter/events.cpp

    def watch(self) -> None:
        self.disarm_if_idle(self.value("DISARM_DELAY"))
        if self.faults.blind:
            self.fail_safe(Doing.LAND, "EKF Failsafe: changed to LAND Mode")
        self._watch_fence()
        self._watch_battery()
        silent = self.now - self.heard
        act = {1: Doing.RETURN, 5: Doing.LAND}.get(int(self.value("FS_GCS_ENABLE")))
        # without a station that it ever heard there is nothing to lose
        was_lost = self._lost
        self._lost = self.value("FS_GCS_TIMEOUT") < silent < 1e6
        if act is not None and self._lost and not was_lost:
            self.fail_safe(act, "GCS Failsafe")

    def _watch_battery(self) -> None:
        """Act once its voltage has been low for a while: libraries/AP_BattMonitor/AP_BattMonitor_Backend.cpp."""
        act = {1: Doing.LAND, 2: Doing.RETURN}.get(int(self.value("BATT_FS_LOW_ACT")))
        if self.volts >= self.value("BATT_LOW_VOLT") and self._low_since != inf:
            self._low_since = None
        elif self._low_since is None:
            self._low_since = self.now
        elif act is not None and self.now - self._low_since > self.value("BATT_LOW_TIMER"):
            self._low_since = inf  # it acts once, until it is restarted
            self.fail_safe(act, "Battery Failsafe")

    # libraries/AC_Fence/AC_Fence.cpp, ArduCopter/fence.cpp

    def _is_beyond(self, place: Metres) -> bool:
        """Return whether a place is outside of its fences, as far as they are on."""
        kinds = int(self.value("FENCE_TYPE")) if self.value("FENCE_ENABLE") else 0
        x, y, z = place
        return (
            (bool(kinds & 1) and z >= self.value("FENCE_ALT_MAX"))
            or (bool(kinds & 2) and hypot(x, y) >= self.value("FENCE_RADIUS"))
            or (bool(kinds & 4) and self.is_beyond(place, inf))
        )

    def _watch_fence(self) -> None:
        acts = {1: Doing.RETURN, 2: Doing.LAND}
        act = acts.get(int(self.value("FENCE_ACTION")))
        leaves = self.leaves(self._is_beyond(self.here))
        if act is not None and leaves:
            self.fail_safe(act, "Fence Breached")

    # What it flies

    def steer(self) -> None:
        body = self.body
        z = body.at[2]
        body.limits.level = self._speed
        body.limits.down = self.value("WPNAV_SPEED_DN") / 100
        if self.doing is Doing.TAKE_OFF and abs(z - body.goal[2]) < 0.1 and body.speed < 0.2:
            self.doing = Doing.GO
        elif self.doing in (Doing.LAND, Doing.SINK):
            # ArduCopter/mode.cpp, land_run_vertical_control, with the usual PSC_POSZ_P
            above = max(0.0, z - self.value("LAND_ALT_LOW") / 100)
            slows = root(above, 1.0, body.limits.down_acceleration)
            body.limits.down = min(body.limits.down, max(self.value("LAND_SPEED") / 100, slows))
            body.goal = (*body.goal[:2], DEEP)
        elif self.doing is Doing.RETURN:
            # ArduCopter/mode_rtl.cpp, with the usual WPNAV_RADIUS
            body.goal = self.homewards(self.value("RTL_ALT") / 100, 2.0)

    def landed_mode(self) -> None:
        """Keep the mode: it must be changed before it is armed again."""
        if self.doing is not Doing.LAND and self.doing is not Doing.RETURN:
            self.doing = Doing.HOLD
