"""From everywhere a way must lead to an end: loops that nothing leaves."""

from __future__ import annotations

from plutoc.check import errors
from plutoc.check.components import round_of
from plutoc.check.flow import Flow, blocks_of
from plutoc.check.rounds import rounds
from plutoc.diagnostic import Diagnostic


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
