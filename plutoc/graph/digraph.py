"""Graph algorithms of networkx, with results in the order of the graph's own vertices.

Networkx returns sets, whose order differs in each run.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import networkx as nx

Vertex = Any
"""Networkx has no types."""
Vertices = tuple[Vertex, ...]


def subgraph(graph: nx.DiGraph, vertices: Iterable[Vertex]) -> nx.DiGraph:
    """Return some vertices, in this order, with the edges between them."""
    part = nx.DiGraph()
    part.add_nodes_from(vertices)
    part.add_edges_from([(v, target) for v in part for target in graph[v] if target in part])
    return part


def reachable(graph: nx.DiGraph, beginnings: Iterable[Vertex]) -> set[Vertex]:
    """Return all that can be reached from some vertices, themselves included."""
    return {vertex for layer in nx.bfs_layers(graph, list(beginnings)) for vertex in layer}


def components(graph: nx.DiGraph) -> tuple[Vertices, ...]:
    """Return the strongly connected components, sorted by their first vertex."""
    return _sorted(graph, nx.strongly_connected_components(graph))


def loops(graph: nx.DiGraph) -> tuple[Vertices, ...]:
    """Return the components with a cycle."""
    parts = nx.strongly_connected_components(graph)
    return _sorted(graph, (part for part in parts if len(part) > 1 or _is_loop(graph, *part)))


def endless_loops(graph: nx.DiGraph) -> tuple[Vertices, ...]:
    """Return the loops without an exit."""
    parts = nx.attracting_components(graph)
    return _sorted(graph, (part for part in parts if len(part) > 1 or _is_loop(graph, *part)))


def round_of(graph: nx.DiGraph, loop: Iterable[Vertex], head: Vertex) -> Vertices:
    """Return the shortest cycle through a vertex of a loop, which comes first."""
    inside = subgraph(graph, loop)
    ways = (nx.shortest_path(inside, vertex, head) for vertex in inside.successors(head))
    return (head, *min(ways, key=len)[:-1])


def _is_loop(graph: nx.DiGraph, vertex: Vertex) -> bool:
    """Return whether a vertex has an edge to itself."""
    return bool(graph.has_edge(vertex, vertex))


def _sorted(graph: nx.DiGraph, parts: Iterable[set[Vertex]]) -> tuple[Vertices, ...]:
    place = {vertex: index for index, vertex in enumerate(graph)}
    ordered = (tuple(sorted(part, key=place.__getitem__)) for part in parts)
    return tuple(sorted(ordered, key=lambda part: place[part[0]]))
