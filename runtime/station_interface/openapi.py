"""The description of the HTTP interface in OpenAPI 3.1, from its declaration."""

from __future__ import annotations

import ast
import inspect
from collections.abc import Iterator, Mapping
from itertools import pairwise
from typing import Any, get_type_hints, is_typeddict

import msgspec

# isort: split
from pluto_fleet.station import wire, wire_app
from pluto_fleet.station.interface import Interface
from pluto_fleet.station.operation import JSON, Operation, operations_of
from pluto_fleet.station.wire import Said

Schema = dict[str, Any]

EXTENDED = ("PlanMission", "PlanTrip")
"""Types whose objects have the fields of the app, too."""

_ABOUT = """The ground station of an app. Times are seconds since a flight began unless a name ends in `_at`,
which is in milliseconds since 1970; places are in metres, batteries from 0 to 1.

`/api/live` is a WebSocket, too: the client sends a `LiveRequest` and is sent a `LiveMessage`, again and again."""
_FLY = "The token that the station prints first, if it can be reached from other machines."
_WATCH = "The token for watching, which the station prints second."
_CONFLICT = (
    "It cannot be done now, for this reason; or what was changed has changed meanwhile: the newest."
)
_REFUSED = "Why it was refused; nothing was changed."
_MARK = {
    "name": "X-Pluto",
    "in": "header",
    "required": True,
    "description": "What a page of another site cannot send.",
    "schema": {"enum": ["1"]},
}


def description() -> Schema:
    """Return the whole description."""
    paths: dict[str, Schema] = {}
    for one in operations_of(Interface).values():
        paths.setdefault(one.path, {})[one.method.lower()] = _operation(one)
    return {
        "openapi": "3.1.0",
        "info": {"title": "Pluto ground station", "version": "1", "description": _ABOUT},
        "paths": paths,
        "components": {
            "schemas": dict(sorted(_schemas())),
            "securitySchemes": {
                "fly": {"type": "http", "scheme": "bearer", "description": _FLY},
                "watch": {"type": "http", "scheme": "bearer", "description": _WATCH},
            },
        },
    }


def _schemas() -> Iterator[tuple[str, Schema]]:
    """Yield the schema of each type of the wire, with what is said of each key below it."""
    kinds = {
        name: kind
        for module in (wire, wire_app)
        for name, kind in vars(module).items()
        if is_typeddict(kind)
    }
    _, found = msgspec.json.schema_components(kinds.values(), ref_template=_REFERENCE)
    said = {**_said(wire), **_said(wire_app)}
    for name, schema in found.items():
        del schema["title"]
        known = schema["properties"]
        schema["properties"] = {
            key: known[key] for key in get_type_hints(kinds[name])
        }  # as written
        for key, one in known.items():
            if (name, key) in said:
                one["description"] = said[name, key]
        schema["additionalProperties"] = name in EXTENDED
        yield name, schema


_REFERENCE = "#/components/schemas/{name}"


def _said(module: Any) -> Mapping[tuple[str, str], str]:
    """Return the docstrings below the keys of the types of a module."""
    return {
        (kind.name, key.target.id): inspect.cleandoc(text)
        for kind in ast.parse(inspect.getsource(module)).body
        if isinstance(kind, ast.ClassDef)
        for key, below in pairwise(kind.body)
        if isinstance(key, ast.AnnAssign) and isinstance(key.target, ast.Name)
        if isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant)
        if isinstance(text := below.value.value, str)
    }


def _operation(one: Operation) -> Schema:
    answers: Schema = {"200": {"description": "What was asked.", "content": _content(one)}}
    if one.method != "GET":
        stale = [_schema(kind) for kind in (one.stale, Said) if kind is not None]
        content = {JSON: {"schema": {"anyOf": stale}}}
        answers["409"] = {"description": _CONFLICT, "content": content}
    answers["default"] = {"description": _REFUSED, "content": {JSON: {"schema": _schema(Said)}}}
    summary, _, more = one.says.partition("\n\n")
    found: Schema = {
        "operationId": one.name,
        "summary": summary,
        **({"description": more} if more else {}),
        "security": [{"fly": []}, *([{"watch": []}] if one.role == "watch" else [])],
        "parameters": [
            *(
                {"name": name, "in": "path", "required": True, "schema": {"type": "string"}}
                for name in one.in_path
            ),
            *(
                {
                    "name": name,
                    "in": "query",
                    "required": name not in one.defaults,
                    "schema": _schema(kind),
                }
                for name, kind in one.query.items()
            ),
        ],
        "responses": answers,
    }
    if one.method != "GET":
        found["parameters"].append(_MARK)
    if one.body is not None or one.takes:
        body: Schema = {"type": "string"}
        if one.body is not None:
            body = {
                "type": "object",
                "properties": {name: _schema(kind) for name, kind in one.body.items()},
                "required": [name for name in one.body if name not in one.defaults],
                "additionalProperties": False,
            }
        content = {media: {"schema": body} for media in one.takes or (JSON,)}
        found["requestBody"] = {"required": True, "content": content}
    return found


def _content(one: Operation) -> Schema:
    return {
        one.media: {"schema": _schema(one.answers) if one.media == JSON else {"type": "string"}}
    }


def _schema(kind: Any) -> Schema:
    [found], _ = msgspec.json.schema_components([kind], ref_template=_REFERENCE)
    return found
