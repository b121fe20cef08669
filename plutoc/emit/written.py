"""Parts of a declaration as a package's modules write them."""

from __future__ import annotations

from plutoc.emit.python import call, literal
from plutoc.graph.model import Parameter


def parameter(one: Parameter) -> str:
    """Return a parameter of an action, or a field of an event."""
    arguments = [f"name={literal(one.name)}", f"type=Type.{one.type.name}"]
    if one.default is not None:
        arguments.append(f"default={literal(one.default)}")
    return call("Parameter", arguments)
