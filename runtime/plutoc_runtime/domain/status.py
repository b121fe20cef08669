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


UNEXECUTED, RUNNING, STANDBY = Status.UNEXECUTED, Status.RUNNING, Status.STANDBY
COMPLETED, FAILED = Status.COMPLETED, Status.FAILED
"""The five by names of their own: to look one up on its class takes many times as long."""

IN_GRAPH = (UNEXECUTED, RUNNING, STANDBY, COMPLETED, FAILED)
"""The statuses that edges carry, in declared order."""

WORST_FIRST = (FAILED, STANDBY, COMPLETED, RUNNING, UNEXECUTED)
"""What a gate that waits for all passes on: the worst of what arrived."""
