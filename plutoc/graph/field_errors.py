"""What can be wrong with the fields of an app's own (P1)."""

from __future__ import annotations

from plutoc.diagnostic import Diagnostic, Related, error
from plutoc.graph.model import Node
from plutoc.source import Source
from plutoc.syntax.tree import Name
from plutoc_runtime.domain.fields import Entity


def taken_field(source: Source, name: Name, on: Entity) -> Diagnostic:
    """A field with the name of what missions or trips have in every app."""
    return error(
        "P1050",
        f"a field of {on.value}s cannot be named `{name.text}`: every {on.value} has that already",
        source,
        name.span,
        label="choose another name",
    )


def field_of_a_block(source: Source, name: Name, on: Entity, node: Node) -> Diagnostic:
    """A field with the name of one that a block of the graph brings."""
    return error(
        "P1051",
        f"`{node.name}` brings {on.value}s a field `{name.text}` already",
        source,
        name.span,
        label="declared once more",
        related=(Related(source, node.name_span, f"{node.block.name} brings it"),),
        help="remove this declaration to use that field, or choose another name",
    )
