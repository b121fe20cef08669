"""What each kind of block takes and sends on, written down by hand from what a graph means."""

from __future__ import annotations

from enum import StrEnum


class Status(StrEnum):
    """The five statuses that blocks see."""

    UNEXECUTED = "UNEXECUTED"
    RUNNING = "RUNNING"
    STANDBY = "STANDBY"
    COMPLETED = "COMPLETED"
    FAILED = "FAILED"


U, R, S, C, F = Status
FIVE = (U, R, S, C, F)
BADNESS = (U, R, C, S, F)
"""Of the statuses that meet at a funnel the last of these wins."""
END_ACCEPTS = (C, F)

BUILT_IN_EVENTS = ("late", "lost")

ACCEPTS: dict[str, tuple[Status, ...]] = {
    "MissionCreator": (),
    "Clock": (U, S),
    "DroneAllocator": (U, S),
    "TripLauncher": (U, S),
    "TripMonitor": (R,),
    "TimerMonitor": (R,),
    "GapMonitor": (R,),
    "EventMonitor": (R,),
    "GateFIFO": FIVE,
    "GateFunnel": FIVE,
    "MissionRepeater": (C,),
    "MissionEvaluator": (C,),
    "MissionModifier": FIVE,
    "PriorityManager": (F,),
    "TripSkipper": (F,),
}
GUARDED: dict[str, tuple[Status, ...]] = {"DroneAllocator": (F,)}
"""What a kind accepts besides, where a guard says so."""

NEED_A_TRIP = ("DroneAllocator", "PriorityManager", "TripSkipper")
"""A mission that comes there with no trip left ends."""

WATCHES = "TripMonitor"
EVENT_MONITOR = "EventMonitor"
LIMITS = ("TimerMonitor", "GapMonitor", EVENT_MONITOR)
MONITORS = (WATCHES, *LIMITS)
FUNNEL = "GateFunnel"
GATES = ("GateFIFO", FUNNEL)
