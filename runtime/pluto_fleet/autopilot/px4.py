"""A simulated PX4 multicopter: its modes, its commands and its failsafes.

Each behaviour names the source of PX4 that it follows; parameters have the values with which PX4 comes.
"""

from __future__ import annotations

from math import inf, isfinite, sqrt
from typing import ClassVar

from pymavlink.dialects.v20 import common as mavlink

from .body import Limits
from .equipment import Around, Gripper
from .vehicle import (
    ACCEPTED,
    BUSY,
    CANCELLED,
    DEEP,
    DENIED,
    FAILED,
    FORCED,
    IN_PROGRESS,
    UNSUPPORTED,
    Asked,
    Build,
    Doing,
    Parameter,
    Vehicle,
    leaning,
)

_POSITION = 3
_AUTO = 4
_SUB_MODES = {Doing.TAKE_OFF: 2, Doing.HOLD: 3, Doing.GO: 3, Doing.RETURN: 5, Doing.LAND: 6}
"""commander/px4_custom_mode.h."""
_UNBREAKABLE = 121212.0
"""The value by which CBRK_FLIGHTTERM keeps termination from being done."""
_QUICK = 10.0
"""Per second: VelocitySmoothing changes a velocity in the least time, but for what a step of time cannot resolve."""


def _approach(metres: float, acceleration: float, jerk: float) -> float:
    """Return how fast it may be so far from its goal: mathlib/math/TrajMath.hpp, computeMaxSpeedFromDistance."""
    late = (
        2 * acceleration**2 / jerk
    )  # it counts with twice the time that an acceleration takes to come
    return sqrt(late * late + 2 * acceleration * metres) - late


def _parameters() -> dict[str, Parameter]:
    return {
        "MIS_TAKEOFF_ALT": Parameter(2.5),
        "MPC_XY_CRUISE": Parameter(5.0),
        "MPC_XY_VEL_MAX": Parameter(12.0),
        "MPC_ACC_HOR": Parameter(3.0),
        "MPC_ACC_UP_MAX": Parameter(4.0),
        "MPC_ACC_DOWN_MAX": Parameter(3.0),
        "MPC_JERK_AUTO": Parameter(4.0),
        "MPC_Z_V_AUTO_UP": Parameter(3.0),
        "MPC_Z_V_AUTO_DN": Parameter(1.5),
        "MPC_TKO_SPEED": Parameter(1.5),
        "MPC_TKO_RAMP_T": Parameter(3.0),
        "MPC_LAND_SPEED": Parameter(0.7),
        "MPC_LAND_ALT1": Parameter(10.0),
        "MPC_LAND_ALT2": Parameter(5.0),
        "MPC_TILTMAX_AIR": Parameter(45.0),
        "COM_DISARM_LAND": Parameter(2.0),
        "COM_DISARM_PRFLT": Parameter(10.0),
        "COM_DL_LOSS_T": Parameter(10.0, whole=True),
        "COM_FAIL_ACT_T": Parameter(5.0),
        "NAV_DLL_ACT": Parameter(0.0, whole=True),
        "COM_LOW_BAT_ACT": Parameter(0.0, whole=True),
        "BAT_CRIT_THR": Parameter(0.07),
        "BAT_EMERGEN_THR": Parameter(0.05),
        "RTL_RETURN_ALT": Parameter(60.0),
        "RTL_DESCEND_ALT": Parameter(30.0),
        "GF_ACTION": Parameter(2.0, whole=True),
        "GF_MAX_VER_DIST": Parameter(0.0),
        "CBRK_FLIGHTTERM": Parameter(_UNBREAKABLE, whole=True),
        "PD_GRIPPER_TYPE": Parameter(0.0, whole=True),
        "PD_GRIPPER_TO": Parameter(1.0),
    }


