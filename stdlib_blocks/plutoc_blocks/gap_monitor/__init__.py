"""GapMonitor: no more than so much time between two actions."""

from plutoc.block import Block, Param, emits
from plutoc_runtime.domain.fields import Entity, Field, FieldType
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import Status

from .step import gap_limit, watch_gap

GAP_MONITOR = Block(
    name="GapMonitor",
    doc="""Fails the trip when its action comes too long after the mission's previous one.

    It goes beside a TripMonitor, with a gate behind both, like a TimerMonitor. The gap counts from
    the end of the mission's previous action; a round's first trip has no limit, and a retry counts
    from its own start. Ours: aerial mapping and PM10 need it, and the thesis could not say it
    (6.1.3, 6.1.4).""",
    step=watch_gap,
    transitions={Status.RUNNING: emits(Status.STANDBY, Status.COMPLETED, Status.FAILED)},
    params=(
        Param(
            name="default",
            type=Type.TIME,
            doc="The gap of trips that name none. None: no limit.",
            least=0.0,
        ),
    ),
    needs=(
        Field(
            name="gap",
            on=Entity.TRIP,
            type=FieldType.TIME,
            label="Gap",
            doc="Longest time from the previous action to this one; 0 is no limit.",
        ),
    ),
    watches=True,
    limits=True,
    limit=gap_limit,
)
