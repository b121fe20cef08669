"""Ways round in a graph on which nothing is flown: there a mission finds all as it was before."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from plutoc.check.components import loops
from plutoc.graph.model import END, Edge, Graph


def unflown(graph: Graph, edges: Iterable[Edge]) -> Mapping[str, int]:
    """Return the blocks of such ways round; those with one number lead to each other and back.

    Nearly every way round in an app leads to its next launch, so that hardly any is left.
    """
    after: dict[str, list[str]] = {node.name: [] for node in graph.nodes if not node.block.launches}
    for edge in edges:
        if edge.source in after and edge.target != END:
            after[edge.source].append(edge.target)
    return {name: number for number, part in enumerate(loops(after), 1) for name in part}
