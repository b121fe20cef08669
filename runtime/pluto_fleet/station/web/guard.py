"""Access control: allowed hosts, origins and tokens, rate limits, and security headers."""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Callable
from dataclasses import dataclass, field
from enum import Enum
from functools import cache
from hashlib import sha256
from hmac import compare_digest
from ipaddress import IPv4Address, IPv6Address, ip_address
from typing import TYPE_CHECKING

from ...shared.domain.errors import BadInput
from ...shared.domain.text import quoted
from ..wire import Role
from . import refusals
from .refusals import Refusal
from .static import pages

if TYPE_CHECKING:
    from starlette.datastructures import MutableHeaders
    from starlette.requests import HTTPConnection

_CLIENTS_KEPT = 1024
"""The most clients that are remembered; a forgotten one starts afresh."""


class Rate:
    """A rate limit for each client (token bucket)."""

    def __init__(
        self, a_second: float, clock: Callable[[], float], at_once: float | None = None
    ) -> None:
        self._a_second = a_second
        self._clock = clock
        self._at_once = a_second if at_once is None else at_once
        self._left: dict[str, tuple[float, float]] = {}

    def allows(self, client: str) -> bool:
        """Return whether this client may make another request, and count it."""
        now = self._clock()
        left, since = self._left.pop(client, (self._at_once, now))
        left = min(self._at_once, left + (now - since) * self._a_second)
        allowed = left >= 1
        self._left[client] = (left - 1 if allowed else left, now)
        if len(self._left) > _CLIENTS_KEPT:
            del self._left[next(iter(self._left))]
        return allowed


