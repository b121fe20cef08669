"""Where blocks stand that were not moved by hand, in the editor and the station: layers from top to bottom, with few crossings.

Blocks are wide and low, so a window shows twice as many layers one below the other as side by side.

The result depends on the graph alone, and ties keep the order of the source: so a further block moves
those behind it, and leaves the rest where it was.
"""

from __future__ import annotations

from bisect import bisect_right, insort
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import lru_cache

import networkx as nx

from plutoc.graph.model import END, START

Point = tuple[int, int]
Positions = Mapping[str, Point]

WIDTH, HEIGHT, GRID = 176, 52, 8
"""A block's size, and what positions are multiples of."""
_INSET = 40
"""`start`, `end` and events are narrower by this at both sides."""
_LAYER, _COLUMN, _LANE = 120, 224, 40
"""From a layer to the next one; from a box to the one beside; for an edge that passes a layer."""
_BETWEEN = 64
"""Between parts of a graph that no edge joins."""
_SWEEPS, _SETTLE = 8, 4
_LONGEST = 6
"""Layers that an edge passes in a lane of its own; a longer one goes around, as one that leads back."""

Ways = Sequence[tuple[str, str]]
_Spot = str | tuple[int, int]
"""A box by its name, or where an edge passes a layer: the edge's number, and the layer's."""


def laid_out(
    names: Sequence[str], ways: Ways, moved: Positions, events: Sequence[str] = ()
) -> dict[str, Point]:
    """Return the upper left corner of every block and event, and of `start` and `end`."""
    found = _automatic((*events, *names), tuple(ways))
    for name in events:
        x, y = found[name]
        found = {**found, name: (x + _INSET, y)}
    boxes = [moved[name] for name in found if name in moved]
    return {
        name: moved[name] if name in moved else _beside(spot, boxes) for name, spot in found.items()
    }


