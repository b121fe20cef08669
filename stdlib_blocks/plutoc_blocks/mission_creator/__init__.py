"""MissionCreator: where every mission begins."""

from plutoc.block import Block, HookKind, HookParam, same
from plutoc_runtime.domain.status import Status

from .step import create_mission

MISSION_CREATOR = Block(
    name="MissionCreator",
    doc="""Makes a mission of the trips that the user entered.

    Every graph has exactly one without a hook; `start` leads to it. With a hook it stands behind
    events, and makes a mission of an event, or none. Source: thesis 4.2; events are ours.""",
    step=create_mission,
    transitions=same(Status.UNEXECUTED),
    params=(
        HookParam(
            name="hook",
            kind=HookKind.CREATOR,
            doc="The creator to call with each event that leads here.",
            required=False,
            handed=False,
        ),
    ),
    creates=True,
)
