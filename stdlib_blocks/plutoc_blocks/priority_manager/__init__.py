"""PriorityManager: a failed trip is tried again, before others."""

from plutoc.block import Block, Narrowed, Param, emits
from plutoc_runtime.domain.fields import Entity, Field, FieldType
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import Status

from .step import raise_priority

PRIORITY_MANAGER = Block(
    name="PriorityManager",
    doc="""Puts a failed trip back with a higher priority.

    The mission goes on, STANDBY, as if the failure had not happened. When the trip has flown
    `max_attempts` times, the first included, FAILED goes on instead. Source: thesis 4.2; the bound
    is ours.""",
    step=raise_priority,
    transitions={Status.FAILED: emits(Status.STANDBY, Status.FAILED)},
    params=(
        Param(
            name="max_attempts",
            type=Type.INT,
            doc="How often a trip may fly, the first time included; 0 is no bound.",
            default=3,
            least=0,
        ),
    ),
    narrowed=(Narrowed(param="max_attempts", value=0, emits=emits(Status.STANDBY)),),
    needs=(
        Field(
            name="priority",
            on=Entity.TRIP,
            type=FieldType.INT,
            label="Priority",
            doc="Trips of a higher priority get their drones first.",
            default=0,
        ),
    ),
    retries=True,
    bound="max_attempts",
)
