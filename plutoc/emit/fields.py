"""The fields that missions and trips have because of the blocks in the graph."""

from __future__ import annotations

from plutoc.emit.modules import EmbedError
from plutoc.graph.model import Graph
from plutoc_runtime.domain.fields import PYTHON, Entity, Field


def fields_of(graph: Graph) -> tuple[Field, ...]:
    """Return every field once: missions' before trips', each in the order of the blocks."""
    found: dict[tuple[Entity, str], Field] = {}
    for node in graph.nodes:
        for field in node.block.needs:
            same = found.setdefault((field.on, field.name), field)
            if same.type is not field.type:
                raise EmbedError(
                    f"two blocks of the graph want different things of a {field.on.value}'s "
                    f"{field.name}: {same.type.value} and {field.type.value} ({node.name})"
                )
    return tuple(field for entity in Entity for field in found.values() if field.on is entity)


def python_type(field: Field) -> str:
    """Return the annotation of a field."""
    written = PYTHON[field.type]
    optional = field.default is None and "None" not in written
    return f"{written} | None" if optional else written
