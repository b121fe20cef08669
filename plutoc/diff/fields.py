"""What people enter: fields of missions and trips that blocks bring in."""

from __future__ import annotations

from collections.abc import Iterator

from plutoc.diff.both import Both
from plutoc.diff.model import Change
from plutoc.diff.words import declared as words
from plutoc.graph.model import Graph, Node
from plutoc_runtime.fields import Entity, Field

_Fields = dict[tuple[Entity, str], tuple[Field, Node]]


def fields(both: Both) -> Iterator[Change]:
    """Tell which fields missions files may have now, and which no more."""
    before, after = _fields(both.old.graph), _fields(both.new.graph)
    for key, (field, node) in after.items():
        if key not in before:
            yield words.field_added(field, node)
    for key, (field, node) in before.items():
        if key not in after:
            yield words.field_removed(field, node)


def _fields(graph: Graph) -> _Fields:
    found: _Fields = {}
    for node in graph.nodes:
        for field in node.block.needs:
            found.setdefault((field.on, field.name), (field, node))
    return found
