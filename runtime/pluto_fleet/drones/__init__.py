"""How one real drone is flown: what a navigation is made of, and what it may raise."""

from __future__ import annotations

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
from .protocol import Acts, CaredFor, DroneNavigation, Identifiable, Locatable, Readable, Scannable
from .reports import Reports
from .setup import DroneSetup
from .telemetry import (
    BATTERY_LOW,
    CRASHED,
    LINK_LOST,
    LOCKED,
    POSITION_LOST,
    DroneEvent,
    DroneTelemetry,
)

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
    "PositionLost",
    "Readable",
    "Rejected",
    "Reports",
    "Scannable",
    "TargetTimeout",
]
