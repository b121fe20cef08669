"""The description of the HTTP interface in OpenAPI 3.1, from the table of addresses."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, is_typeddict

from pluto_fleet.station import wire
from pluto_fleet.station.requests import Said
from pluto_fleet.station.web.addresses import ADDRESSES, JSON, Address
from pluto_fleet.station.wire_app import PlanMission, PlanTrip

from .json_schema import Schema, schema_of

EXTENDED = (PlanMission, PlanTrip)
"""Types whose objects have the fields of the app, too."""

BESIDE = [kind for kind in vars(wire).values() if is_typeddict(kind)]
"""What goes over a WebSocket, or in parts of other answers, is described though no address names it."""

_ABOUT = """The ground station of an app. Times are seconds since a flight began unless a name ends in `_at`,
which is in milliseconds since 1970; places are in metres, batteries from 0 to 1.

`/api/live` is a WebSocket, too: the client sends a `LiveRequest` and is sent a `LiveMessage`, again and again."""


def description(addresses: Sequence[Address] = ADDRESSES) -> Schema:
    """Return the whole description."""
    known: dict[str, Schema] = {}
    for kind in BESIDE:
        schema_of(kind, known, EXTENDED)
    paths: dict[str, dict[str, Any]] = {}
    for address in addresses:
        paths.setdefault(address.path, {})[address.method.lower()] = _operation(address, known)
    return {
        "openapi": "3.1.0",
        "info": {"title": "Pluto ground station", "version": "1", "description": _ABOUT},
        "paths": paths,
        "components": {
            "schemas": dict(sorted(known.items())),
            "securitySchemes": {
                "fly": {"type": "http", "scheme": "bearer", "description": _FLY},
                "watch": {"type": "http", "scheme": "bearer", "description": _WATCH},
            },
        },
    }


_FLY = "The token that the station prints first, if it can be reached from other machines."
_WATCH = "The token for watching, which the station prints second."


def _operation(address: Address, known: dict[str, Schema]) -> Schema:
    answers = {
        "200": {"description": "What was asked.", "content": _content(address.answers, known)}
    }
    if address.method != "GET":
        stale = Said if address.stale is None else address.stale | Said
        answers["409"] = {"description": _CONFLICT, "content": _content(stale, known)}
    answers["default"] = {"description": _REFUSED, "content": _content(Said, known)}
    found: Schema = {
        "operationId": address.name,
        "summary": address.says,
        "security": [{"fly": []}, *([{"watch": []}] if address.role == "watch" else [])],
        "parameters": [
            {
                "name": name,
                "in": "query",
                "required": one.needed,
                "description": one.says,
                "schema": schema_of(one.type, known),
            }
            for name, one in address.query.items()
        ],
        "responses": answers,
    }
    if address.method != "GET":
        found["parameters"].append(_MARK)
    if address.body is not None:
        content = {
            media: {"schema": {"type": "string"} if isinstance(address.body, tuple) else schema}
            for schema in [_body(address, known)]
            for media in address.media
        }
        found["requestBody"] = {"required": True, "content": content}
    return found


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


def _body(address: Address, known: dict[str, Schema]) -> Schema:
    return {} if isinstance(address.body, tuple) else schema_of(address.body, known, EXTENDED)


def _content(answers: Any, known: dict[str, Schema]) -> Schema:
    if isinstance(answers, str):
        return {answers: {"schema": {"type": "string"}}}
    return {JSON: {"schema": schema_of(answers, known, EXTENDED)}}
