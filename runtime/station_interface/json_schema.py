"""The JSON Schema of the types of a module: typed dictionaries, with what is said of each key."""

from __future__ import annotations

import ast
import inspect
from functools import cache
from itertools import pairwise
from types import NoneType, UnionType
from typing import (
    Any,
    Literal,
    NotRequired,
    Union,
    get_args,
    get_origin,
    get_type_hints,
    is_typeddict,
)

Schema = dict[str, Any]

_PLAIN = {str: "string", int: "integer", float: "number", bool: "boolean", NoneType: "null"}
_REFERENCE = "#/components/schemas/"


def schema_of(kind: Any, known: dict[str, Schema], extended: tuple[type, ...] = ()) -> Schema:
    """Return the schema of a type, and add to `known` those of the typed dictionaries in it.

    Objects of the `extended` types may have more keys than these.
    """
    origin, arguments = get_origin(kind), get_args(kind)
    if is_typeddict(kind):
        if kind.__name__ not in known:
            known[kind.__name__] = {}  # it may lead back to itself
            known[kind.__name__] = _object(kind, known, extended)
        return {"$ref": _REFERENCE + kind.__name__}
    if kind in (Any, object):
        return {}
    if kind in _PLAIN:
        return {"type": _PLAIN[kind]}
    if origin is Literal:
        return {"enum": list(arguments)}
    if origin in (Union, UnionType):
        return {"anyOf": [schema_of(one, known, extended) for one in arguments]}
    if origin is list:
        return {"type": "array", "items": schema_of(arguments[0], known, extended)}
    if origin is dict and arguments[0] is str:
        return {
            "type": "object",
            "additionalProperties": schema_of(arguments[1], known, extended),
        }
    raise TypeError(f"no schema is known for {kind}")


def _object(kind: Any, known: dict[str, Schema], extended: tuple[type, ...]) -> Schema:
    hints, said, optional = get_type_hints(kind, include_extras=True), _said(kind), set()
    properties = {}
    for name, hint in hints.items():
        if get_origin(hint) is NotRequired:
            optional.add(name)
            hint = get_args(hint)[0]
        schema = schema_of(hint, known, extended)
        properties[name] = schema | ({"description": said[name]} if name in said else {})
    return {
        "type": "object",
        "description": inspect.getdoc(kind) or "",
        "properties": properties,
        "required": [name for name in hints if name not in optional],
        "additionalProperties": kind in extended,
    }


def _said(kind: Any) -> dict[str, str]:
    """Return the docstrings below the keys of a type, and of those that it extends."""
    bases = getattr(kind, "__orig_bases__", ())
    said = {key: text for base in bases if is_typeddict(base) for key, text in _said(base).items()}
    [body] = (one.body for one in _classes(inspect.getmodule(kind)) if one.name == kind.__name__)
    for key, below in pairwise(body):
        match key, below:
            case ast.AnnAssign(target=ast.Name(id=name)), ast.Expr(ast.Constant(str(text))):
                said[name] = inspect.cleandoc(text)
    return said


@cache
def _classes(module: Any) -> list[ast.ClassDef]:
    return [
        one for one in ast.parse(inspect.getsource(module)).body if isinstance(one, ast.ClassDef)
    ]
