"""The branches of all forks, and the facts about them that the checks of forks share."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import networkx as nx

from plutoc.block import IN_GRAPH
from plutoc.check.flow import Flow, Fork, Frame, Place, is_final
from plutoc.graph.digraph import reachable
from plutoc.graph.model import END, Edge
from plutoc_runtime.domain.status import Status

Astray = tuple[Place, Status | None]
"""A place, and the status with which it is left although no edge takes it."""


@dataclass(slots=True, kw_only=True, eq=False)
class Branch:
    """One branch of a fork, over all the missions that come through it."""

    fork: Fork
    number: int
    edge: Edge
    gates: dict[str, Place] = field(default_factory=dict)
    """The gates at which it closes, each with the nearest arrival."""
    astray: Astray | None = None
    """The nearest place where a clone ends, or is flown, before its gate."""
    circles: Place | None = None
    """The nearest place from which a clone can loop for ever."""
    stuck: bool = False
    nodes: dict[str, None] = field(default_factory=dict)
    """The blocks in it, without those of inner forks."""
    inner: dict[Fork, None] = field(default_factory=dict)
    """The forks that begin in it."""


Branches = Mapping[Fork, tuple[Branch, ...]]


def branches(flow: Flow) -> Branches:
    """Return all forks with their branches, in the order of the source."""
    forks = {split.fork for split in flow.entries}
    found = {
        (node.name, status): tuple(
            Branch(fork=(node.name, status), number=number, edge=edge)
            for number, edge in enumerate(flow.branches(node.name, status))
        )
        for node in flow.graph.nodes
        for status in IN_GRAPH
        if (node.name, status) in forks
    }
    for place in flow.places:
        if place.frame is not None:
            _note(flow, _of(found, place.frame), place)
    for place, status in flow.loose:
        if place.frame is not None:
            branch = _of(found, place.frame)
            branch.stuck = branch.stuck or not is_final(status)
            if is_final(status) and branch.astray is None:
                branch.astray = (place, status)
    for split, entries in flow.entries.items():
        for place in entries:
            if place.frame is not None:
                _of(found, place.frame).inner[split.fork] = None
    for part in flow.endless:
        frame = part[0].frame
        if frame is not None and all(place.frame is not None for place in part):
            branch = _of(found, frame)
            branch.circles = branch.circles or part[0]
    return found


def nesting(found: Branches) -> nx.DiGraph:
    """Return the nesting of forks: for each, those that begin within its branches."""
    inside = nx.DiGraph()
    inside.add_nodes_from(found)
    inside.add_edges_from(
        (fork, inner) for fork, parts in found.items() for part in parts for inner in part.inner
    )
    return inside


def within(found: Branches, inside: nx.DiGraph, branch: Branch) -> tuple[Branch, ...]:
    """Return the branch and all branches of forks in it, at any depth, in any order."""
    deeper = (one for fork in reachable(inside, branch.inner) for one in found[fork])
    return tuple({branch, *deeper})


def _of(found: Branches, frame: Frame) -> Branch:
    return found[frame.split.fork][frame.branch]


def _note(flow: Flow, branch: Branch, place: Place) -> None:
    block = None if place.node == END else flow.graph.node[place.node].block
    if block is None or (not place.out and (block.allocates or block.launches)):
        branch.astray = branch.astray or (place, None)
    elif not place.out and block.gate is not None:
        branch.gates.setdefault(place.node, place)
    if block is not None and (place.out or block.gate is None):
        branch.nodes[place.node] = None
