"""The client: everything that can be asked of a station, and what happens there as it happens."""

from __future__ import annotations

import secrets
from collections.abc import Iterator, Mapping
from contextlib import closing
from http.client import (
    HTTPConnection,
    HTTPException,
    HTTPResponse,
    HTTPSConnection,
    IncompleteRead,
)
from typing import Any
from urllib.parse import parse_qs, quote, urlencode, urlsplit

import msgspec

from ..process.untrusted import parsed
from ..shared.domain.errors import BadInput
from ..shared.domain.text import bounded, printable, quoted
from ..station.interface import Interface
from ..station.operation import JSON, Operation
from ..station.wire import LiveMessage
from .timely import TimelyResponse

OK = 200
CONFLICT = 409

LARGEST = 1024 * 1024 * 1024
"""Bytes of an answer."""

LARGEST_JSON = 64 * 1024 * 1024
"""Bytes of an answer that is read as JSON."""

LONGEST_SENTENCE = 10_000
"""Characters of what a station says."""


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


class Station(Interface):
    """A ground station: `Station("http://127.0.0.1:8765", token="…")`.

    What is refused raises `Refused` with the station's sentence. A command may be sent again with the
    same `id`, as after a lost answer: it is done once.
    """

    def __init__(
        self, address: str, *, token: str | None = None, who: str = "", timeout: float = 30.0
    ) -> None:
        """`address` is as the station has printed it, which may have the token in it.

        `who` is the name in the station's audit; `timeout` is in seconds: an answer begins within it,
        and comes at 10 kB a second at least.
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
        self._host = parts.hostname
        self._port = port
        self._timeout = timeout
        self._headers = {"X-Pluto": "1"}
        token = token or parse_qs(parts.fragment).get("token", [None])[0]
        if token is not None:
            self._headers["Authorization"] = f"Bearer {token}"
        if who:
            self._headers["X-Pluto-Who"] = quote(who, safe="")

    def updates(self) -> Iterator[LiveMessage]:
        """Yield what happens, as it happens: first everything, then what has changed, for ever.

        There is one message a second at least.
        """
        server = flight = ""
        seen = log = results = 0
        while True:
            message = self.live(flight=flight, seen=seen, log=log, results=results)
            if server not in ("", message["server"]):  # its versions count anew
                server = flight = ""
                seen = log = results = 0
                continue
            if message["flight"] != flight:
                log = results = 0
            server = message["server"]
            flight = message["flight"]
            seen = message["version"]
            log = max([log, *(line["number"] for line in message["log"])])
            results = max([results, *(one["number"] for one in message["results"])])
            yield message

    def ask(self, operation: Operation, given: Mapping[str, Any]) -> Any:
        """Ask an address, and return its answer, which anyone may give there."""
        query = {name: given[name] for name in operation.query if name in given}
        path = operation.path.format(
            **{name: quote(str(given[name]), safe="") for name in operation.in_path}
        )
        kind = JSON
        sent: str | bytes | None = None
        if operation.takes:
            kind = given.get("media", operation.takes[0])
            sent = given["body"]
        elif operation.body is not None:
            fields = {name: given[name] for name in operation.body if name in given}
            if operation.is_command and not fields.get("id"):
                fields["id"] = secrets.token_hex(8)
            sent = msgspec.json.encode(fields)
        is_json = operation.media == JSON
        content = self._answer(
            operation,
            path,
            query,
            sent.encode() if isinstance(sent, str) else sent,
            kind,
            LARGEST_JSON if is_json else LARGEST,
        )
        if is_json:
            data = self._read(content, operation.answers)
            return data["said"] if operation.is_command else data
        if operation.answers is bytes:
            return content
        try:
            return content.decode()
        except UnicodeDecodeError:
            raise self._no_station("is no text") from None

    def _read(self, answer: bytes, wanted: Any) -> Any:
        try:
            data = parsed(answer)
        except ValueError:
            raise self._no_station("is no JSON") from None
        try:
            msgspec.convert(data, wanted)
        except msgspec.ValidationError:
            raise self._no_station("is not what this version of the client knows") from None
        return data  # with the fields of the app's own, which no type declares

    def _no_station(self, what: str) -> BadInput:
        return BadInput(f"what is answered at {self._where} {what}: is that a station?")

    @property
    def _where(self) -> str:
        return f"{self._host}:{self._port}" if self._port else self._host

    def _answer(
        self,
        operation: Operation,
        path: str,
        query: Mapping[str, object],
        body: bytes | None,
        kind: str,
        largest: int,
    ) -> bytes:
        where = f"{path}?{urlencode(query)}" if query else path
        headers = self._headers if body is None else {**self._headers, "Content-Type": kind}
        try:
            with closing(self._new(self._host, self._port, timeout=self._timeout)) as line:
                line.response_class = TimelyResponse
                line.request(operation.method, where, body, headers)
                answer = line.getresponse()
                found = _bounded(answer, largest)
        except (OSError, HTTPException, ValueError) as error:  # ValueError: in what is sent
            said = printable(bounded(str(error) or type(error).__name__, LONGEST_SENTENCE))
            raise BadInput(f"no station answers at {self._where}: {said}") from None
        if found is None:
            raise self._no_station(f"is larger than {largest // 2**20} MiB")
        if answer.status != OK:
            raise _refusal(answer.status, found)
        return found


def _bounded(answer: HTTPResponse, largest: int) -> bytes | None:
    """Return what is answered; None: it is larger."""
    found = bytearray()
    while piece := answer.read1(_AT_ONCE):
        found += piece
        if len(found) > largest:
            return None
    if answer.length:
        raise IncompleteRead(bytes(found[:_SHOWN]), answer.length)
    return bytes(found)


_AT_ONCE = 1024 * 1024
_SHOWN = 100


def _refusal(status: int, answer: bytes) -> Refused:
    try:
        data = parsed(answer)
    except ValueError:
        data = None
    match data:
        case {"revision": int()} if status == CONFLICT:
            return Outdated(data)
        case {"said": str(said)}:
            return Refused(status, bounded(said, LONGEST_SENTENCE))
    # no station answers so: perhaps a proxy before it
    return Refused(status, f"what is at this address answers {status}, and is no station")
