"""Further addresses of a station: what they take, and the request that their handlers are given."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from ...shared.domain.errors import BadInput
from ..commands import Malformed
from . import refusals
from .http import Reply, json_reply
from .http import said as in_words
from .refusals import Refused
from .strict_json import parsed_object

if TYPE_CHECKING:
    from ..map.drawn import DrawnMap
    from ..map.ways import DrawnWays
    from ..plan.library import PlanLibrary
    from ..plan.plan import MissionPlan
    from .audit import Audit
    from .http import Request

JSON = "application/json"
_LONGEST_ID = 64
ME = "x-pluto-me"
"""The header by which a browser says which it is: what it changes, it alone can undo."""


class DrawnStation(Protocol):
    """What further addresses need of a station."""

    plan: MissionPlan
    map: DrawnMap
    ways: DrawnWays
    library: PlanLibrary


@dataclass(frozen=True, slots=True, kw_only=True)
class Asked:
    """A request that was let in, with its body."""

    station: DrawnStation
    audit: Audit
    request: Request
    given: dict[str, object]
    """The object in a body of JSON; empty for other bodies."""
    body: bytes


Do = Callable[[Asked], Awaitable[Reply]]


@dataclass(frozen=True, slots=True, kw_only=True)
class Address:
    """What is done at an address by one method."""

    do: Do
    media: tuple[str, ...] = ()
    """The media types of its body; none: there is no body."""


Addresses = Mapping[str, Mapping[str, Address]]
"""By path and method."""


async def answered(
    address: Address, station: DrawnStation, audit: Audit, request: Request
) -> Reply:
    """Read a request's body, and hand it to its handler."""
    body, given = b"", dict[str, object]()
    if address.media:
        sent = request.headers.get("content-type", "").partition(";")[0].strip().lower()
        if sent not in address.media:
            raise Refused(refusals.wrong_type(" or ".join(address.media)))
        body = await request.read()
        if sent == JSON:
            given = parsed_object(body)
    return await address.do(
        Asked(station=station, audit=audit, request=request, given=given, body=body)
    )


def browser(request: Request) -> str:
    """Return which browser asks; empty: it does not say."""
    given = request.headers.get(ME, "").strip()
    if len(given) > _LONGEST_ID or not (given.isascii() and given.isprintable()):
        raise Malformed(f"{ME} must be a text of at most {_LONGEST_ID} ASCII characters")
    return given


def taken(given: dict[str, object], name: str, kind: type, otherwise: object = ...) -> object:
    """Take a value of this type out of a body; `otherwise` stands for one that is missing."""
    value = given.pop(name, otherwise)
    if value is ... or (value is not otherwise and type(value) is not kind):
        words = {int: "a whole number", str: "a text", bool: "true or false"}
        raise Malformed(f"{name} must be {words[kind]}")
    return value


def nothing_else(given: Mapping[str, object]) -> None:
    """Refuse a body that has more in it."""
    if given:
        raise Malformed("what was sent has more in it than is known here")


async def changed(
    asked: Asked,
    change: Callable[[], Awaitable[object]],
    newest: Callable[[], Awaitable[object]],
    stale: type[Exception],
    impossible: int = 409,
) -> Reply:
    """Change something, log that, and answer with the newest of it: as 409 if the change was made on an old one."""
    status, said = 200, ""
    try:
        await change()
    except stale:
        status = 409
    except Malformed:
        raise
    except BadInput as error:
        status, said = impossible, str(error)
    asked.audit.done(asked.request, {**asked.request.query, **asked.given}, status, said)
    return in_words(status, said) if said else json_reply(status, await newest())
