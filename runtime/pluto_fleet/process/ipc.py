"""Lines of JSON between processes of one user, over a socket that only this user may open.

The address of a socket must be short, a journal's path need not be: so the socket is in a private
folder elsewhere, and a note beside the journal has its address.
"""

from __future__ import annotations

import asyncio
import json
import os
import shutil
import socket
import stat
import tempfile
import time
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from contextlib import asynccontextmanager, suppress
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..shared.domain.errors import BadInput
from .forked import not_for_children
from .whole_file import write_whole

if TYPE_CHECKING:
    from asyncio import StreamReader, StreamWriter

MAX_LINE = 64 * 1024
"""Bytes of a request or of an answer."""

_MAX_CLIENTS = 32
"""How many may be connected at the same time."""

_CLIENT_TIMEOUT = 5.0
"""The time-out of a request and of reading an answer, in seconds."""

_LAST_WORDS = 0.5
"""The time-out of answers in transit when a server ends, in seconds."""

_MAX_ADDRESS = 90
"""Bytes; the systems take some hundred."""

_PREFIX, _NAME = "pluto-", "s"

_LOST = "the app ended before it could say whether that was done: look, once it goes on"

Message = Mapping[str, Any]
Serve = Callable[["StreamReader", "StreamWriter"], Awaitable[None]]
Answer = Callable[[Message], Awaitable[str]]


class NotRunning(BadInput):
    """No process is serving this address."""


class NoAnswer(BadInput):
    """The server does not answer in time."""


class AnswerLost(NoAnswer):
    """The server ended before it answered: the request may have been carried out, or not."""


# Lines


def line(message: Message) -> bytes:
    """Write a message."""
    return json.dumps(message).encode() + b"\n"


def message_in(told: bytes) -> Message | None:
    """Read a message; None: it is none."""
    try:
        message = json.loads(told)
    except (ValueError, RecursionError):
        return None
    return message if isinstance(message, dict) else None


# Asking


def ask(note: Path, request: Message, timeout: float) -> str:
    """Send a request to the process that serves an address, and return its answer; its refusal is raised as `BadInput`.

    It is `NotRunning` if there is none, and `NoAnswer` if it says nothing in this many seconds.
    """
    if len(line(request)) > MAX_LINE:
        raise BadInput(f"that is too long for one command, which has at most {MAX_LINE} bytes")
    address = address_in(note)
    if address is None:
        raise NotRunning("the app is not running")
    until = time.monotonic() + timeout
    try:
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as connection:
            connection.settimeout(timeout)
            connection.connect(str(address))
            connection.sendall(line(request))
            told = b""
            while not told.endswith(b"\n") and len(told) <= MAX_LINE:
                connection.settimeout(max(0.001, until - time.monotonic()))
                piece = connection.recv(MAX_LINE)
                if not piece:
                    break
                told += piece
    except (ConnectionRefusedError, FileNotFoundError):
        raise NotRunning("the app is not running") from None
    except (ConnectionResetError, BrokenPipeError):
        raise AnswerLost(_LOST) from None
    except OSError as error:  # a time-out is one, too
        raise NoAnswer("the app runs, but does not answer") from error
    match message_in(told):
        case {"ok": True, "said": str(said)}:
            return said
        case {"ok": False, "said": str(said)}:
            raise BadInput(said)
    raise AnswerLost(_LOST)


# Serving


@asynccontextmanager
async def listening(
    note: Path,
    serve: Serve,
    *,
    max_line: int = MAX_LINE,
    last_words: float = _LAST_WORDS,
    turned_away: Callable[[], object] | None = None,
) -> AsyncIterator[None]:
    """Serve every connection within this context; raise `OSError` if the note cannot be written.

    At the end, connections have `last_words` seconds for messages in transit.
    """
    address = new_address(note)
    served: set[asyncio.Future[None]] = set()

    def connected(reader: StreamReader, writer: StreamWriter) -> None:
        if len(served) >= _MAX_CLIENTS:
            if turned_away is not None:
                turned_away()
            writer.transport.abort()
            return
        task = asyncio.ensure_future(_served(serve, reader, writer))
        served.add(task)
        task.add_done_callback(served.discard)

    server = await asyncio.start_unix_server(connected, address, limit=max_line)
    for one in server.sockets:
        not_for_children(one.fileno())
    try:
        publish(note, address)
        yield
    finally:
        server.close()
        withdraw(note)
        if served:
            _, open_still = await asyncio.wait(list(served), timeout=last_words)
            for task in open_still:
                task.cancel()
            await asyncio.gather(*open_still, return_exceptions=True)


