"""What people enter: fields of missions and trips that blocks bring in."""

from __future__ import annotations

from collections.abc import Iterator

from plutoc.diff.both import Both
from plutoc.diff.model import Change
from plutoc.diff.words import declared as words
from plutoc.graph.model import Graph, Node
from plutoc_runtime.domain.fields import Entity, Field

_Fields = dict[tuple[Entity, str], tuple[Field, Node]]


def fields(both: Both) -> Iterator[Change]:
    """Tell which fields missions files may have now, and which no more."""
    before, after = _fields(both.old.graph), _fields(both.new.graph)
    for on in Entity:
        more = [one for key, one in after.items() if key not in before and key[0] is on]
        if more:
            yield words.fields_added(on, more)
        less = [one for key, one in before.items() if key not in after and key[0] is on]
        if less:
            yield words.fields_removed(on, less)


def _fields(graph: Graph) -> _Fields:
    found: _Fields = {}
    for node in graph.nodes:
        for field in node.block.needs:
            found.setdefault((field.on, field.name), (field, node))
    return found
