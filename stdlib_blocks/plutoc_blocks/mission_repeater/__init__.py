"""MissionRepeater: a finished mission begins again."""

from plutoc.block import Block, emits
from plutoc_runtime.domain.fields import Entity, Field, FieldType
from plutoc_runtime.domain.status import Status

from .step import repeat_mission

MISSION_REPEATER = Block(
    name="MissionRepeater",
    doc="""Starts a finished mission once more, as often as its user asked.

    The user's own trips go back to the list, all WAITING; trips that an evaluator added do not.
    Source: thesis 4.2.""",
    step=repeat_mission,
    transitions={Status.COMPLETED: emits(Status.STANDBY, Status.COMPLETED)},
    needs=(
        Field(
            name="repeat",
            on=Entity.MISSION,
            type=FieldType.ROUNDS,
            label="Repeat",
            doc="How many more rounds to fly after the first; true: until it is stopped.",
            default=0,
        ),
    ),
    repeats=True,
)
