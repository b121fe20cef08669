"""Who may use the editor: pages of its own, with the token that was printed at its start.

A page of another site in the same browser can neither read nor command it: the name by which it is
called (`Host`), the page that calls (`Origin`, `Sec-Fetch-Site`) and the token must all be right.
What a proxy says of a client is not believed.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from hmac import compare_digest
from ipaddress import IPv4Address, IPv6Address, ip_address
from secrets import token_urlsafe

_HOST = re.compile(r"(\[[0-9a-f:.]+\]|[a-z0-9_.-]+)(?::([0-9]{1,5}))?")
_LOOPBACK = ("127.0.0.1", "localhost", "[::1]")
_PLAIN_PORT = 80


@dataclass(frozen=True, slots=True, kw_only=True)
class Guard:
    """The access rules of one editor."""

    host: str
    """The address at which it listens."""
    port: int
    token: str = field(default_factory=lambda: token_urlsafe(24), repr=False)

    @property
    def cookie(self) -> str:
        """The name of the cookie; an editor at another port has one of its own."""
        return f"pluto_edit_{self.port}"

    @property
    def address(self) -> str:
        """The address to open, with the token."""
        host = "127.0.0.1" if _is_every(self.host) else self.host
        name = f"[{host}]" if ":" in host else host
        return f"http://{name}:{self.port}/?token={self.token}"


def is_ours(guard: Guard, headers: Mapping[str, str], local: str) -> bool:
    """Return whether a request names this editor as its host; else a stranger's name leads here."""
    found = _HOST.fullmatch(headers.get("host", "").lower())
    if found is None or int(found[2] or _PLAIN_PORT) != guard.port:
        return False
    name = found[1]
    if _is_loopback(guard.host):
        return name in _LOOPBACK
    here, meant = _address(local), _address(name)
    if meant is None:
        own = here is not None and here.is_loopback
        return name == guard.host.lower() or (name == "localhost" and own)
    return not meant.is_unspecified and meant in (here, _address(guard.host))


def is_own_page(headers: Mapping[str, str]) -> bool:
    """Return whether a request comes from a page of this very address, or from no page at all."""
    host, origin = headers.get("host", "").lower(), headers.get("origin")
    if headers.get("sec-fetch-site", "same-origin") not in ("same-origin", "same-site", "none"):
        return False
    return origin is None or origin.lower() in (f"http://{host}", f"https://{host}")


def knows(guard: Guard, token: str) -> bool:
    """Return whether this is the token; compared in constant time."""
    return compare_digest(token.encode("utf-8", "replace"), guard.token.encode())


def _is_loopback(host: str) -> bool:
    address = _address(host)
    return host == "localhost" if address is None else address.is_loopback


def _is_every(host: str) -> bool:
    address = _address(host)
    return address is not None and address.is_unspecified


def _address(text: str) -> IPv4Address | IPv6Address | None:
    try:
        address = ip_address(text.strip("[]").partition("%")[0])
    except ValueError:
        return None
    mapped = address.ipv4_mapped if isinstance(address, IPv6Address) else None
    return mapped or address


def headers(*, page: bool = False) -> dict[str, str]:
    """Return the headers of every answer; a page may load this editor's own files, and no other."""
    policy = "default-src 'none'; frame-ancestors 'none'; sandbox"
    if page:
        policy = (
            "default-src 'none'; script-src 'self'; style-src 'self';"
            " img-src 'self' data: blob:; font-src 'self'; connect-src 'self'; base-uri 'none';"
            " form-action 'none'; frame-ancestors 'none'"
        )
    return {
        "Content-Security-Policy": policy,
        "Cross-Origin-Opener-Policy": "same-origin",
        "Cross-Origin-Resource-Policy": "same-origin",
        "Permissions-Policy": "camera=(), geolocation=(), microphone=(), payment=(), usb=()",
        "Referrer-Policy": "no-referrer",
        "X-Content-Type-Options": "nosniff",
        "X-Frame-Options": "DENY",
    }
