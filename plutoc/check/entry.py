"""Where missions come in: one block makes them, and `start` leads there and nowhere else."""

from __future__ import annotations

from plutoc.check import errors
from plutoc.diagnostic import Diagnostic
from plutoc.graph.model import START, Edge, Graph, Node


def entry(graph: Graph) -> tuple[Node | None, tuple[Edge, ...], list[Diagnostic]]:
    """Return the block that makes missions, the edges that may be walked, and what is wrong."""
    creators = [node for node in graph.nodes if node.block.creates]
    if not creators:
        return None, (), [errors.no_creator(graph)]
    started = {edge.target for edge in graph.outgoing[START]}
    creator = next((node for node in creators if node.name in started), creators[0])
    found = [errors.second_creator(graph, n, creator) for n in creators if n is not creator]
    if creator.name not in started:
        found.append(errors.no_start(graph, creator))
    edges = []
    for edge in graph.edges:
        if edge.source == START and edge.target != creator.name:
            # a second creator is wrong already, however it is reached
            if edge.target not in {node.name for node in creators}:
                found.append(errors.start_elsewhere(graph, edge, creator))
        elif edge.source != START and edge.target == creator.name:
            found.append(errors.into_creator(graph, edge, creator))
        else:
            edges.append(edge)
    return creator, tuple(edges), found
