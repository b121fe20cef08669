"""Where a mission goes on after a Stop: the nearest block behind it that waits or allocates.

A Stop takes the drone away and dissolves every fork, so a block inside a fork is no such point, nor
one that is reached with a drone allocated already. A mission that has met no point yet begins anew.
One with nothing left to fly (COMPLETED) is not set back: it goes on where it is.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping

from plutoc.check.flow import Facts, Flow, Place
from plutoc_runtime.status import Status

_FIRST = frozenset({Status.UNEXECUTED, Status.STANDBY})

Points = Mapping[Place, Mapping[str, None]]
"""For each place the nearest points on the ways to it, as an ordered set."""


def resumed(flow: Flow) -> tuple[Place, ...]:
    """Return where missions go on after a Stop, each with the status that it has then."""
    return tuple(
        dict.fromkeys(
            Place(
                frame=None,
                node=name,
                status=Status.STANDBY if place.facts.launched else Status.UNEXECUTED,
                facts=Facts(launched=place.facts.launched),
            )
            for place, names in _points(flow).items()
            if not _is_over(place)
            for name in names
        )
    )


def resume_points(flow: Flow) -> Mapping[str, tuple[str, ...]]:
    """Return the blocks at which a mission can go on that was stopped at each block."""
    found: dict[str, dict[str, None]] = {name: {} for name in flow.graph.node}
    for place, names in _points(flow).items():
        if place.node in found and not _is_over(place):
            found[place.node].update(names)
        elif place.node in found and place.frame is None:
            found[place.node][place.node] = None
    number = {name: i for i, name in enumerate(flow.graph.node)}
    return {name: tuple(sorted(found[name], key=number.__getitem__)) for name in found}


def _points(flow: Flow) -> Points:
    found: dict[Place, dict[str, None]] = {place: {} for place in flow.places}
    queue: deque[Place] = deque()
    for place, step in flow.places.items():
        if step is None or _is_point(flow, place):
            found[place][place.node] = None
            queue.append(place)
    while queue:
        place = queue.popleft()
        for following in flow.after[place]:
            known = len(found[following])
            if not _is_point(flow, following):
                found[following].update(found[place])
            if len(found[following]) > known:
                queue.append(following)
    return found


def _is_point(flow: Flow, place: Place) -> bool:
    node = flow.graph.node.get(place.node)
    if node is None or place.frame is not None or not node.block.accepts >= _FIRST:
        return False
    return node.block.allocates or (node.block.holds and not place.facts.allocated)


def _is_over(place: Place) -> bool:
    """Is nothing left to fly?"""
    return place.status is Status.COMPLETED
