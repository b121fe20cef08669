"""Where an interrupted mission goes on: the nearest block behind it that waits or allocates.

A Stop takes the drone away and dissolves every fork, so a block inside a fork is no such point, nor
one that is reached with a drone allocated already. A mission that has met no point yet begins anew.
One with nothing left to fly (COMPLETED) goes back to where its last drone was allocated, and from
there it is told once more how that trip ended: nothing is flown again.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping, Sequence

from plutoc.check.flow import Facts, Flow, Place
from plutoc.graph.model import Graph
from plutoc_runtime.status import Status

_FIRST = frozenset({Status.UNEXECUTED, Status.STANDBY})

Points = Mapping[Place, Mapping[str, None]]
"""For each place the nearest points on the ways to it, as an ordered set."""

IsPoint = Callable[[Flow, Place], bool]


def nearest(flow: Flow) -> Points:
    """Return for each place the points at which a mission goes on that is interrupted there."""
    unfinished = _points(flow, _is_point)
    over = _points(flow, _is_allocator)
    return {
        place: (over if place.status is Status.COMPLETED else unfinished)[place]
        for place in flow.places
    }


def resumed(points: Points) -> tuple[Place, ...]:
    """Return where interrupted missions go on, each with the status that it has then."""
    return tuple(
        dict.fromkeys(
            Place(
                frame=None,
                node=name,
                status=Status.STANDBY if place.facts.launched else Status.UNEXECUTED,
                facts=Facts(launched=place.facts.launched),
            )
            for place, names in points.items()
            for name in names
        )
    )


def entries(graph: Graph, points: Sequence[Points]) -> Mapping[str, frozenset[Status]]:
    """Return the blocks at which missions go on, in the order of the source, and their statuses.

    Where they are made is none of them: those that are set back to there begin anew.
    """
    found: dict[str, set[Status]] = {}
    for place in (place for some in points for place in resumed(some)):
        found.setdefault(place.node, set()).add(place.status)
    return {
        node.name: frozenset(found[node.name])
        for node in graph.nodes
        if node.name in found and not node.block.creates
    }


def resume_points(graph: Graph, points: Sequence[Points]) -> Mapping[str, tuple[str, ...]]:
    """Return the blocks at which a mission can go on that was interrupted at each block."""
    found: dict[str, set[str]] = {name: set() for name in graph.node}
    for place, names in (pair for some in points for pair in some.items()):
        if place.node in found:
            found[place.node].update(names)
    number = {name: i for i, name in enumerate(graph.node)}
    return {name: tuple(sorted(found[name], key=number.__getitem__)) for name in found}


def _points(flow: Flow, is_point: IsPoint) -> Points:
    points = [p for p, step in flow.places.items() if step is None or is_point(flow, p)]
    found: dict[Place, dict[str, None]] = {place: {} for place in flow.places}
    found.update((place, {place.node: None}) for place in points)
    settled, queue = frozenset(points), deque(points)
    while queue:
        place = queue.popleft()
        for following in flow.after[place]:
            known = len(found[following])
            if following not in settled:
                found[following].update(found[place])
            if len(found[following]) > known:
                queue.append(following)
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
