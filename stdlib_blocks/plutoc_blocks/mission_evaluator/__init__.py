"""MissionEvaluator: judges what a finished mission has brought."""

from plutoc.block import Block, HookKind, HookParam, emits
from plutoc_runtime.domain.fields import Entity, Field, FieldType
from plutoc_runtime.domain.status import Status

from .step import evaluate_mission

MISSION_EVALUATOR = Block(
    name="MissionEvaluator",
    doc="""Asks an evaluator whether the mission's results are good enough.

    The evaluator is the mission's own choice, else the block's. Its verdict may let trips be flown
    again or add new ones (STANDBY), accept the mission (COMPLETED), or reject it (FAILED).
    Source: thesis 4.1, 4.2.""",
    step=evaluate_mission,
    transitions={
        Status.COMPLETED: emits(Status.STANDBY, Status.COMPLETED, Status.FAILED),
    },
    params=(
        HookParam(
            name="hook",
            kind=HookKind.EVALUATOR,
            doc="The evaluator of missions that choose none; its own parameters stand beside it.",
            passes=True,
            instead="evaluator",
        ),
    ),
    needs=(
        Field(
            name="evaluator",
            on=Entity.MISSION,
            type=FieldType.EVALUATOR,
            label="Evaluator",
            doc="Which of the app's evaluators judges the mission.",
        ),
    ),
    evaluates=True,
)
