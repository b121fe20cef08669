"""Flying real drones: the navigation protocol, its errors, and a team of drones."""

from __future__ import annotations

from ..shared.domain.model import Photo, Point
from .errors import (
    ActionNotDone,
    BatteryLow,
    Crashed,
    LinkLost,
    Locked,
    NavigationError,
    NotReady,
    OutsideArea,
    PositionLost,
    Rejected,
    TargetTimeout,
)
from .protocol import (
    BATTERY_LOW,
    CRASHED,
    LINK_LOST,
    LOCKED,
    POSITION_LOST,
    Acts,
    CaredFor,
    DroneEvent,
    DroneNavigation,
    DroneSetup,
    DroneTelemetry,
    Identifiable,
    Locatable,
    Readable,
    Scannable,
)
from .telemetry import Reports

__all__ = [
    "BATTERY_LOW",
    "CRASHED",
    "LINK_LOST",
    "LOCKED",
    "POSITION_LOST",
    "ActionNotDone",
    "Acts",
    "BatteryLow",
    "CaredFor",
    "Crashed",
    "DroneEvent",
    "DroneNavigation",
    "DroneSetup",
    "DroneTelemetry",
    "Identifiable",
    "LinkLost",
    "Locatable",
    "Locked",
    "NavigationError",
    "NotReady",
    "OutsideArea",
    "Photo",
    "Point",
    "PositionLost",
    "Readable",
    "Rejected",
    "Reports",
    "Scannable",
    "TargetTimeout",
]