@lru_cache(maxsize=8)  # most changes of a text do not change its graph
def _automatic(names: tuple[str, ...], ways: tuple[tuple[str, str], ...]) -> dict[str, Point]:
    found: dict[str, Point] = {}
    left = 0
    for part in _parts((START, *names, END), ways):
        inside = set(part)
        within = [way for way in dict.fromkeys(ways) if way[0] in inside and way[0] != way[1]]
        placed, right = _placed(part, within, left)
        found |= placed
        left = -(-(right + _BETWEEN) // GRID) * GRID
    return found


def _beside(spot: Point, boxes: Iterable[Point]) -> Point:
    """Return the first free place below, where boxes stand that were moved by hand."""
    x, y = spot
    for _, taken in sorted((b for b in boxes if abs(b[0] - x) < WIDTH), key=lambda b: b[1]):
        if abs(taken - y) < HEIGHT:
            y = taken + HEIGHT + GRID * 5
    return x, y


def _parts(names: Sequence[str], ways: Ways) -> list[list[str]]:
    """Return what edges join, `start` and `end` always together, in the order of the source.

    What hangs on nothing comes last, all in one part.
    """
    joined = nx.DiGraph()
    joined.add_nodes_from(names)
    joined.add_edges_from([*ways, (START, END)])
    parts = list(nx.weakly_connected_components(joined))
    loose = [name for part in parts if len(part) == 1 for name in part]
    found = [[name for name in names if name in part] for part in parts if len(part) > 1]
    return [*found, loose] if loose else found


def _placed(part: Sequence[str], ways: Ways, left: int) -> tuple[dict[str, Point], int]:
    """Return the positions within one part, and where it ends."""
    if not ways and START not in part:  # in rows
        deep = 6
        spots = {
            name: (left + place // deep * _COLUMN, (1 + place % deep) * _LAYER)
            for place, name in enumerate(part)
        }
        return spots, max(x for x, _ in spots.values()) + WIDTH
    layer = _layers(part, ways)
    layers, above, below = _with_passages(layer, ways)
    _untangle(layers, above, below)
    at = _across(layers, above, below)
    least = min(at.values(), default=0.0)
    spots = {
        name: (
            left + round((at[name] - least) / GRID) * GRID + _INSET * (name in (START, END)),
            layer[name] * _LAYER,
        )
        for name in part
    }
    return spots, max(x for x, _ in spots.values()) + WIDTH


def _layers(part: Sequence[str], ways: Ways) -> dict[str, int]:
    """Return each box's layer: every edge leads to a later one, but for those that lead back."""
    entered = {target for _, target in ways}
    roots = [name for name in part if name not in entered and name != END]
    joined = nx.DiGraph()
    joined.add_nodes_from([*roots, *part])
    joined.add_edges_from(ways)
    order = [*nx.dfs_postorder_nodes(joined)][::-1]
    place = {box: number for number, box in enumerate(order)}
    layer = dict.fromkeys(part, 0)
    for box in order:
        for target in joined[box]:
            if place[target] > place[box]:
                layer[target] = max(layer[target], layer[box] + 1)
    if END in layer:  # nothing stands behind it
        layer[END] = max(layer[END], max(layer.values()), 1)
        if any(other == layer[END] for name, other in layer.items() if name != END):
            layer[END] += 1
    return layer


_Near = Mapping[_Spot, Sequence[_Spot]]


def _with_passages(
    layer: Mapping[str, int], ways: Ways
) -> tuple[list[list[_Spot]], dict[_Spot, list[_Spot]], dict[_Spot, list[_Spot]]]:
    """Return the layers, with a spot for every edge that passes one, and each spot's neighbours."""
    layers: list[list[_Spot]] = [[] for _ in range(max(layer.values()) + 1)]
    for name, number in layer.items():
        layers[number].append(name)
    before: defaultdict[_Spot, list[_Spot]] = defaultdict(list)
    after: defaultdict[_Spot, list[_Spot]] = defaultdict(list)
    for number, (source, target) in enumerate(ways):
        if not 0 < layer[target] - layer[source] <= _LONGEST:
            continue
        spot: _Spot = source
        for between in range(layer[source] + 1, layer[target] + 1):
            following: _Spot = target if between == layer[target] else (number, between)
            if following != target:
                layers[between].append(following)
            after[spot].append(following)
            before[following].append(spot)
            spot = following
    return layers, before, after


def _untangle(layers: list[list[_Spot]], before: _Near, after: _Near) -> None:
    """Sort each layer by the middle of its neighbours' places, forth and back."""
    place = {spot: float(i) for layer in layers for i, spot in enumerate(layer)}
    best, fewest = [list(layer) for layer in layers], _crossings(layers, after, place)
    for sweep in range(_SWEEPS):
        near, order = (before, layers) if sweep % 2 == 0 else (after, layers[::-1])
        for layer in order:
            middle = {
                spot: _mean([place[one] for one in near.get(spot, ())], place[spot])
                for spot in layer
            }
            layer.sort(key=middle.__getitem__)
            place.update((spot, float(i)) for i, spot in enumerate(layer))
        count = _crossings(layers, after, place)
        if count < fewest:
            best, fewest = [list(layer) for layer in layers], count
    for layer, kept in zip(layers, best, strict=True):
        layer[:] = kept


def _crossings(layers: list[list[_Spot]], after: _Near, place: Mapping[_Spot, float]) -> int:
    """Count the crossings between neighbouring layers."""
    found = 0
    for layer in layers:
        passed: list[float] = []
        for spot in layer:
            targets = [place[one] for one in after.get(spot, ())]
            found += sum(len(passed) - bisect_right(passed, target) for target in targets)
            for target in targets:
                insort(passed, target)
    return found


def _across(layers: list[list[_Spot]], before: _Near, after: _Near) -> dict[_Spot, float]:
    """Return how far to the right each spot is: as straight as may be, in the order of its layer."""
    at: dict[_Spot, float] = {}
    for layer in layers:
        x = 0.0
        for spot in layer:
            at[spot] = x
            x += _room(spot)
    for sweep in range(_SETTLE * 2):
        near, order = (before, layers) if sweep % 2 == 0 else (after, layers[::-1])
        for layer in order:
            wanted = [_mean([at[one] for one in near.get(spot, ())], at[spot]) for spot in layer]
            at.update(zip(layer, _apart(layer, wanted), strict=True))
    return at


def _room(spot: _Spot) -> float:
    return _COLUMN if isinstance(spot, str) else _LANE


def _apart(layer: Sequence[_Spot], wanted: Sequence[float]) -> Iterator[float]:
    """Yield the places nearest to the wanted ones that leave every spot its room.

    Neighbours that want to overlap are put in a block whose middle is where they want it on average.
    """
    offsets, sum_of = [], 0.0
    for spot in layer:
        offsets.append(sum_of)
        sum_of += _room(spot)
    blocks: list[tuple[float, int]] = []
    for place, offset in zip(wanted, offsets, strict=True):
        total, count = place - offset, 1
        while blocks and blocks[-1][0] / blocks[-1][1] > total / count:
            more, others = blocks.pop()
            total, count = total + more, count + others
        blocks.append((total, count))
    starts = (total / count for total, count in blocks for _ in range(count))
    return (start + offset for start, offset in zip(starts, offsets, strict=True))


def _mean(values: Sequence[float], otherwise: float) -> float:
    return sum(values) / len(values) if values else otherwise
