"""Where missions go from each block, with each status: the edges that carry something, by name."""

from __future__ import annotations

from collections.abc import Mapping

from plutoc.check.model import Checked, Fork
from plutoc.graph.model import END
from plutoc_runtime.status import IN_GRAPH, Status

Leaving = tuple[str, Status]
"""A block, and the status that a mission leaves it with."""
Routes = Mapping[Leaving, tuple[str, ...]]


def routes(checked: Checked) -> Routes:
    """Return the blocks that follow, in the order of the source; an implicit end is an end."""
    found: dict[Leaving, tuple[str, ...]] = {}
    for name in checked.graph.node:
        edges = checked.graph.outgoing[name]
        for status in IN_GRAPH:
            if status in checked.leaves.get(name, ()):
                targets = [edge.target for edge in edges if status in checked.carries[edge]]
                found[name, status] = tuple(targets) or (END,)
    return found


def destinations(checked: Checked, along: Routes) -> Routes:
    """Return where missions come to next, past the gates: those only bring forks together.

    The gate of a fork stays where a branch of it leads there straight.
    """
    forks = {(fork.node, fork.status): fork for fork in checked.forks}
    return {leaving: _past_gates(checked, along, leaving, forks) for leaving in along}


def _past_gates(
    checked: Checked, along: Routes, leaving: Leaving, forks: Mapping[Leaving, Fork]
) -> tuple[str, ...]:
    fork, status = forks.get(leaving), leaving[1]
    found: dict[str, None] = {}
    passed: dict[str, None] = {}
    ahead = list(reversed(along[leaving]))
    while ahead:
        name = ahead.pop()
        node = checked.graph.node.get(name)
        is_gate = node is not None and node.block.gate is not None
        own = fork is not None and fork.gate == name
        if not is_gate or own or (name, status) not in along:
            found[name] = None
        elif name not in passed:
            passed[name] = None
            ahead.extend(reversed(along[name, status]))
    return tuple(found)
