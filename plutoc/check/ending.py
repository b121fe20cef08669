"""From everywhere a way must lead to an end: loops that nothing leaves, now or one day."""

from __future__ import annotations

from plutoc.check import errors
from plutoc.check.components import loops, round_of
from plutoc.check.flow import Flow, Place, blocks_of
from plutoc.check.rounds import rounds
from plutoc.diagnostic import Diagnostic
from plutoc_runtime.status import Status


def endless(flow: Flow) -> list[Diagnostic]:
    """Find loops outside forks that a mission can enter and never leave."""
    return [
        errors.endless(
            flow.graph,
            flow.graph.node[part[0].node],
            flow.way(part[0]),
            blocks_of(round_of(flow.after, part, part[0])),
        )
        for part in rounds(flow)
        # where no place is outside of a fork, it is the fork that does not close
        if any(place.frame is None for place in part)
    ]


def spinning(flow: Flow) -> list[Diagnostic]:
    """Find loops of blocks that only repeat: once a mission's rounds are flown, no time passes there.

    Whoever has no round left has none the next time either, unless a hook or a flight comes between.
    """
    repeating = {
        place: tuple(target for target in flow.after[place] if _is_over(flow, target))
        for place in flow.places
        if _is_over(flow, place)
    }
    return [
        errors.spins(
            flow.graph,
            flow.graph.node[part[0].node],
            flow.way(part[0]),
            blocks_of(round_of(flow.after, part, part[0])),
        )
        for part in loops(repeating)
    ]


def _is_over(flow: Flow, place: Place) -> bool:
    node = flow.graph.node.get(place.node)
    return node is not None and node.block.repeats and place.status is Status.COMPLETED
