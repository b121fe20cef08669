"""GateFunnel: all branches of a fork come together."""

from plutoc.block import ANY_SAME, Block, Gate

from .step import wait_for_all

GATE_FUNNEL = Block(
    name="GateFunnel",
    doc="""Waits for every clone of a fork, then lets one mission pass.

    Where the clones differ the worst status wins: FAILED, then STANDBY, COMPLETED, RUNNING and
    UNEXECUTED. Source: thesis 4.2.""",
    step=wait_for_all,
    transitions=ANY_SAME,
    gate=Gate.ALL,
)
