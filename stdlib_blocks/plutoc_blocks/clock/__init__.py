"""Clock: holds a mission until it is time for its next trip."""

from plutoc.block import Block, same
from plutoc_runtime.domain.fields import Entity, Field, FieldType
from plutoc_runtime.domain.status import Status

from .step import wait_for_time

CLOCK = Block(
    name="Clock",
    doc="""Waits the next trip's delay before the mission goes on.

    The delay counts from the mission's arrival here, once for each attempt at the trip. A mission
    with `at` begins at that time of day; one with `every` begins each further round at a multiple
    of it after its first start; hours are those of a zone. Source: thesis 4.2; `at` and `every` are ours.""",
    step=wait_for_time,
    transitions=same(Status.UNEXECUTED, Status.STANDBY),
    needs=(
        Field(
            name="at",
            on=Entity.MISSION,
            type=FieldType.TIME_OF_DAY,
            label="Start at",
            doc="Time of day at which the mission's first trip may start.",
        ),
        Field(
            name="every",
            on=Entity.MISSION,
            type=FieldType.TIME,
            label="Repeat every",
            doc="Time between the starts of two rounds.",
        ),
        Field(
            name="delay",
            on=Entity.TRIP,
            type=FieldType.TIME,
            label="Delay",
            doc="Time to wait before the trip.",
        ),
    ),
    reads=("at", "every"),
    named=True,
    holds=True,
)
