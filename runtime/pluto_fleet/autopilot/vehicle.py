"""One simulated vehicle: what every autopilot has, whichever its make; `px4.py` and `ardupilot.py` have the rest.

Messages are written and read by pymavlink, commands are answered as MAVLink's documents say: an answer says
that a command was accepted, and never that it is done.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from enum import Enum
from math import atan2, hypot, inf, isfinite, radians, sqrt, tan
from typing import ClassVar

from pymavlink.dialects.v20 import common as mavlink

from ..geodesy import Degrees, LocalPlane
from ..shared.domain.airspace import inside
from ..wind import CALM, SPEED_AT_45, Wind, power
from .body import Body, Limits, Metres
from .equipment import Around, Gripper

AUTOPILOT = 1
CAMERA = mavlink.MAV_COMP_ID_CAMERA
COMPANION = mavlink.MAV_COMP_ID_ONBOARD_COMPUTER
"""The components of a vehicle."""

ACCEPTED: int = mavlink.MAV_RESULT_ACCEPTED
BUSY: int = mavlink.MAV_RESULT_TEMPORARILY_REJECTED
DENIED: int = mavlink.MAV_RESULT_DENIED
FAILED: int = mavlink.MAV_RESULT_FAILED
UNSUPPORTED: int = mavlink.MAV_RESULT_UNSUPPORTED
IN_PROGRESS: int = mavlink.MAV_RESULT_IN_PROGRESS
CANCELLED = 6
"""MAV_RESULT_CANCELLED, which pymavlink does not have."""

FORCED = 21196.0
"""The second parameter of a command to disarm that is meant even in the air."""
FULL_VOLTS = 16.8
EMPTY_VOLTS = 14.0
SENSORS = (
    mavlink.MAV_SYS_STATUS_SENSOR_3D_GYRO
    | mavlink.MAV_SYS_STATUS_SENSOR_3D_ACCEL
    | mavlink.MAV_SYS_STATUS_SENSOR_3D_MAG
)
READY = mavlink.MAV_SYS_STATUS_PREARM_CHECK
SATELLITES = mavlink.MAV_SYS_STATUS_SENSOR_GPS
ALL = SENSORS | SATELLITES | READY
DEEP = -20.0
"""Metres above the ground of the goal of a landing: it does not slow down for the ground."""
_NOTICED = 2.5
"""Seconds within which a station must have noticed that it acts by itself: a heartbeat comes every second."""
TOUCHED = 0.02
"""Metres above the ground at which it has touched down."""


class Doing(Enum):
    """What a vehicle is at; each make has a mode for it."""

    HOLD = "hold"
    TAKE_OFF = "take off"
    GO = "go"
    RETURN = "return"
    LAND = "land"
    SINK = "sink"
    """A pilot lands it by hand."""


@dataclass(slots=True)
class Faults:
    """What is wrong with a vehicle."""

    silent: bool = False
    """Nothing reaches it, and nothing is heard of it."""
    late: float = 0.0
    """Seconds by which it is heard of later."""
    unanswered: int = 0
    """How many of the next commands it carries out without an answer."""
    denied: int = 0
    """How many of the next commands it denies."""
    busy: int = 0
    """How many of the next commands it rejects for now."""
    blind: bool = False
    """It has no satellites."""
    dead: bool = False
    """A motor is dead."""
    blown: float = 0.0
    """Metres a second to the east by which the wind takes it along."""
    blank: bool = False
    """Its camera takes no picture."""
    slack: bool = False
    """Its gripper cannot be moved."""
    numb: bool = False
    """Its sensors tell nothing."""
    unready: str = ""
    """Why it will not arm."""
    lost_answer: int = 0
    """The command whose next answer is lost."""
    homeless: bool = False
    """It knows no home position."""
    raised: float = 0.0
    """Metres above the ground at which its home was set, until it is armed the next time."""
    astray: float = 0.0
    """Metres to the east by which it believes to be elsewhere."""
    ahead: float = 0.0
    """Seconds by which its clock is ahead."""
    gaugeless: bool = False
    """It does not tell how full its battery is."""
    sag: float = 0.0
    """By how much less than it has its battery tells."""
    eyeless: bool = False
    """Its camera does not answer."""
    unfenced: bool = False
    """It takes no fence."""
    stubborn: bool = False
    """It lets none of its parameters be set."""


@dataclass(frozen=True, slots=True)
class Build:
    """How a vehicle is built."""

    id: str
    system: int
    home: Degrees
    make: str = "px4"
    """`px4` or `ardupilot`."""
    flight: float = 1200.0
    """Seconds in the air from full to empty."""
    charge: float = inf
    """Seconds on the ground from empty to full."""
    grips: bool = False
    """Whether it has a gripper, and is set up for it."""
    senses: Mapping[str, str] = field(default_factory=dict)
    """The quantities that its companion computer tells, by the names of the values."""
    wind: Wind = CALM


@dataclass(slots=True)
class Parameter:
    value: float
    whole: bool = False


@dataclass(slots=True)
class Asked:
    """A command, from either of the two messages that carry one."""

    command: int
    values: tuple[float, float, float, float]
    place: tuple[float, float] | None
    """Latitude and longitude in degrees, if it names some."""
    height: float
    frame: int
    exact: bool
    """Whether it came with whole numbers, and its place is not rounded to a metre."""


@dataclass(slots=True)
class Record:
    """What a vehicle has done, for tests to check flights against."""

    orders: list[str] = field(default_factory=list)
    photos: list[Metres] = field(default_factory=list)
    grips: list[bool] = field(default_factory=list)
    """What its gripper has done: closed, or opened."""
    fell: bool = False
    landings: int = 0
    overruled: list[str] = field(default_factory=list)
    """What it was ordered while it acted by itself."""


def leaning(degrees: float) -> float:
    """Return how fast a tilt takes it through the air: the drag is that of ArduPilot's simulator, SIM_Frame.h."""
    return SPEED_AT_45 * sqrt(tan(radians(degrees)))