async def _served(serve: Serve, reader: StreamReader, writer: StreamWriter) -> None:
    try:
        await serve(reader, writer)
    finally:
        with suppress(OSError):
            writer.close()


def answering(answer: Answer) -> Serve:
    """Serve one request per connection; `answer` returns what was done, or raises `BadInput`."""

    async def serve(reader: StreamReader, writer: StreamWriter) -> None:
        with suppress(OSError):  # it has hung up, or a time-out, which is one, too
            async with asyncio.timeout(_CLIENT_TIMEOUT):
                try:
                    told = await reader.readline()
                except ValueError:  # it is too long
                    told = b""
            writer.write(line(await _answered(told, answer)))
            async with asyncio.timeout(_CLIENT_TIMEOUT):
                await writer.drain()

    return serve


async def _answered(told: bytes, answer: Answer) -> Message:
    request = message_in(told)
    if request is None:
        return {"ok": False, "said": "that is not a line of JSON with an object"}
    try:
        return {"ok": True, "said": await answer(request)}
    except BadInput as error:
        return {"ok": False, "said": str(error)}


async def connect(note: Path, max_line: int) -> tuple[StreamReader, StreamWriter]:
    """Connect to the process that serves an address; raise `OSError` if there is none."""
    address = address_in(note)
    if address is None:
        raise FileNotFoundError(note)
    reader, writer = await asyncio.open_unix_connection(address, limit=max_line)
    not_for_children(writer.get_extra_info("socket").fileno())
    return reader, writer


# Where the socket is


def new_address(note: Path) -> Path:
    """Make a private folder, and return an address for a socket in it; `publish` writes the note.

    It is the same folder each time, so that killed processes leave at most one behind.
    """
    withdraw(note)
    place = Path(_short_folder())
    folder = place / f"{_PREFIX}{sha256(os.fsencode(os.path.realpath(note))).hexdigest()[:12]}"
    try:
        folder.mkdir(mode=0o700)
    except FileExistsError:
        if not is_private(folder):  # another user was there first
            folder = Path(tempfile.mkdtemp(prefix=_PREFIX, dir=place))
    return folder / _NAME


def publish(note: Path, address: Path) -> None:
    """Write the note with the socket's address atomically, once a process listens there."""
    note.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    write_whole(note, f"{address}\n")


def address_in(note: Path) -> Path | None:
    """Return the address in a note; None: there is none, or it belongs to another user."""
    try:
        address = Path(note.read_text(encoding="utf-8").strip())
    except (OSError, ValueError):
        return None
    return address if is_private(address.parent) else None


def withdraw(note: Path) -> None:
    """Remove the socket, its folder and the note."""
    address = address_in(note)
    if address is not None and address.parent.name.startswith(_PREFIX) and address.name == _NAME:
        shutil.rmtree(address.parent, ignore_errors=True)
    with suppress(OSError):
        note.unlink(missing_ok=True)


def is_private(folder: Path) -> bool:
    """Whether only this user may enter a folder."""
    try:
        found = folder.lstat()
    except (OSError, ValueError):
        return False
    private = stat.S_ISDIR(found.st_mode) and not found.st_mode & 0o077
    return private and found.st_uid == os.geteuid()


def _short_folder() -> str:
    """Return the first folder for temporary files with a short enough name."""
    for folder in (os.environ.get("XDG_RUNTIME_DIR", ""), tempfile.gettempdir(), "/tmp"):
        usable = os.path.isabs(folder) and os.access(folder, os.W_OK | os.X_OK)
        if usable and len(os.fsencode(folder)) < _MAX_ADDRESS - 20:
            return folder
    return tempfile.gettempdir()
