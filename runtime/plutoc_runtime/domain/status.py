"""The statuses of missions, trips and drones (thesis 4.1, and what it left open)."""

from __future__ import annotations

from enum import Enum


class Status(Enum):
    """The status of a mission. Blocks see the first five; the others exist outside the graph."""

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
    """The status of a trip. SKIPPED exists outside the graph."""

    WAITING = "WAITING"
    EXECUTING = "EXECUTING"
    COMPLETED = "COMPLETED"
    FAILED = "FAILED"
    SKIPPED = "SKIPPED"


class DroneStatus(Enum):
    """The status of a drone. It is FREE only when landed, healthy and above its reserve."""

    FREE = "FREE"
    BUSY = "BUSY"
    RETURNING = "RETURNING"
    CHARGING = "CHARGING"
    RECOVERING = "RECOVERING"
    LOST = "LOST"
    OFFLINE = "OFFLINE"


IN_THE_AIR = (DroneStatus.BUSY, DroneStatus.RETURNING, DroneStatus.RECOVERING)
"""The statuses of drones that fly, or are about to."""

UNEXECUTED, RUNNING, STANDBY = Status.UNEXECUTED, Status.RUNNING, Status.STANDBY
COMPLETED, FAILED = Status.COMPLETED, Status.FAILED
"""The five by names of their own: to look one up on its class takes many times as long."""

WORST_FIRST = (FAILED, STANDBY, COMPLETED, RUNNING, UNEXECUTED)
"""The order in which a gate that waits for all chooses the status that it passes on."""
