"""Strongly connected parts of a walk, in a certain order."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TypeVar

import networkx as nx

T = TypeVar("T")


def loops(after: Mapping[T, Iterable[T]]) -> tuple[tuple[T, ...], ...]:
    """Return the parts in which one can go round, each in the mapping's order."""
    return tuple(
        part for part in components(after) if len(part) > 1 or part[0] in tuple(after[part[0]])
    )


def round_of(after: Mapping[T, Iterable[T]], part: Iterable[T], head: T) -> tuple[T, ...]:
    """Return the shortest way round from a vertex of a loop, which comes first."""
    inside = digraph({vertex: after[vertex] for vertex in part})
    ways = (nx.shortest_path(inside, vertex, head) for vertex in inside.successors(head))
    return (head, *min(ways, key=len)[:-1])


def components(after: Mapping[T, Iterable[T]]) -> tuple[tuple[T, ...], ...]:
    """Return all strongly connected parts, sorted by their first vertex in the mapping."""
    place = {vertex: index for index, vertex in enumerate(after)}
    parts = nx.strongly_connected_components(digraph(after))
    ordered = (tuple(sorted(part, key=place.__getitem__)) for part in parts)
    return tuple(sorted(ordered, key=lambda part: place[part[0]]))


def digraph(after: Mapping[T, Iterable[T]]) -> nx.DiGraph:
    """Return the walk as a graph; what leads out of the mapping is left out."""
    graph = nx.DiGraph()
    graph.add_nodes_from(after)
    graph.add_edges_from((v, w) for v, targets in after.items() for w in targets if w in after)
    return graph
