"""What handlers take out of a body, and how a change is answered."""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping

from ...shared.domain.errors import BadInput
from ..commands import Malformed
from .http import Reply, json_reply
from .http import said as in_words
from .served import Asked


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
