"""How a client asks a station, and what it raises where that says no."""

from __future__ import annotations

import json
import secrets
from collections.abc import Mapping
from contextlib import closing
from http.client import HTTPConnection, HTTPException, HTTPSConnection
from typing import Any
from urllib.parse import parse_qs, quote, urlencode, urlsplit

from ..shared.domain.errors import BadInput
from ..shared.domain.text import quoted

JSON = "application/json"
OK, CONFLICT = 200, 409


class Refused(BadInput):
    """Raised where the station refuses something, with its sentence; `status` is HTTP's."""

    def __init__(self, status: int, said: str) -> None:
        super().__init__(said)
        self.status = status


class Outdated(Refused):
    """Raised where something was changed meanwhile that was to be changed; `newest` is what is there now."""

    def __init__(self, newest: Any) -> None:
        super().__init__(
            CONFLICT, "it has been changed meanwhile: look at the newest, and try again"
        )
        self.newest = newest


class Connection:
    """The way to one station."""

    def __init__(
        self, address: str, *, token: str | None = None, who: str = "", timeout: float = 30.0
    ) -> None:
        """`address` is as the station has printed it, which may have the token in it.

        `who` is the name in the station's audit; `timeout` is in seconds.
        """
        parts = urlsplit(address)
        try:
            port = parts.port
        except ValueError:
            port = -1
        if parts.scheme not in ("http", "https") or not parts.hostname or port == -1:
            raise BadInput(
                f"{quoted(address)} is no address of a station: it is like http://127.0.0.1:8765"
            )
        self._new = HTTPSConnection if parts.scheme == "https" else HTTPConnection
        self._host, self._port, self._timeout = parts.hostname, port, timeout
        self._headers = {"X-Pluto": "1"}
        token = token or parse_qs(parts.fragment).get("token", [None])[0]
        if token is not None:
            self._headers["Authorization"] = f"Bearer {token}"
        if who:
            self._headers["X-Pluto-Who"] = quote(who, safe="")

    def _json(
        self,
        method: str,
        path: str,
        query: Mapping[str, object] | None = None,
        body: Mapping[str, object] | None = None,
    ) -> Any:
        """Return an answer in JSON."""
        given = None if body is None else {key: one for key, one in body.items() if one is not None}
        sent = None if given is None else json.dumps(given).encode()
        return json.loads(self._ask(method, path, query, sent, JSON))

    def _command(self, path: str, id: str | None, arguments: Mapping[str, object]) -> str:
        """Carry out a command, and return what was done."""
        body = {"id": id or secrets.token_hex(8), **arguments}
        return str(self._json("POST", path, body=body)["said"])

    def _text(self, method: str, path: str, query: Mapping[str, object] | None = None) -> str:
        """Return an answer that is text."""
        return self._bytes(method, path, query).decode()

    def _bytes(self, method: str, path: str, query: Mapping[str, object] | None = None) -> bytes:
        """Return an answer of any other kind."""
        return self._ask(method, path, query, None, JSON)

    def _sent(
        self, method: str, path: str, query: Mapping[str, object], body: str | bytes, kind: str
    ) -> Any:
        """Send a body of another kind, and return the answer in JSON."""
        sent = body.encode() if isinstance(body, str) else body
        return json.loads(self._ask(method, path, query, sent, kind))

    def _ask(
        self,
        method: str,
        path: str,
        query: Mapping[str, object] | None,
        body: bytes | None,
        kind: str,
    ) -> bytes:
        where = f"{path}?{urlencode(query)}" if query else path
        headers = self._headers if body is None else {**self._headers, "Content-Type": kind}
        try:
            with closing(self._new(self._host, self._port, timeout=self._timeout)) as line:
                line.request(method, where, body, headers)
                answer = line.getresponse()
                found = answer.read()
        except (OSError, HTTPException) as error:
            where = f"{self._host}:{self._port}" if self._port else self._host
            raise BadInput(f"no station answers at {where}: {error}") from None
        if answer.status != OK:
            raise _refusal(answer.status, found)
        return found


def _refusal(status: int, answer: bytes) -> Refused:
    try:
        data = json.loads(answer)
        if status == CONFLICT and "revision" in data:
            return Outdated(data)
        return Refused(status, data["said"])
    except (ValueError, KeyError, TypeError):  # no station answers so: perhaps a proxy before it
        return Refused(status, f"what is at this address answers {status}, and is no station")
