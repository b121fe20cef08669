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
    Rejected,
    TargetTimeout,
)
from .protocol import (
    Acts,
    DroneNavigation,
    Identifiable,
    Locatable,
    Readable,
    Scannable,
)
from .reports import Reports
from .setup import DroneSetup
from .telemetry import (
    BATTERY_LOW,
    CRASHED,
    LINK_LOST,
    LOCKED,
    DroneEvent,
    DroneTelemetry,
)

__all__ = [
    "BATTERY_LOW",
    "CRASHED",
    "LINK_LOST",
    "LOCKED",
    "ActionNotDone",
    "Acts",
    "BatteryLow",
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
    "Readable",
    "Rejected",
    "Reports",
    "Scannable",
    "TargetTimeout",
]
