"""MissionCreator: where every mission begins."""

from plutoc.block import Block, same
from plutoc_runtime.domain.status import Status

from .step import create_mission

MISSION_CREATOR = Block(
    name="MissionCreator",
    doc="""Makes a mission of the trips that the user entered.

    Every graph has exactly one; `start` leads to it. Source: thesis 4.2.""",
    step=create_mission,
    transitions=same(Status.UNEXECUTED),
    creates=True,
)
