"""The headers that every answer bears: what a browser must not do with it."""

from __future__ import annotations

from dataclasses import replace

from .guard import is_loopback
from .http import Reply, Request

_PAGE = (
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:;"
    " connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
)
_PICTURE = (
    "default-src 'none'; style-src 'unsafe-inline'; img-src data:; frame-ancestors 'none'; sandbox"
)
_DATA = "default-src 'none'; frame-ancestors 'none'; sandbox"

_ALONE = (("Cross-Origin-Opener-Policy", "same-origin"),)
"""Browsers heed it only where nobody can listen on the way, and else say that they do not."""

_ALWAYS = (
    ("X-Content-Type-Options", "nosniff"),
    ("X-Frame-Options", "DENY"),
    ("Referrer-Policy", "no-referrer"),
    ("Cross-Origin-Resource-Policy", "same-origin"),
    ("Permissions-Policy", "camera=(), geolocation=(), microphone=(), payment=(), usb=()"),
)


def dressed(request: Request, reply: Reply) -> Reply:
    """Return an answer with all the headers that keep it safe."""
    own = {name.lower() for name, _ in reply.headers}
    kept = () if "cache-control" in own else (("Cache-Control", "no-store"),)
    policy = (("Content-Security-Policy", _policy(request, reply)),)
    alone = _ALONE if is_loopback(request.headers.get("host", "").rpartition(":")[0]) else ()
    return replace(reply, headers=(*reply.headers, *kept, *policy, *alone, *_ALWAYS))


def _policy(request: Request, reply: Reply) -> str:
    if request.path == "/map":
        return _PICTURE
    return _PAGE if reply.type.startswith("text/html") else _DATA
