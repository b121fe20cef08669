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
    onward = _onward(count, ways)
    depth = _depths(count, onward)
    found: list[list[int]] = [[] for _ in range(max(depth, default=-1) + 1)]
    for box in range(count):
        found[depth[box]].append(box)
    _untangle(found, onward)
    return [layer for layer in found if layer]


def _onward(count: int, ways: Ways) -> list[tuple[int, int]]:
    """Return the ways that close no loop, found by walking from the first box."""
    leaving: list[list[int]] = [[] for _ in range(count)]
    for source, target in ways:
        leaving[source].append(target)
    begun, ended = [False] * count, [False] * count
    kept: list[tuple[int, int]] = []
    for first in range(count):
        if begun[first]:
            continue
        begun[first] = True
        path = [(first, iter(leaving[first]))]
        while path:
            box, rest = path[-1]
            target = next(rest, -1)
            if target < 0:
                ended[box] = True
                path.pop()
            elif ended[target]:
                kept.append((box, target))
            elif not begun[target]:
                begun[target] = True
                kept.append((box, target))
                path.append((target, iter(leaving[target])))
    return list(dict.fromkeys(kept))


def _depths(count: int, onward: Ways) -> list[int]:
    """Return the length of the longest way to each box."""
    depth, waiting = [0] * count, [0] * count
    leaving: list[list[int]] = [[] for _ in range(count)]
    for source, target in onward:
        leaving[source].append(target)
        waiting[target] += 1
    ready = [box for box in range(count) if not waiting[box]]
    for box in ready:
        for target in leaving[box]:
            depth[target] = max(depth[target], depth[box] + 1)
            waiting[target] -= 1
            if not waiting[target]:
                ready.append(target)
    return depth


def _untangle(found: list[list[int]], onward: Ways) -> None:
    """Put each box near the middle of those that it is joined with, again and again."""
    before: dict[int, list[int]] = {}
    after: dict[int, list[int]] = {}
    for source, target in onward:
        before.setdefault(target, []).append(source)
        after.setdefault(source, []).append(target)
    at: dict[int, float] = {}
    for layer in found:
        at.update(_spread(layer))
    for sweep in range(_SWEEPS):
        joined = before if sweep % 2 == 0 else after
        for layer in found if sweep % 2 == 0 else reversed(found):
            wanted = {
                box: _middle([at[one] for one in joined.get(box, ())], at[box]) for box in layer
            }
            layer.sort(key=wanted.__getitem__)
            at.update(_spread(layer))


def _spread(layer: list[int]) -> dict[int, float]:
    return {box: number - (len(layer) - 1) / 2 for number, box in enumerate(layer)}


def _middle(places: list[float], otherwise: float) -> float:
    return sum(places) / len(places) if places else otherwise
