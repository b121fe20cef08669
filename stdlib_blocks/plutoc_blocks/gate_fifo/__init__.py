"""GateFIFO: the first branch of a fork goes on."""

from plutoc.block import ANY_SAME, Block, Gate

from .step import pass_first

GATE_FIFO = Block(
    name="GateFIFO",
    doc="""Lets the first clone of a fork pass, and calls the others' work off.

    It closes one fork at a time, by the fork's own number: a clone that comes late belongs to a
    fork that is closed, and is dropped. Source: thesis 4.2.""",
    step=pass_first,
    transitions=ANY_SAME,
    gate=Gate.FIRST,
)
