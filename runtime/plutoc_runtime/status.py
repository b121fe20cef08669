"""Where a mission, a trip and a drone stand (thesis 4.1, and what it left open)."""

from __future__ import annotations

from enum import Enum


class Status(Enum):
    """Where a mission stands. Blocks see the first five; the others exist outside the graph."""

    UNEXECUTED = "UNEXECUTED"
    RUNNING = "RUNNING"
    STANDBY = "STANDBY"
    COMPLETED = "COMPLETED"
    FAILED = "FAILED"
    PAUSED = "PAUSED"
    CANCELLED = "CANCELLED"
    UNCERTAIN = "UNCERTAIN"
    HELD = "HELD"

    __hash__ = object.__hash__  # members are single: hashing by name is six times slower


class TripStatus(Enum):
    """Where a trip stands. SKIPPED exists outside the graph."""

    WAITING = "WAITING"
    EXECUTING = "EXECUTING"
    COMPLETED = "COMPLETED"
    FAILED = "FAILED"
    SKIPPED = "SKIPPED"


class DroneStatus(Enum):
    """Where a drone stands. It is FREE only when landed, healthy and above its reserve."""

    FREE = "FREE"
    BUSY = "BUSY"
    RETURNING = "RETURNING"
    CHARGING = "CHARGING"
    RECOVERING = "RECOVERING"
    LOST = "LOST"
    OFFLINE = "OFFLINE"


IN_GRAPH = (
    Status.UNEXECUTED,
    Status.RUNNING,
    Status.STANDBY,
    Status.COMPLETED,
    Status.FAILED,
)
"""The statuses that edges carry, in declared order."""

WORST_FIRST = (
    Status.FAILED,
    Status.STANDBY,
    Status.COMPLETED,
    Status.RUNNING,
    Status.UNEXECUTED,
)
"""What a gate that waits for all passes on: the worst of what arrived."""
