"""The audit log: a line for each command, also refused ones: who, when, with what outcome.

It is informational only: a full disk loses lines, and stops nothing.
"""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from traceback import format_exception
from typing import TYPE_CHECKING
from urllib.parse import unquote

from ...shared.domain.text import cut_off, printable
from .guard import Rate, client_of, header

if TYPE_CHECKING:
    from starlette.requests import HTTPConnection

_LARGEST_FILE = 4 * 1024 * 1024
"""Bytes of a file, after which it replaces `audit.log.1`."""
_LONGEST_TEXT = 200
_MOST_ENTRIES = 20
"""The most characters of a text, and entries of a list, in the log."""
_REFUSALS_A_SECOND, _REFUSALS_AT_ONCE = 1.0, 20.0
"""The rate and burst of lines about refusals, which must not displace those about commands."""

LONGEST_WHO = 40
_LONGEST_HEADER = 1_000


def who(connection: HTTPConnection) -> str:
    """Return the name that a person has given themselves, sanitized; it is never trusted."""
    name = unquote(header(connection, "x-pluto-who")[:_LONGEST_HEADER], errors="replace")
    return cut_off(printable(name.strip()), LONGEST_WHO)


class Audit:
    """The log of one station."""

    def __init__(
        self,
        file: Path | None,
        *,
        now: Callable[[], float] = time.time,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._file = file
        self._now = now
        self._refusals = Rate(_REFUSALS_A_SECOND, clock, _REFUSALS_AT_ONCE)
        self._left_out = 0

    def done(
        self, asked: HTTPConnection, given: Mapping[str, object], status: int, said: str
    ) -> None:
        """Log a command and its answer."""
        by = {"by": name} if (name := who(asked)) else {}
        entry = {"client": client_of(asked), **by, "do": asked.scope["path"], "given": short(given)}
        self._write({**entry, "status": status, "said": said})

    def refused(self, asked: HTTPConnection, status: int, said: str) -> None:
        """Log a refused request."""
        if not self._refusals.allows(""):
            self._left_out += 1
            return
        if self._left_out:
            self._write({"refused too, without a line": self._left_out})
            self._left_out = 0
        what = f"{asked.scope.get('method', 'GET')} {asked.scope['path']}"
        bears = {name: header(asked, name) for name in _TELLING if name in asked.headers}
        entry = {"client": client_of(asked), "refused": what, **bears}
        self._write({**entry, "status": status, "said": said})

    def trouble(self, asked: HTTPConnection, error: BaseException) -> None:
        """Log a bug of the station, with its traceback."""
        where = "".join(format_exception(error))[-20 * _LONGEST_TEXT :]
        self._write({"client": client_of(asked), "trouble": asked.scope["path"]}, where)

    def _write(self, entry: Mapping[str, object], where: str | None = None) -> None:
        if self._file is None:
            return
        stamp = time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(self._now()))
        whole = {"time": stamp, **{key: short(value) for key, value in entry.items()}}
        if where is not None:
            whole["traceback"] = where
        line = json.dumps(whole, separators=(",", ":"), default=str) + "\n"
        with suppress(OSError):
            self._turn(len(line))
            flags = os.O_WRONLY | os.O_CREAT | os.O_APPEND | os.O_NOFOLLOW
            with os.fdopen(os.open(self._file, flags, 0o600), "ab") as file:
                file.write(line.encode("ascii"))

    def _turn(self, more: int) -> None:
        """Rotate a full file."""
        assert self._file is not None
        with suppress(FileNotFoundError):
            if self._file.stat().st_size + more > _LARGEST_FILE:
                self._file.replace(self._file.with_name(f"{self._file.name}.1"))


_TELLING = ("host", "origin", "sec-fetch-site")
"""Headers that tell where a request comes from."""


def short(value: object, depth: int = 3) -> object:
    """Return a value with long parts truncated."""
    if isinstance(value, str):
        return value if len(value) <= _LONGEST_TEXT else value[:_LONGEST_TEXT] + "…"
    if isinstance(value, Mapping):
        if depth == 0:
            return "…"
        some = list(value.items())[:_MOST_ENTRIES]
        return {str(key)[:_LONGEST_TEXT]: short(each, depth - 1) for key, each in some}
    if isinstance(value, (list, tuple)):
        if depth == 0 or len(value) > _MOST_ENTRIES:
            return f"… ({len(value)})"
        return [short(each, depth - 1) for each in value]
    return value
