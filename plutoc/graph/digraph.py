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
    vertices, numbers = _numbered(graph)
    return _named(vertices, nx.strongly_connected_components(numbers))


def loops(graph: nx.DiGraph) -> tuple[Vertices, ...]:
    """Return the components with a cycle."""
    return _with_a_cycle(graph, components(graph))


def endless_loops(graph: nx.DiGraph) -> tuple[Vertices, ...]:
    """Return the loops without an exit."""
    vertices, numbers = _numbered(graph)
    return _with_a_cycle(graph, _named(vertices, nx.attracting_components(numbers)))


def _numbered(graph: nx.DiGraph) -> tuple[Vertices, nx.DiGraph]:
    """Return the vertices, and the graph of their numbers: places take long to hash."""
    vertices = tuple(graph)
    number = {vertex: i for i, vertex in enumerate(vertices)}
    numbers = nx.DiGraph()
    numbers.add_nodes_from(range(len(vertices)))
    numbers.add_edges_from((number[one], number[other]) for one, other in graph.edges)
    return vertices, numbers


def _named(vertices: Vertices, parts: Iterable[set[int]]) -> tuple[Vertices, ...]:
    return tuple(tuple(vertices[i] for i in part) for part in sorted(map(sorted, parts)))


def _with_a_cycle(graph: nx.DiGraph, parts: Iterable[Vertices]) -> tuple[Vertices, ...]:
    return tuple(part for part in parts if len(part) > 1 or _is_loop(graph, *part))


def round_of(graph: nx.DiGraph, loop: Iterable[Vertex], head: Vertex) -> Vertices:
    """Return the shortest cycle through a vertex of a loop, which comes first."""
    inside = subgraph(graph, loop)
    ways = (nx.shortest_path(inside, vertex, head) for vertex in inside.successors(head))
    return (head, *min(ways, key=len)[:-1])


def _is_loop(graph: nx.DiGraph, vertex: Vertex) -> bool:
    """Return whether a vertex has an edge to itself."""
    return bool(graph.has_edge(vertex, vertex))
