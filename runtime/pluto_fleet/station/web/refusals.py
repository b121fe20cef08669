"""Why somebody is refused, in sentences for a person; each says what to do about it."""

from __future__ import annotations

from dataclasses import dataclass

from .http import Reply, said


@dataclass(frozen=True, slots=True)
class Refusal:
    """What is answered to somebody who may not, or not so."""

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
"""For whoever is refused before all that was sent has been read."""


def unknown_host() -> Refusal:
    """The request was meant for another address: somebody may have bent a name to ours."""
    return Refusal(
        403,
        "this station does not go by that name: open the address that it has printed,"
        " or name the others that it has with --name",
    )


def another_site() -> Refusal:
    """A page that is not of this station asks."""
    return Refusal(403, "only the station's own pages may ask this")


def no_mark() -> Refusal:
    """A command without the header that no page elsewhere can send unasked."""
    return Refusal(403, "a command needs the header X-Pluto: 1")


def no_token() -> Refusal:
    """No token, or not the right one."""
    return Refusal(
        401,
        "this needs the token: it stands in the address that the station printed when it began,"
        " behind #token=",
        (("WWW-Authenticate", "Bearer"),),
    )


def wrong_type(wanted: str) -> Refusal:
    """A body of another kind."""
    return Refusal(415, f"the content must be of the type {wanted}")


def no_such_page() -> Refusal:
    """Nothing is there."""
    return Refusal(404, "there is nothing at this address")


def wrong_method(allowed: str) -> Refusal:
    """Something is there, but not for this method."""
    return Refusal(405, f"this address takes {allowed} only", (("Allow", allowed),))


def too_long(limit: int) -> Refusal:
    """More was sent than anybody needs."""
    return Refusal(413, f"that is more than {limit:,} bytes: nothing was changed", HANG_UP)


def too_slow() -> Refusal:
    """The body did not come to an end."""
    return Refusal(408, "the rest of that took too long to come: nothing was changed", HANG_UP)


def cut_off() -> Refusal:
    """Whoever sent it has hung up before its end; nobody will hear this."""
    return Refusal(400, "the connection ended before the request did: nothing was changed", HANG_UP)


def malformed(what: str) -> Refusal:
    """What was sent is not what is asked for."""
    return Refusal(400, f"{what}: nothing was changed")


def too_many() -> Refusal:
    """Too much at once from one place."""
    return Refusal(
        429,
        "that is too much at once: nothing was changed; try again in a second",
        (("Retry-After", "1"),),
    )


def too_busy() -> Refusal:
    """Too much at once from everybody."""
    return Refusal(
        503,
        "too many are asking at once: nothing was changed; try again in a second."
        " A Stop is always taken",
        (("Retry-After", "1"),),
    )


def ours() -> Refusal:
    """A mistake in the station itself."""
    return Refusal(
        500,
        "something went wrong inside the station; what exactly stands in its audit.log",
    )
