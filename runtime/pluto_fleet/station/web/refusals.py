"""Why a request is refused, in sentences for a person; each says what to do about it."""

from __future__ import annotations

from dataclasses import dataclass

from .http import Reply, said


@dataclass(frozen=True, slots=True)
class Refusal:
    """What is answered to a request that may not be, or not so."""

    status: int
    said: str
    headers: tuple[tuple[str, str], ...] = ()

    @property
    def reply(self) -> Reply:
        """The answer."""
        plain = said(self.status, self.said)
        return Reply(status=self.status, body=plain.body, headers=self.headers)


class Refused(Exception):
    """Raised while a request is read: it goes no further."""

    def __init__(self, refusal: Refusal) -> None:
        super().__init__(refusal.said)
        self.refusal = refusal


HANG_UP = (("Connection", "close"),)
"""For a request that is refused before all of it has been read."""
_SOON = (("Retry-After", "1"),)

UNKNOWN_HOST = Refusal(
    403,
    "this station does not go by that name: open the address that it has printed,"
    " or name the others that it has with --name",
)
"""The request was meant for another address: a name elsewhere may have been pointed at this one."""
ANOTHER_SITE = Refusal(403, "only the station's own pages may ask this")
NO_MARK = Refusal(403, "a command needs the header X-Pluto: 1")
"""A header that no page elsewhere can send unasked."""
NO_TOKEN = Refusal(
    401,
    "this needs the token: it stands in the address that the station printed when it began,"
    " behind #token=",
    (("WWW-Authenticate", "Bearer"),),
)
NO_SUCH_PAGE = Refusal(404, "there is nothing at this address")
TOO_SLOW = Refusal(408, "the rest of that took too long to come: nothing was changed", HANG_UP)
CUT_OFF = Refusal(400, "the connection ended before the request did: nothing was changed", HANG_UP)
TOO_MANY = Refusal(
    429, "that is too much at once: nothing was changed; try again in a second", _SOON
)
"""From one client."""
TOO_BUSY = Refusal(
    503,
    "too many are access at once: nothing was changed; try again in a second."
    " A Stop is always taken",
    _SOON,
)
"""From all of them."""
OURS = Refusal(500, "something went wrong inside the station; what exactly stands in its audit.log")


def wrong_type(wanted: str) -> Refusal:
    """A body of another kind."""
    return Refusal(415, f"the content must be of the type {wanted}")


def wrong_method(allowed: str) -> Refusal:
    """Something is there, but not for this method."""
    return Refusal(405, f"this address takes {allowed} only", (("Allow", allowed),))


def too_long(limit: int) -> Refusal:
    """A body longer than anything that is asked for."""
    return Refusal(413, f"that is more than {limit:,} bytes: nothing was changed", HANG_UP)


def malformed(what: str) -> Refusal:
    """What was sent is not what is asked for."""
    return Refusal(400, f"{what}: nothing was changed")
