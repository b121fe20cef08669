"""The routes of missions from each block, with each status: the edges in use, by name."""

from __future__ import annotations

from collections.abc import Mapping

from plutoc.block import IN_GRAPH
from plutoc.check.model import Checked
from plutoc.graph.model import END
from plutoc_runtime.domain.status import Status

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

    The gate of a fork stays where a branch of it leads there straight. Two branches may come to the
    same block: then it is there twice.
    """
    gates = {(fork.node, fork.status): fork.gate for fork in checked.forks}
    return {
        leaving: tuple(
            name
            for target in along[leaving]
            for name in _past_gates(checked, along, target, leaving[1], gates.get(leaving))
        )
        for leaving in along
    }


def _past_gates(
    checked: Checked, along: Routes, target: str, status: Status, own: str | None
) -> tuple[str, ...]:
    passed: dict[str, None] = {}
    ahead, found = [target], []
    while ahead:
        name = ahead.pop()
        node = checked.graph.node.get(name)
        is_gate = node is not None and node.block.gate is not None
        if not is_gate or name == own or (name, status) not in along:
            found.append(name)
        elif name not in passed:
            passed[name] = None
            ahead.extend(reversed(along[name, status]))
    return tuple(found)