class Vehicle:
    """What is common to both makes."""

    MAKE: ClassVar[int]
    MODES: ClassVar[Mapping[Doing, int]]
    """The number of each mode, as heartbeats have it."""

    def __init__(
        self,
        build: Build,
        limits: Limits,
        parameters: dict[str, Parameter],
        gripper: Gripper,
        around: Around | None,
    ) -> None:
        self.build = build
        self.gripper = gripper
        self.around = around
        self.parameters = parameters
        self.plane = LocalPlane(*build.home)
        self.body = Body(limits)
        self.doing = Doing.HOLD
        self.armed = self.has_flown = False
        self._armed_at = 0.0
        self._was_beyond = False
        self._by_itself: float | None = None
        """Since when it has done what nobody ordered; None: it does what it was told."""
        self.charge = 1.0
        self.faults = Faults()
        self.record = Record()
        self.now = self.touched = 0.0
        """Seconds since it was switched on, and when it has touched down."""
        self.heard = -inf
        """When it last heard of a ground station; never: minus infinity."""
        self.images = 0
        self.fence: tuple[tuple[float, float], ...] = ()
        """Latitudes and longitudes of the corners of what it must not leave; none: it may fly anywhere."""
        self.said: list[tuple[int, str]] = []
        """Texts to be sent, with their severity."""
        self.done: list[tuple[int, int]] = []
        """Answers to be sent about commands that were in progress: the command, and a MAV_RESULT."""
        self.commands: dict[int, Callable[[Asked], int]] = {
            mavlink.MAV_CMD_COMPONENT_ARM_DISARM: self.arm_or_disarm,
            mavlink.MAV_CMD_NAV_TAKEOFF: self.take_off,
            mavlink.MAV_CMD_DO_REPOSITION: self.go_to,
            mavlink.MAV_CMD_NAV_LAND: lambda _: self.switch(Doing.LAND),
            mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH: lambda _: self.switch(Doing.RETURN),
            mavlink.MAV_CMD_DO_SET_MODE: self.set_mode,
            mavlink.MAV_CMD_DO_CHANGE_SPEED: self.change_speed,
            mavlink.MAV_CMD_DO_FLIGHTTERMINATION: self.terminate,
            mavlink.MAV_CMD_DO_GRIPPER: self.grip,
            mavlink.MAV_CMD_SET_MESSAGE_INTERVAL: lambda _: ACCEPTED,
        }

    def value(self, name: str) -> float:
        return self.parameters[name].value

    # What the makes do in different ways

    def arm_or_disarm(self, asked: Asked) -> int:
        raise NotImplementedError

    def take_off(self, asked: Asked) -> int:
        raise NotImplementedError

    def go_to(self, asked: Asked) -> int:
        raise NotImplementedError

    def set_mode(self, asked: Asked) -> int:
        raise NotImplementedError

    def change_speed(self, asked: Asked) -> int:
        raise NotImplementedError

    def terminate(self, asked: Asked) -> int:
        raise NotImplementedError

    def grip(self, asked: Asked) -> int:
        raise NotImplementedError

    def gripped(self) -> None:
        """Tell that the gripper is where it was to be."""

    def switch(self, doing: Doing) -> int:
        raise NotImplementedError

    def watch(self) -> None:
        """Look whether a failsafe must act."""
        raise NotImplementedError

    def steer(self) -> None:
        """Give the body its goal for what it is at."""
        raise NotImplementedError

    def landed_mode(self) -> None:
        """Take the mode that it has once it has disarmed."""

    # Its state

    @property
    def mode_number(self) -> int:
        """Its mode, as its heartbeat has it."""
        return self.MODES[self.doing]

    @property
    def high(self) -> bool:
        return self.body.at[2] > TOUCHED

    @property
    def flies(self) -> bool:
        return self.armed and self.high

    @property
    def volts(self) -> float:
        return EMPTY_VOLTS + (FULL_VOLTS - EMPTY_VOLTS) * self.charge

    @property
    def problem(self) -> str:
        """Why it would not arm; nothing: it would."""
        if self.faults.blind:
            return "no position: it has no satellites"
        return self.faults.unready

    @property
    def landed_state(self) -> int:
        if not self.high:
            return int(mavlink.MAV_LANDED_STATE_ON_GROUND)
        states = {
            Doing.TAKE_OFF: mavlink.MAV_LANDED_STATE_TAKEOFF,
            Doing.LAND: mavlink.MAV_LANDED_STATE_LANDING,
        }
        return int(states.get(self.doing, mavlink.MAV_LANDED_STATE_IN_AIR))

    @property
    def place(self) -> Degrees:
        x, y, z = self.body.at
        return self.plane.to_degrees((x, y, z))

    def is_beyond(self, place: Metres, highest: float) -> bool:
        """Return whether a place is outside of its fence, or higher than so many metres."""
        x, y, z = place
        around = [self.plane.to_metres((*corner, self.build.home[2]))[:2] for corner in self.fence]
        return z > highest or (bool(around) and not inside((x, y), tuple(around)))

    def leaves(self, is_beyond: bool) -> bool:
        """Return whether it has left its fence since the last look."""
        was_beyond = self._was_beyond
        self._was_beyond = is_beyond
        return is_beyond and not was_beyond

    def homewards(self, height: float, near: float) -> Metres:
        """Return the next point of the way home: up to a height, over home, and then down; without a cone."""
        x, y, z = self.body.at
        if hypot(x, y) > near:
            rises = z < height - 0.5 and self.body.goal[:2] != (0.0, 0.0)
            return (*self.body.goal[:2], height) if rises else (0.0, 0.0, max(z, height))
        self.switch(Doing.LAND)
        return 0.0, 0.0, z

    @property
    def gauge(self) -> int:
        """How full its battery is, as it tells: in per cent; -1: it does not tell."""
        return -1 if self.faults.gaugeless else round(100 * max(0.0, self.charge - self.faults.sag))

    @property
    def here(self) -> Metres:
        """Where it believes to be."""
        x, y, z = self.body.at
        return x, y, z

    @property
    def truth(self) -> Metres:
        """Where it is."""
        x, y, z = self.body.at
        return x - self.faults.astray, y, z

    @property
    def velocity(self) -> Metres:
        """Metres a second to the east, north and up."""
        east, north, up = self.body.velocity
        return east + (self.faults.blown if self.high else 0.0), north, up

    def err(self, metres: float) -> None:
        """Let it believe that it is so far to the east of where it is."""
        self.body.at[0] += metres - self.faults.astray
        self.faults.astray = metres

    def stop_here(self) -> None:
        self.body.goal = self.body.stopping_place

    def arm(self) -> None:
        self.armed = True
        self.has_flown = False
        self._armed_at = self.now
        self.faults.raised = 0.0

    def disarm_if_idle(self, seconds: float) -> None:
        """Disarm if it has not begun to fly for so long since it was armed."""
        waits = not self.has_flown and self.doing is not Doing.TAKE_OFF
        if waits and self.now - self._armed_at > seconds:
            self.disarm()

    def disarm(self) -> None:
        self.armed = False
        self._by_itself = None
        self.landed_mode()

    def fail_safe(self, doing: Doing, why: str) -> None:
        """Do what a failsafe does, once."""
        if self.flies and self.doing is not doing:
            self.tell(mavlink.MAV_SEVERITY_CRITICAL, why)
            self.switch(doing)
            self.acts_by_itself(doing is not Doing.HOLD)

    def acts_by_itself(self, does: bool) -> None:
        """Note that nobody ordered what it does now, or that it was given back."""
        self._by_itself = self.now if does else None

    def tell(self, severity: int, text: str) -> None:
        self.said.append((severity, text))

    def step(self, seconds: float) -> None:
        """Let time pass."""
        self.now += seconds
        body = self.body
        if self.armed and not self.faults.dead:
            self.watch()
            self.steer()
            body.wind = self.build.wind.at(self.now)
            body.fly(seconds)
            if self.high:
                body.at[0] += self.faults.blown * seconds
        elif self.high:
            self.record.fell = True
            body.fall(seconds)
        elif self.armed:
            self.tell(mavlink.MAV_SEVERITY_EMERGENCY, "Crash: Disarming")
            self.disarm()
        east, north, _ = body.velocity
        if hypot(east, north) > 0.5:
            body.heading = atan2(east, north)
        self._charge(seconds)
        if self.gripper.arrives(self.now):
            self.record.grips.append(bool(self.gripper.closed))
            self.gripped()
        if self.doing in (Doing.LAND, Doing.SINK) and self.armed and not self.high:
            self._touch_down()
        elif self.high:
            self.touched = self.now
            self.has_flown = True

    def _charge(self, seconds: float) -> None:
        body = self.body
        if self.armed:
            more = power(body.airspeed) / power(hypot(*body.velocity[:2])) if self.high else 1.0
            change = -more / self.build.flight
        else:
            change = 1 / self.build.charge
        self.charge = min(1.0, max(0.0, self.charge + change * seconds))
        if self.charge == 0.0 and self.armed:
            self.disarm()

    def _touch_down(self) -> None:
        """Disarm, when it has stood for a moment."""
        if self.now - self.touched >= self.disarms_after:
            self.record.landings += 1
            self.disarm()

    disarms_after = 2.0
    """Seconds on the ground after which a landing is over."""

    def height_of(self, asked: Asked) -> float:
        """Return the height above home that a command names."""
        if asked.frame == mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT:
            return asked.height + self.faults.raised
        return asked.height - self.build.home[2]

    def goal_of(self, asked: Asked) -> Metres:
        """Return where a command sends it: what it does not name stays as it is."""
        x, y, z = self.body.at
        if asked.place is not None:
            x, y, _ = self.plane.to_metres((*asked.place, self.build.home[2]))
        if isfinite(asked.height):
            z = self.height_of(asked)
        return x, y, max(0.0, z)

    def do(self, asked: Asked) -> int | None:
        """Carry out a command; return its answer, or None where that is lost."""
        faults = self.faults
        does = self.commands.get(asked.command)
        if does is None:
            return UNSUPPORTED
        if self._by_itself is not None and self.now - self._by_itself > _NOTICED:
            self.record.overruled.append(f"{asked.command} while it was to {self.doing.value}")
        if faults.busy > 0:
            faults.busy -= 1
            return BUSY
        if faults.denied > 0:
            faults.denied -= 1
            return DENIED
        before = self.doing
        result = does(asked)
        if self.doing is not before:
            self._by_itself = None
        self.record.orders.append(f"{asked.command}: {result}")
        if faults.unanswered > 0:
            faults.unanswered -= 1
            return None
        if faults.lost_answer == asked.command:
            faults.lost_answer = 0
            return None
        return result
