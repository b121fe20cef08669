"""Where an interrupted mission goes on: the nearest block behind it that waits or allocates.

A Stop takes the drone away and dissolves every fork, so a block inside a fork is no such point, nor
one that is reached with a drone allocated already. A mission that has met no point yet begins anew.
One with nothing left to fly (COMPLETED) goes back to where its last drone was allocated, and from
there it is told once more how that trip ended: nothing is flown again.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from heapq import heappop, heappush

from plutoc.check.flow import Facts, Flow, Place
from plutoc.graph.model import Graph
from plutoc_runtime.domain.status import Status

_FIRST = frozenset({Status.UNEXECUTED, Status.STANDBY})

Points = Mapping[Place, int]
"""For each place the nearest points on the ways to it: a bit a block, in the order of the source."""

IsPoint = Callable[[Flow, Place], bool]


def nearest(flow: Flow) -> Points:
    """Return for each place the points at which a mission goes on that is interrupted there."""
    unfinished = _points(flow, _is_point)
    over = _points(flow, _is_allocator)
    return {
        place: (over if place.status is Status.COMPLETED else unfinished)[place]
        for place in flow.places
    }


def resumed(graph: Graph, points: Points) -> tuple[Place, ...]:
    """Return where interrupted missions go on, each with the status that it has then."""
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


def entries(graph: Graph, points: Sequence[Points]) -> Mapping[str, frozenset[Status]]:
    """Return the blocks at which missions go on, in the order of the source, and their statuses.

    Where they are made is none of them: those that are set back to there begin anew.
    """
    found: dict[str, set[Status]] = {}
    for place in (place for some in points for place in resumed(graph, some)):
        found.setdefault(place.node, set()).add(place.status)
    return {
        node.name: frozenset(found[node.name])
        for node in graph.nodes
        if node.name in found and not node.block.creates
    }


def resume_points(graph: Graph, points: Sequence[Points]) -> Mapping[str, tuple[str, ...]]:
    """Return the blocks at which a mission can go on that was interrupted at each block."""
    found = dict.fromkeys(graph.node, 0)
    for place, bits in (pair for some in points for pair in some.items()):
        if place.node in found:
            found[place.node] |= bits
    named = {bits: _named(graph, bits) for bits in set(found.values())}
    return {name: named[bits] for name, bits in found.items()}


def _named(graph: Graph, bits: int) -> tuple[str, ...]:
    lowest_first = reversed(f"{bits:0{len(graph.node)}b}")
    return tuple(n for n, bit in zip(graph.node, lowest_first, strict=True) if bit == "1")


def _points(flow: Flow, is_point: IsPoint) -> Points:
    places = tuple(flow.places)
    number = {place: i for i, place in enumerate(places)}
    bit = {name: 1 << i for i, name in enumerate(flow.graph.node)}
    points = [p for p, step in flow.places.items() if step is None or is_point(flow, p)]
    found = dict.fromkeys(places, 0)
    found.update((place, bit[place.node]) for place in points)
    settled = frozenset(points)
    queue = [number[place] for place in points]  # the first is always the nearest
    queued = set(queue)
    while queue:
        one = heappop(queue)
        queued.remove(one)
        brought = found[places[one]]
        for following in flow.after[places[one]]:
            if following not in settled and brought & ~found[following]:
                found[following] |= brought
                if number[following] not in queued:
                    queued.add(number[following])
                    heappush(queue, number[following])
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
