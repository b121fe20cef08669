"""The refusals of requests; each message says what to do."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True, slots=True)
class Refusal:
    """The answer to a refused request."""

    status: int
    said: str
    headers: Mapping[str, str] = field(default_factory=dict)


class Refused(Exception):
    """Raised to refuse a request."""

    def __init__(self, refusal: Refusal) -> None:
        super().__init__(refusal.said)
        self.refusal = refusal


HANG_UP = {"Connection": "close"}
"""The header for a request that is refused before all of it has been read."""
_SOON = {"Retry-After": "1"}

UNKNOWN_HOST = Refusal(
    403,
    "this station does not go by that name: open the address that it has printed,"
    " or name the others that it has with --name",
)
"""The request's host is unknown, as after DNS rebinding."""
ANOTHER_SITE = Refusal(403, "only the station's own pages may ask this")
NO_MARK = Refusal(403, "a command needs the header X-Pluto: 1")
"""A header is missing that pages of other sites cannot send."""
NO_TOKEN = Refusal(
    401,
    "this needs the token: it stands in the address that the station printed when it began,"
    " behind #token=",
    {"WWW-Authenticate": "Bearer"},
)
WATCHES = Refusal(
    403,
    "this browser may watch and not command: to command, open the address with the other token,"
    " which the station printed first",
)
NO_SUCH_PAGE = Refusal(404, "there is nothing at this address")
TWO_LENGTHS = Refusal(
    400, "a request says its length once: by Content-Length, or by Transfer-Encoding", HANG_UP
)
"""Two lengths, of which a proxy may believe the other one than we do."""
TOO_SLOW = Refusal(408, "the rest of that took too long to come: nothing was changed", HANG_UP)
CUT_OFF = Refusal(400, "the connection ended before the request did: nothing was changed", HANG_UP)
TOO_MANY = Refusal(
    429, "that is too much at once: nothing was changed; try again in a second", _SOON
)
TOO_BUSY = Refusal(
    503,
    "too many requests at once: nothing was changed; try again in a second."
    " A Stop is always taken",
    _SOON,
)
READER_ENDED = Refusal(
    503, "the process that reads flights of the past has ended before it answered: ask again", _SOON
)
"""It was killed, for instance as there was no memory left."""
OURS = Refusal(500, "something went wrong inside the station; what exactly stands in its audit.log")


def wrong_type(wanted: str) -> Refusal:
    """The body has another content type."""
    return Refusal(415, f"the content must be of the type {wanted}")


def wrong_method(allowed: str) -> Refusal:
    """The address does not allow this method."""
    return Refusal(405, f"this address takes {allowed} only", {"Allow": allowed})


def too_long(limit: int) -> Refusal:
    """The body is too long."""
    return Refusal(413, f"that is more than {limit:,} bytes: nothing was changed", HANG_UP)


def malformed(what: str) -> Refusal:
    """The request is malformed."""
    return Refusal(400, f"{what}: nothing was changed")
