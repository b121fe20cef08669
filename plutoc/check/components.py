"""Strongly connected parts of a walk, in a certain order.

Networkx finds them; to import it takes longer than to check an app of the usual size. So what a
linear look shows to lie on no way round is left out first, and in a sound app nothing is left.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, TypeVar

if TYPE_CHECKING:
    import networkx as nx

T = TypeVar("T")


def loops(after: Mapping[T, Iterable[T]]) -> tuple[tuple[T, ...], ...]:
    """Return the parts in which one can go round, each in the mapping's order."""
    return tuple(
        part
        for part in components(trimmed(after))
        if len(part) > 1 or part[0] in tuple(after[part[0]])
    )


def round_of(after: Mapping[T, Iterable[T]], part: Iterable[T], head: T) -> tuple[T, ...]:
    """Return the shortest way round from a vertex of a loop, which comes first."""
    import networkx as nx

    inside = digraph({vertex: after[vertex] for vertex in part})
    ways = (nx.shortest_path(inside, vertex, head) for vertex in inside.successors(head))
    return (head, *min(ways, key=len)[:-1])


def components(after: Mapping[T, Iterable[T]]) -> tuple[tuple[T, ...], ...]:
    """Return all strongly connected parts, sorted by their first vertex in the mapping."""
    if not after:
        return ()
    import networkx as nx

    place = {vertex: index for index, vertex in enumerate(after)}
    parts = nx.strongly_connected_components(digraph(after))
    ordered = (tuple(sorted(part, key=place.__getitem__)) for part in parts)
    return tuple(sorted(ordered, key=lambda part: place[part[0]]))


def digraph(after: Mapping[T, Iterable[T]]) -> nx.DiGraph:
    """Return the walk as a graph; what leads out of the mapping is left out."""
    import networkx as nx

    graph = nx.DiGraph()
    graph.add_nodes_from(after)
    graph.add_edges_from((v, w) for v, targets in after.items() for w in targets if w in after)
    return graph


def behind(after: Mapping[T, Iterable[T]], beginnings: Iterable[T]) -> dict[T, None]:
    """Return all that can be reached from some vertices, themselves included: an ordered set."""
    found = dict.fromkeys(beginnings)
    queue = list(found)
    for vertex in queue:
        fresh = dict.fromkeys(target for target in after.get(vertex, ()) if target not in found)
        found.update(fresh)
        queue.extend(fresh)
    return found


def trimmed(after: Mapping[T, Iterable[T]]) -> dict[T, tuple[T, ...]]:
    """Return what is left of a walk when all is taken away that leads nowhere, or comes from nowhere.

    That is every way round, and what lies between two of them. Takes linear time.
    """
    return _reversed(_leading_on(_reversed(_leading_on(after))))


def _leading_on(after: Mapping[T, Iterable[T]]) -> dict[T, tuple[T, ...]]:
    left = {vertex: tuple(t for t in targets if t in after) for vertex, targets in after.items()}
    before = _reversed(left)
    ways = {vertex: len(targets) for vertex, targets in left.items()}
    idle = [vertex for vertex, count in ways.items() if not count]
    for vertex in idle:
        for source in before[vertex]:
            ways[source] -= 1
            if not ways[source]:
                idle.append(source)
    return {v: tuple(t for t in targets if ways[t]) for v, targets in left.items() if ways[v]}


def _reversed(after: Mapping[T, Iterable[T]]) -> dict[T, tuple[T, ...]]:
    before: dict[T, list[T]] = {vertex: [] for vertex in after}
    for vertex, targets in after.items():
        for target in targets:
            before[target].append(vertex)
    return {vertex: tuple(sources) for vertex, sources in before.items()}
