"""EventMonitor: an event breaks a flight off."""

from plutoc.block import Block, Choice, EventParam, emits
from plutoc_runtime.domain.status import Status
from plutoc_runtime.events.interruption import anything, own

from .step import event_limit, watch_event

EVENT_MONITOR = Block(
    name="EventMonitor",
    doc="""Breaks the flight off when an event comes.

    It goes beside a TripMonitor, with a gate behind both. When the event comes, the drone stops and
    hovers, and stays the mission's until its next allocation; the trip is WAITING again, no attempt
    is charged, and the mission goes on, STANDBY. Otherwise it ends with the trip's outcome. At one
    instant the trip's own end wins. Ours.""",
    step=watch_event,
    transitions={Status.RUNNING: emits(Status.STANDBY, Status.COMPLETED, Status.FAILED)},
    params=(
        EventParam(name="event", doc="The event that it waits for."),
        Choice(
            name="of",
            options={"own": own, "any": anything},
            default="own",
            doc="Whose event: raised by this mission's own hooks and drone, or any.",
        ),
    ),
    watches=True,
    limits=True,
    interrupts=True,
    limit=event_limit,
)
