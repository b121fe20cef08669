"""MissionModifier: code of the app's own, anywhere in the graph."""

from plutoc.block import ANY_SAME, Block, HookKind, HookParam

from .step import modify_mission

MISSION_MODIFIER = Block(
    name="MissionModifier",
    doc="""Calls a hook of yours with the mission.

    A hook that declares `emits` decides with which of those statuses the mission goes on; it must
    fit what the mission is: STANDBY needs trips left and none in flight, COMPLETED none left.
    FAILED fails a trip in flight and calls its drone back. A hook without `emits` returns nothing,
    and the status stays. Source: thesis 4.2.""",
    step=modify_mission,
    transitions=ANY_SAME,
    params=(
        HookParam(
            name="hook",
            kind=HookKind.MODIFIER,
            doc="The modifier to call; its own parameters stand beside it.",
            passes=True,
        ),
    ),
    emits_by_hook=True,
)
