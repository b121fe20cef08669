"""Which boxes come one after the other: a layer is what can be met after so many steps."""

from __future__ import annotations

from collections.abc import Sequence

Ways = Sequence[tuple[int, int]]
"""From which box to which, by their numbers."""

_SWEEPS = 6


def layers(count: int, ways: Ways) -> list[list[int]]:
    """Return the boxes layer by layer, each layer in an order in which few ways cross.

    A way that leads back to a box before it does not count; all others lead to a later layer.
    """
    leaving, before, after = ([list[int]() for _ in range(count)] for _ in range(3))
    for source, target in ways:
        leaving[source].append(target)
    met: set[int] = set()
    left: dict[int, int] = {}
    """How many steps there are to each box from which all ways were gone, the last one first."""

    def walk(box: int) -> None:
        met.add(box)
        for target in leaving[box]:
            if target not in met:
                walk(target)
            if target in left:
                after[box].append(target)
                before[target].append(box)
        left[box] = 0

    for box in range(count):
        if box not in met:
            walk(box)
    found: list[list[int]] = [[] for _ in range(count)]
    for box in reversed(list(left)):
        found[left[box]].append(box)
        for target in after[box]:
            left[target] = max(left[target], left[box] + 1)
    return _untangled([sorted(layer) for layer in found if layer], before, after)


def _untangled(
    found: list[list[int]], before: list[list[int]], after: list[list[int]]
) -> list[list[int]]:
    """Return the layers with each box near the middle of those that it is joined with."""
    at = {box: place for layer in found for box, place in _spread(layer)}
    for joined, order in ((before, found), (after, found[::-1])) * (_SWEEPS // 2):
        for layer in order:
            for box in layer:
                if joined[box]:
                    at[box] = sum(at[one] for one in joined[box]) / len(joined[box])
            layer.sort(key=at.__getitem__)
            at.update(_spread(layer))
    return found


def _spread(layer: list[int]) -> list[tuple[int, float]]:
    return [(box, place - (len(layer) - 1) / 2) for place, box in enumerate(layer)]