class Px4(Vehicle):
    MAKE = mavlink.MAV_AUTOPILOT_PX4
    MODES: ClassVar = {
        Doing.SINK: _POSITION << 16,
        **{doing: _AUTO << 16 | sub << 24 for doing, sub in _SUB_MODES.items()},
    }

    def __init__(self, build: Build, around: Around | None = None) -> None:
        parameters = _parameters()
        parameters["PD_GRIPPER_TYPE"].value = 0.0 if build.grips else -1.0
        limits = Limits(
            level=parameters["MPC_XY_CRUISE"].value,
            up=parameters["MPC_Z_V_AUTO_UP"].value,
            down=parameters["MPC_Z_V_AUTO_DN"].value,
            level_acceleration=parameters["MPC_ACC_HOR"].value,
            up_acceleration=parameters["MPC_ACC_UP_MAX"].value,
            down_acceleration=parameters["MPC_ACC_DOWN_MAX"].value,
            jerk=parameters["MPC_JERK_AUTO"].value,
            approach=_approach,
            gain=lambda acceleration, jerk: _QUICK,
            airspeed=leaning(parameters["MPC_TILTMAX_AIR"].value),
        )
        # it closes as it is switched on
        gripper = Gripper(closed=True, moves_for=parameters["PD_GRIPPER_TO"].value)
        super().__init__(build, limits, parameters, gripper, around)
        self.disarms_after = self.value("COM_DISARM_LAND")
        self._rises_to: float | None = None
        """The height above home of the take-off that is wanted."""

    # commander/Commander.cpp, handle_command

    def arm_or_disarm(self, asked: Asked) -> int:
        arms, forced, *_ = asked.values
        if arms == 1.0:
            if self.armed:
                return ACCEPTED
            if self.problem or self.doing in (Doing.LAND, Doing.RETURN):
                why = self.problem or "switch to another mode first"
                self.tell(mavlink.MAV_SEVERITY_CRITICAL, f"Arming denied: {why}")
                return BUSY
            self.arm()
            return ACCEPTED
        if self.flies and forced != FORCED:
            self.tell(mavlink.MAV_SEVERITY_CRITICAL, "Disarming denied: not landed")
            return BUSY
        self.disarm()
        return ACCEPTED

    def take_off(self, asked: Asked) -> int:
        """Take the mode, also without being armed: it rises once it is."""
        result = self.switch(Doing.TAKE_OFF)
        # navigator/takeoff.cpp: an altitude is above sea level; without one the parameter's, above where it is
        if isfinite(asked.height):
            self._rises_to = max(self.body.at[2], asked.height - self.build.home[2])
        else:
            self._rises_to = self.body.at[2] + self.value("MIS_TAKEOFF_ALT")
        return result

    def go_to(self, asked: Asked) -> int:
        """Take a new place to hold: navigator/navigator_main.cpp, VEHICLE_CMD_DO_REPOSITION."""
        speed, flags, *_ = asked.values
        if not asked.exact:
            return DENIED
        if self.is_beyond(self.goal_of(asked), self._highest):
            self.tell(mavlink.MAV_SEVERITY_CRITICAL, "Reposition is outside geofence")
            return DENIED
        if not int(flags) & mavlink.MAV_DO_REPOSITION_FLAGS_CHANGE_MODE:
            return UNSUPPORTED
        self.switch(Doing.GO)
        given = isfinite(speed) and speed > 0
        self.body.limits.level = min(
            speed if given else self.value("MPC_XY_CRUISE"), self.value("MPC_XY_VEL_MAX")
        )
        if self.flies:
            self.body.goal = self.goal_of(asked)
        return ACCEPTED

    def set_mode(self, asked: Asked) -> int:
        _, main, sub, _ = asked.values
        doing = {2: Doing.TAKE_OFF, 3: Doing.HOLD, 5: Doing.RETURN, 6: Doing.LAND}.get(int(sub))
        return DENIED if main != _AUTO or doing is None else self.switch(doing)

    def change_speed(self, asked: Asked) -> int:
        """Accept it, and fly the present leg as before: navigator/navigator_main.cpp keeps it for missions."""
        return ACCEPTED

    def terminate(self, asked: Asked) -> int:
        if self.value("CBRK_FLIGHTTERM") != _UNBREAKABLE and asked.values[0] > 0.5:
            self.disarm()
        return ACCEPTED

    # payload_deliverer/payload_deliverer.cpp, handle_vehicle_command

    def grip(self, asked: Asked) -> int:
        action = asked.values[1]
        gripper = self.gripper
        if self.value("PD_GRIPPER_TYPE") < 0 or self.faults.slack:
            return FAILED
        if not isfinite(action) or round(action) not in (0, 1):
            return DENIED
        closes = round(action) == mavlink.GRIPPER_ACTION_GRAB
        if gripper.wanted is closes:
            return BUSY
        if gripper.wanted is not None:
            self.done.append((asked.command, CANCELLED))
        elif gripper.closed is closes:
            return ACCEPTED
        gripper.moves_for = self.value("PD_GRIPPER_TO")
        gripper.move(closes, self.now)
        return IN_PROGRESS

    def gripped(self) -> None:
        self.done.append((mavlink.MAV_CMD_DO_GRIPPER, ACCEPTED))

    def switch(self, doing: Doing) -> int:
        if self.faults.blind and doing is not Doing.LAND:
            return BUSY
        self.doing = doing
        if doing not in (Doing.TAKE_OFF, Doing.GO):
            self.stop_here()
        return ACCEPTED

    def landed_mode(self) -> None:
        self.doing = Doing.HOLD

    # commander/failsafe/failsafe.cpp

    def watch(self) -> None:
        self.disarm_if_idle(self.value("COM_DISARM_PRFLT"))
        if self.faults.blind:
            self.fail_safe(Doing.LAND, "Failsafe activated: no position, it descends")
        elif self.doing is not Doing.LAND:
            self._watch_fence()
            self._watch_battery()
            self._watch_link()

    @property
    def _highest(self) -> float:
        return self.value("GF_MAX_VER_DIST") or inf

    def _watch_fence(self) -> None:
        acts = {2: Doing.HOLD, 3: Doing.RETURN, 5: Doing.LAND}
        act = acts.get(int(self.value("GF_ACTION")))
        leaves = self.leaves(self.is_beyond(self.here, self._highest))
        if act is not None and leaves:
            self.fail_safe(act, "Failsafe activated: geofence breached")

    def _watch_battery(self) -> None:
        act = self.value("COM_LOW_BAT_ACT")
        left = self.charge
        if act > 1 and left < self.value("BAT_EMERGEN_THR"):
            self.fail_safe(Doing.LAND, "Failsafe activated: emergency battery")
        elif act > 1 and left < self.value("BAT_CRIT_THR"):
            doing = Doing.LAND if act == 2 else Doing.RETURN
            self.fail_safe(doing, "Failsafe activated: critical battery")

    def _watch_link(self) -> None:
        """Hold for COM_FAIL_ACT_T once the ground station is silent, then act."""
        act = {1: Doing.HOLD, 2: Doing.RETURN, 3: Doing.LAND}.get(int(self.value("NAV_DLL_ACT")))
        silent = self.now - self.heard - self.value("COM_DL_LOSS_T")
        if act is None or not 0 < silent < 1e6 or self.doing is act:
            return
        why = "Failsafe activated: no connection to the ground station"
        self.fail_safe(act if silent > self.value("COM_FAIL_ACT_T") else Doing.HOLD, why)

    # What it flies

    def steer(self) -> None:
        """Set its limits: flight_mode_manager/tasks/Auto/FlightTaskAuto.cpp, _updateTrajConstraints."""
        body = self.body
        z = body.at[2]
        limits = body.limits
        limits.up = self.value("MPC_Z_V_AUTO_UP")
        limits.up_acceleration = self.value("MPC_ACC_UP_MAX")
        limits.down = self.value("MPC_Z_V_AUTO_DN")
        if self.doing is Doing.TAKE_OFF and self._rises_to is not None:
            if z < self.value("MPC_LAND_ALT1"):
                limits.up = self.value("MPC_TKO_SPEED")
                limits.up_acceleration = limits.up / self.value("MPC_TKO_RAMP_T")
            body.goal = (body.goal[0], body.goal[1], self._rises_to)
            if abs(z - self._rises_to) < 0.1 and body.speed < 0.2:
                self.doing = Doing.HOLD  # as the mode is completed
        elif self.doing in (Doing.LAND, Doing.SINK):
            limits.down = self._sinks(z)
            body.goal = (body.goal[0], body.goal[1], DEEP)
        elif self.doing is Doing.RETURN:
            limits.level = self.value("MPC_XY_CRUISE")
            body.goal = self.homewards(self.value("RTL_RETURN_ALT"), 0.5)  # navigator/rtl.cpp

    def _sinks(self, height: float) -> float:
        """Return how fast it lands: FlightTaskAuto.cpp, _prepareLandSetpoints, evenly slower between two heights."""
        slow = self.value("MPC_LAND_SPEED")
        fast = self.value("MPC_Z_V_AUTO_DN")
        low = self.value("MPC_LAND_ALT2")
        share = (height - low) / (self.value("MPC_LAND_ALT1") - low)
        return slow + (fast - slow) * min(1.0, max(0.0, share))