_HOST = re.compile(r"(\[[0-9a-f:.]+\]|[a-z0-9_.-]+)(?::([0-9]{1,5}))?")
_LOOPBACK = ("127.0.0.1", "localhost", "[::1]")
_PLAIN_PORT, _PORTS = 80, 65536
_USUAL = re.compile(r":(80|443)$")
"""The ports that browsers omit."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Guard:
    """The access rules of a station."""

    host: str  # where it listens
    port: int
    names: tuple[str, ...] = ()
    """Its other names: "station.example" or "station.example:8443"."""
    token: str | None = field(default=None, repr=False)
    """Who has it may command; None: everyone may who reaches the station."""
    watch_token: str | None = field(default=None, repr=False)
    """Who has it may read everything, and command nothing."""


def proper_name(text: str) -> str:
    """Return a name of the station in the form that a browser sends."""
    name = _USUAL.sub("", text.lower())
    found = _HOST.fullmatch(name)
    if found is None or not int(found.group(2) or _PLAIN_PORT) < _PORTS:
        raise BadInput(
            f"--name {quoted(text)}: a name is like ward.example, or ward.example:8443 where its"
            " port is not the station's own"
        )
    return name


class Access(Enum):
    """The kinds of requests, for access control."""

    PAGE = "a page"  # static, without data of the flight
    READ = "reading"
    COMMAND = "a command"
    LIVE = "staying connected"


def is_loopback(host: str) -> bool:
    """Whether an address can be reached from this machine only."""
    address = _address(host)
    return host == "localhost" if address is None else address.is_loopback


def needs_token(host: str, names: tuple[str, ...]) -> bool:
    """Whether the station can be reached from other machines, so that a token is needed."""
    return bool(names) or not is_loopback(host)


def refusal(guard: Guard, connection: HTTPConnection, access: Access) -> Refusal | None:
    """Return why a request is refused; None: it is allowed.

    On a WebSocket the token is not checked here, as it comes with the first message.
    """
    headers = connection.headers
    if "content-length" in headers and "transfer-encoding" in headers:
        return refusals.TWO_LENGTHS
    host = header(connection, "host").lower()
    local = connection.scope.get("server") or ("",)
    if not _is_ours(guard, host, str(local[0])):
        return refusals.UNKNOWN_HOST
    if access is Access.PAGE:
        return None
    if not _is_same_site(connection, host, access):
        return refusals.ANOTHER_SITE
    marked = header(connection, "x-pluto") == "1"
    if access is Access.COMMAND and not marked:
        return refusals.NO_MARK
    if access is Access.LIVE:
        stranger = "origin" not in headers and guard.token is None and not marked
        return refusals.NO_MARK if stranger else None
    return refusals.NO_TOKEN if role_of(guard, connection) is None else None


def header(connection: HTTPConnection, name: str, otherwise: str = "") -> str:
    """Return a header; repeated ones are joined, which makes them invalid."""
    found = connection.headers.getlist(name)
    return ", ".join(found) if found else otherwise


def client_of(connection: HTTPConnection) -> str:
    """Return the address of the connection; headers of proxies are ignored."""
    return connection.client.host if connection.client is not None else ""


def role_of(guard: Guard, connection: HTTPConnection) -> Role | None:
    """Return what the token of a request allows; None: nothing."""
    return role_by(guard, bearer(header(connection, "authorization")))


def role_by(guard: Guard, token: str) -> Role | None:
    """Return what a token allows, which is compared in constant time; None: nothing."""
    given = token.encode("utf-8", "replace")
    if guard.token is None or compare_digest(given, guard.token.encode()):
        return "fly"
    if guard.watch_token is not None and compare_digest(given, guard.watch_token.encode()):
        return "watch"
    return None


def bearer(authorization: str) -> str:
    """Return the token in a header, or an empty text."""
    kind, _, token = authorization.partition(" ")
    return token.strip() if kind.lower() == "bearer" else ""


def _is_same_site(connection: HTTPConnection, host: str, access: Access) -> bool:
    """Whether the request comes from one of our pages, or not from a page."""
    site = header(connection, "sec-fetch-site", "same-origin")
    match access:
        case Access.LIVE:  # browsers differ in the site of a ws: address
            near = site != "cross-site"
        case Access.READ:  # "none": the address was typed
            near = site in ("same-origin", "none")
        case _:
            near = site == "same-origin"
    origin = header(connection, "origin", f"http://{host}").lower()
    return near and origin in (f"http://{host}", f"https://{host}")


def _is_ours(guard: Guard, host: str, local: str) -> bool:
    """Whether a `Host` is a name of this station, including the port."""
    found = _HOST.fullmatch(host)
    if found is None:
        return False
    name = found.group(1)
    port = int(found.group(2) or _PLAIN_PORT)
    for other in guard.names:
        if host == other or (name == other and port in (guard.port, _PLAIN_PORT)):
            return True
    return port == guard.port and _is_own(guard.host, name, local)


def _is_own(bound: str, name: str, local: str) -> bool:
    """Whether a name needs no --name: an address of this machine at which it listens."""
    if is_loopback(bound) and name in _LOOPBACK:
        return True
    here = _address(local)
    meant = _address(name)
    if meant is None:
        return name == bound.lower() or (
            name == "localhost" and here is not None and here.is_loopback
        )
    return not meant.is_unspecified and meant in (here, _address(bound))


def _address(text: str) -> IPv4Address | IPv6Address | None:
    try:
        address = ip_address(text.strip("[]").partition("%")[0])
    except ValueError:
        return None
    mapped = address.ipv4_mapped if isinstance(address, IPv6Address) else None
    return mapped or address


_PAGE = (
    "default-src 'none'; script-src 'self' {hashes}; style-src 'self'; img-src 'self' data: blob:;"
    " connect-src 'self'; manifest-src 'self'; font-src 'self'; base-uri 'none'; form-action 'none';"
    " frame-ancestors 'none'"
)
_INLINE_SCRIPT = re.compile(rb"<script type=\"importmap\">(.*?)</script>", re.DOTALL)
_PICTURE = (
    "default-src 'none'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'none'; sandbox"
)
_DATA = "default-src 'none'; frame-ancestors 'none'; sandbox"

_ALONE = "Cross-Origin-Opener-Policy"
"""A header that browsers respect only on this machine or over TLS, and else complain about."""

_ALWAYS = (
    (b"x-content-type-options", b"nosniff"),
    (b"x-frame-options", b"DENY"),
    (b"referrer-policy", b"no-referrer"),
    (b"cross-origin-resource-policy", b"same-origin"),
    (b"permissions-policy", b"camera=(), geolocation=(), microphone=(), payment=(), usb=()"),
)


def safe_headers(connection: HTTPConnection, headers: MutableHeaders) -> None:
    """Add all security headers to those of an answer."""
    headers.raw.extend(_ALWAYS)
    headers.setdefault("Cache-Control", "no-store")
    headers["Content-Security-Policy"] = _policy(connection.scope["path"], headers)
    if is_loopback(header(connection, "host").rpartition(":")[0]):
        headers[_ALONE] = "same-origin"


def _policy(path: str, headers: MutableHeaders) -> str:
    if path in ("/map", "/logo"):
        return _PICTURE
    if not headers.get("content-type", "").startswith("text/html"):
        return _DATA
    return _PAGE.format(hashes=_hashes())


@cache
def _hashes() -> str:
    """Return what allows the page's import map, which a browser takes only from within the page."""
    found = _INLINE_SCRIPT.findall(pages()["/"].plain)
    digests = (b64encode(sha256(script).digest()).decode() for script in found)
    return " ".join(f"'sha256-{digest}'" for digest in digests)
