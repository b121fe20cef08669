"""Further addresses of a station: what each method of one does, and how it answers."""

from __future__ import annotations

import json
from collections.abc import Awaitable, Callable, Mapping
from contextlib import suppress

from ...shared.domain.errors import BadInput
from ..commands import Malformed
from . import refusals
from .audit import Audit
from .http import Reply, Request, said
from .refusals import Refused
from .strict_json import parsed_object

Handler = Callable[[Request], Awaitable[Reply]]
"""Answers a request; `BadInput` says why it cannot be done."""

Address = Mapping[str, Handler]
"""The handlers of an address, by their methods."""

Addresses = Mapping[str, Address]

_LONGEST_ID = 64

ME = "x-pluto-me"
"""The header by which a browser says which it is: its changes can be undone by it alone."""


async def answered(address: Address, request: Request, audit: Audit) -> Reply:
    """Answer a request, and log what it was to change."""
    try:
        reply = await address[request.method](request)
    except Malformed:
        raise
    except BadInput as error:
        reply = said(400, str(error))
    if request.method != "GET":
        why = ""
        if reply.status != 200:
            with suppress(ValueError, AttributeError):  # the newest data, instead of a sentence
                why = str(json.loads(reply.body).get("said", ""))
        audit.done(request, dict(request.query), reply.status, why)
    return reply


async def json_body(request: Request) -> dict[str, object]:
    """Read a body that must be an object."""
    check_type(request, "application/json")
    return parsed_object(await request.read())


def check_type(request: Request, *wanted: str) -> None:
    """Refuse a body of another type: a page of another site can send few."""
    given = request.headers.get("content-type", "").partition(";")[0].strip().lower()
    if given not in wanted:
        raise Refused(refusals.wrong_type(" or ".join(wanted)))


def me(request: Request) -> str:
    """Return which browser asks; empty: it does not say."""
    given = request.headers.get(ME, "")
    if len(given) > _LONGEST_ID or not (given.isascii() and given.isprintable()):
        raise Malformed(f"{ME} must be a text of at most {_LONGEST_ID} ASCII characters")
    return given.strip()


def taken(given: dict[str, object], name: str, kind: type, otherwise: object = ...) -> object:
    """Take a value of this type out of a body; `otherwise` stands for one that is missing."""
    value = given.pop(name, otherwise)
    if value is ... or (value is not otherwise and type(value) is not kind):
        words = {int: "a whole number", str: "a text", bool: "true or false", list: "a list"}
        raise Malformed(f"{name} must be {words[kind]}")
    return value


def nothing_else(given: Mapping[str, object]) -> None:
    """Refuse a body that has more in it."""
    if given:
        raise Malformed("what was sent has more in it than is known here")
