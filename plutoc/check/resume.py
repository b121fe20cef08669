"""Where an interrupted mission resumes: the last block before that waits or allocates.

A Stop takes the drone away and dissolves every fork, so a block inside a fork is no such point, nor one that
is reached with a drone allocated already. A mission without a point starts again. One with nothing left to
fly (COMPLETED) returns to where its last drone was allocated, and from there gets the outcome of that trip
again: nothing is flown twice.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import reduce
from operator import or_

import networkx as nx

from plutoc.check.flow import Facts, Flow, Place
from plutoc.graph.model import Graph
from plutoc_runtime.domain.status import Status

_FIRST = frozenset({Status.UNEXECUTED, Status.STANDBY})

Points = Mapping[Place, int]
"""For each place the nearest points on the ways to it: a bit a block, in the order of the source."""

IsPoint = Callable[[Flow, Place], bool]


def nearest(flow: Flow) -> Points:
    """Return for each place the points at which a mission interrupted there resumes."""
    number = {place: i for i, place in enumerate(flow.places)}
    after = [(number[one], number[other]) for one, other in flow.after.edges]
    unfinished = _points(flow, after, _is_point)
    over = _points(flow, after, _is_allocator)
    return {
        place: (over if place.status is Status.COMPLETED else unfinished)[i]
        for place, i in number.items()
    }


def resumed(graph: Graph, points: Points) -> tuple[Place, ...]:
    """Return where interrupted missions resume, with their statuses then."""
    found = {False: 0, True: 0}
    for place, bits in points.items():
        found[place.facts.launched] |= bits
    return tuple(
        Place(
            frame=None,
            node=name,
            status=Status.STANDBY if launched else Status.UNEXECUTED,
            facts=Facts(launched=launched),
        )
        for launched, bits in found.items()
        for name in _named(graph, bits)
    )


def entries(
    graph: Graph, points: Sequence[Points], of_events: Sequence[str]
) -> Mapping[str, frozenset[Status]]:
    """Return the blocks at which missions resume, in the order of the source, with their statuses.

    Those that make missions of events among them, but not the other creator: missions that return
    there start again.
    """
    found: dict[str, set[Status]] = {name: {Status.UNEXECUTED} for name in of_events}
    for place in (place for some in points for place in resumed(graph, some)):
        found.setdefault(place.node, set()).add(place.status)
    return {
        node.name: frozenset(found[node.name])
        for node in graph.nodes
        if node.name in found and (node.name in of_events or not node.block.creates)
    }


def resume_points(graph: Graph, points: Sequence[Points]) -> Mapping[str, tuple[str, ...]]:
    """Return for each block where a mission interrupted there can resume."""
    found = dict.fromkeys(graph.node, 0)
    for place, bits in (pair for some in points for pair in some.items()):
        if place.node in found:
            found[place.node] |= bits
    named = {bits: _named(graph, bits) for bits in set(found.values())}
    return {name: named[bits] for name, bits in found.items()}


def _named(graph: Graph, bits: int) -> tuple[str, ...]:
    lowest_first = reversed(f"{bits:0{len(graph.node)}b}")
    return tuple(n for n, bit in zip(graph.node, lowest_first, strict=True) if bit == "1")


def _points(flow: Flow, after: Sequence[tuple[int, int]], is_point: IsPoint) -> Sequence[int]:
    """Return the nearest points of each place; places go by their numbers, which are quick to hash."""
    bit = {name: 1 << i for i, name in enumerate(flow.graph.node)}
    found = [
        bit[place.node] if step is None or is_point(flow, place) else 0
        for place, step in flow.places.items()
    ]
    onward = nx.DiGraph()
    onward.add_nodes_from(range(len(found)))
    onward.add_edges_from(pair for pair in after if not found[pair[1]])
    # Tarjan's algorithm gives a component after all that it leads to: reversed, each is last
    for part in reversed(list(nx.strongly_connected_components(onward))):
        bits = reduce(or_, (found[i] for one in part for i in (one, *onward.pred[one])))
        for one in part:
            found[one] = bits
    return found


def _is_point(flow: Flow, place: Place) -> bool:
    node = flow.graph.node.get(place.node)
    if node is None or place.frame is not None or not node.block.accepts >= _FIRST:
        return False
    if place.facts.spent:
        return False  # it ends here at once
    return node.block.allocates or (node.block.holds and not place.facts.allocated)


def _is_allocator(flow: Flow, place: Place) -> bool:
    return _is_point(flow, place) and flow.graph.node[place.node].block.allocates
