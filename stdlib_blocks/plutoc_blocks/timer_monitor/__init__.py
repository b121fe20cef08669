"""TimerMonitor: no trip may take longer than its safe time."""

from plutoc.block import Block, Param, emits
from plutoc_runtime.domain.fields import Entity, Field, FieldType
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import Status

from .step import timer_limit, watch_timer

TIMER_MONITOR = Block(
    name="TimerMonitor",
    doc="""Fails the trip when it takes longer than the mission's safe time.

    It goes beside a TripMonitor, with a gate behind both. At the limit it fails the trip and calls
    its drone back; otherwise it ends with the trip's outcome. At one instant the trip's own end
    wins. An explicit safe time of 0 is no limit. Source: thesis 4.2.""",
    step=watch_timer,
    transitions={Status.RUNNING: emits(Status.STANDBY, Status.COMPLETED, Status.FAILED)},
    params=(
        Param(
            name="default",
            type=Type.TIME,
            doc="The safe time of missions that name none. None: no limit.",
            least=0.0,
        ),
    ),
    needs=(
        Field(
            name="safe_time",
            on=Entity.MISSION,
            type=FieldType.TIME,
            label="Safe time",
            doc="Longest time that one trip may take; 0 is no limit.",
        ),
    ),
    watches=True,
    limits=True,
    limit=timer_limit,
)
