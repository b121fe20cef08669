"""What a vehicle has told: its place on the map, whether it flies, why it would not take off."""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass, field
from math import hypot, isfinite, pi, radians
from typing import Any

from ..drones.battery_gauge import BatteryGauge
from ..geodesy import Degrees, LocalPlane
from ..shared.domain.model import Point
from .makes import Place
from .twins import Twins

ON_GROUND = 1
"""MAV_LANDED_STATE."""
_ARMED = 128
"""MAV_MODE_FLAG_SAFETY_ARMED."""
_MOVED = 1.0
"""Metres by which its home must have been set higher or lower to count: satellites' heights drift."""
_NEAR_GROUND = 1.0
"""Metres above it, within which motors that stop are no fall."""
_VALUES = 1000
"""Of one name: a minute of them, at more than ten a second."""
_WARNING = 3
"""Texts that are at least so severe say why something is refused: MAVSDK counts up from 0, a text for debugging."""


@dataclass(slots=True)
class VehicleState:
    """The latest of all that it tells.

    Heights are those above where it was switched on or armed last, which stands on the map's ground: its height above
    sea level may be metres off that of the map, and both are only used together.
    """

    plane: LocalPlane | None
    """None: the map is where the vehicle is first heard of."""
    ground: float
    """The height of its home on the map, in metres."""
    gauge: BatteryGauge | None = None
    """By what its voltage says how full its battery is, where it does not say so itself."""
    degrees: Degrees | None = None
    """Its latitude, longitude, and altitude above sea level."""
    position: Point | None = None
    twins: Twins = field(default_factory=Twins)
    astray: str = ""
    """Why it is nowhere on the map."""
    sea: float = 0.0
    """By how much its height above sea level is more than that on the map."""
    lifted: float = 0.0
    """Metres by which its home was set higher while it flew: its heights are above that, and so it knows none."""
    yaw: float = 0.0
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    volts: float = 0.0
    battery: float | None = None
    """The charge, from 0 to 1; None: it tells none."""
    landed: int = 0
    armed: bool = False
    mode: int = -1
    """Its custom mode; -1: not told yet."""
    beaten: bool = False
    flew: bool = False
    """Whether it has left the ground since it was armed."""
    health: Mapping[str, bool] = field(default_factory=dict)
    home: tuple[float, float] | None = None
    cameras: tuple[Mapping[str, Any], ...] = ()
    texts: list[tuple[float, str]] = field(default_factory=list)
    """Its latest warnings, with when they came."""
    values: dict[str, deque[tuple[float, float]]] = field(default_factory=dict)
    """What its sensors have told last, by name, each with when it came."""

    @property
    def is_known(self) -> bool:
        """Whether all has been told that a flight needs to know."""
        return self.position is not None and self.beaten and self.landed != 0

    @property
    def is_well(self) -> bool:
        """Whether it says of itself that it could take off."""
        return bool(self.health) and all(self.health.values()) and self.battery is not None

    @property
    def speed(self) -> float:
        return hypot(*self.velocity)

    @property
    def flying(self) -> bool:
        """Whether it flies: landed is what says so, and has its motors off."""
        return self.armed and (self.flew or self.landed != ON_GROUND)

    def hear(self, told: str, facts: Any) -> None:
        """Take what it tells."""
        match told:
            case "position":
                self._position(facts)
            case "beat":
                self._beat(facts)
            case "landed":
                self.landed = int(facts)
                self.flew = self.flew or (self.armed and self.landed > ON_GROUND)
            case "battery":
                self._battery(facts)
            case "health":
                self.health = facts
            case "home":
                self.home = (facts[0], facts[1])
            case "cameras":
                self.cameras = tuple(facts)
            case "value":
                latest = self.values.setdefault(facts["name"], deque(maxlen=_VALUES))
                latest.append((time.monotonic(), facts["value"]))
            case "text" if facts["severity"] >= _WARNING:
                self.texts = [*self.texts[-4:], (time.monotonic(), facts["text"])]

    def _position(self, facts: Mapping[str, Any]) -> None:
        absolute, relative = facts["heights"]
        self.degrees = (*facts["place"], absolute)
        if self.plane is None:
            latitude, longitude = facts["place"]
            self.plane = LocalPlane(latitude, longitude, absolute)
        was_known = self.is_known
        try:
            x, y, z = self.point(facts)
        except ValueError as error:
            self.astray = str(error)
            return
        if self.landed == ON_GROUND and not self.armed:
            z = self.ground  # the height of its home drifts, until that is set anew as it is armed
        self.position = (x, y, z)
        sea = absolute - relative - self.ground
        moved = sea - self.sea
        if not self.flying:
            self.lifted = 0.0
        elif was_known and abs(moved) > _MOVED:
            self.lifted = moved
        self.sea = sea
        north, east, down = facts["velocity"]
        self.velocity = (north, east, down)
        self.twins.hear(facts["clock"], self.position, self.speed)
        heading = facts["heading"]
        if heading is not None and isfinite(heading):
            self.yaw = (pi / 2 + self.plane.bearing - radians(heading)) % (2 * pi)

    def _beat(self, facts: Mapping[str, Any]) -> None:
        was_armed = self.armed
        self.armed = is_armed(facts)
        self.mode = int(facts["mode"])
        self.beaten = True
        if self.armed != was_armed:
            self.flew = False

    @property
    def is_high(self) -> bool:
        """Whether motors that stop would let it fall; that it has landed may be told a moment later than that."""
        height = 0.0 if self.position is None else self.position[2] - self.ground
        return self.landed != ON_GROUND and height > _NEAR_GROUND

    def _battery(self, facts: Mapping[str, Any]) -> None:
        volts = facts["volts"]
        percent = facts["percent"]
        self.volts = volts if volts is not None and isfinite(volts) else 0.0
        if percent is not None and isfinite(percent) and percent >= 0:
            self.battery = min(1.0, percent / 100)
        elif self.gauge is not None and self.volts:
            self.gauge.hear(time.monotonic(), self.volts, flies=self.flying)
            self.battery = self.gauge.level
        elif not self.flying:  # in the air it is what it was, until it is told again
            self.battery = None

    def place(self, point: Point) -> Place:
        """Return a point of the map as it is told to an autopilot; raise `ValueError` if it is out of reach."""
        assert self.plane is not None
        latitude, longitude, _ = self.plane.to_degrees(point)
        return Place(latitude, longitude, point[2] + self.sea, point[2] - self.ground)

    def point(self, facts: Mapping[str, Any]) -> Point:
        """Return where on the map something was, such as a photo; raise `ValueError` if it was far from it."""
        assert self.plane is not None
        latitude, longitude = facts["place"]
        x, y, _ = self.plane.to_metres((latitude, longitude, self.plane.altitude))
        return x, y, facts["heights"][1] + self.ground

    def since(self, began: float) -> str:
        """Return what it has warned of since then."""
        return "; ".join(text for at, text in self.texts if at >= began)


def is_armed(beat: Mapping[str, Any]) -> bool:
    """Return whether a heartbeat says that motors are on."""
    return bool(beat["base"] & _ARMED)
