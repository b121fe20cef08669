"""TripMonitor: waits for the end of the trip."""

from plutoc.block import Block, emits
from plutoc_runtime.domain.status import Status

from .step import watch_trip

TRIP_MONITOR = Block(
    name="TripMonitor",
    doc="""Watches the trip in flight and ends with its outcome.

    STANDBY when it went well and trips are left, COMPLETED when it was the last, FAILED when the
    drone crashed, ran empty, was lost, or its action failed. Source: thesis 4.2.""",
    step=watch_trip,
    transitions={Status.RUNNING: emits(Status.STANDBY, Status.COMPLETED, Status.FAILED)},
    watches=True,
)
