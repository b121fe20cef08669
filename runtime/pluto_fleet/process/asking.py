"""Tells a running app what to do, and hears what it says: one line of JSON each way."""

from __future__ import annotations

import json
import os
import socket
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from plutoc_runtime.domain.errors import BadInput

from ..journal.place import gateway_folder
from .private import address_in

_ENDED = "the app ended before it could say whether that was done: look, once it goes on"

LONGEST = 64 * 1024
"""Bytes of a request or of an answer."""


class Nobody(BadInput):
    """No app runs on this journal."""


class Silent(BadInput):
    """An app runs, but it does not answer."""


class Ended(Silent):
    """The app has ended before it could answer: nobody knows whether it has done what was asked."""


def note_of(journal: Path) -> Path:
    """Return the note that says where the app of a journal listens."""
    return gateway_folder(Path(os.path.realpath(journal))) / "brain"


def ask(note: Path, request: Mapping[str, object], patience: float) -> str:
    """Return what the app says; raise `BadInput` with its words if it refuses.

    It is `Nobody` if none runs, and `Silent` if it says nothing in this many seconds.
    """
    address = address_in(note)
    if address is None:
        raise Nobody("the app is not running")
    try:
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as line:
            line.settimeout(patience)
            line.connect(str(address))
            line.sendall(json.dumps(request).encode() + b"\n")
            return _answer(_first_line(line))
    except (ConnectionRefusedError, FileNotFoundError):
        raise Nobody("the app is not running") from None
    except (ConnectionResetError, BrokenPipeError):
        raise Ended(_ENDED) from None
    except OSError as error:  # a timeout is one, too
        raise Silent("the app runs, but does not answer") from error


def _first_line(line: socket.socket) -> bytes:
    told = b""
    while not told.endswith(b"\n") and len(told) <= LONGEST:
        piece = line.recv(LONGEST)
        if not piece:
            break
        told += piece
    return told


def _answer(told: bytes) -> str:
    with suppress(ValueError):  # it is no JSON, or no Unicode
        match json.loads(told):
            case {"ok": True, "said": str(said)}:
                return said
            case {"ok": False, "said": str(said)}:
                raise BadInput(said)
    raise Ended(_ENDED)
