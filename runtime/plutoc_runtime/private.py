"""A socket in a folder that only its owner may enter, and a note that says where it is.

The address of a socket must be short, a journal's path need not be: so the socket stands elsewhere,
and the note beside the journal leads to it.
"""

from __future__ import annotations

import os
import shutil
import stat
import tempfile
from contextlib import suppress
from pathlib import Path

_LONGEST = 90
"""Bytes; the systems take some hundred."""

_PREFIX, _NAME = "pluto-", "s"


def new_address(note: Path) -> Path:
    """Make a private folder, and return where in it a socket may stand; `publish` tells others.

    What a process that was killed has left there goes.
    """
    withdraw(note)
    return Path(tempfile.mkdtemp(prefix=_PREFIX, dir=_short_folder())) / _NAME


def publish(note: Path, address: Path) -> None:
    """Write down where the socket is, once somebody listens there: whole or not at all."""
    note.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    part = note.with_name(f".{note.name}.{os.getpid()}.part")
    part.write_text(f"{address}\n", encoding="utf-8")
    part.replace(note)


def address_in(note: Path) -> Path | None:
    """Return the socket that a note leads to; None: there is none, or it is not ours."""
    try:
        address = Path(note.read_text(encoding="utf-8").strip())
        folder = address.parent.lstat()
    except (OSError, ValueError):
        return None
    private = stat.S_ISDIR(folder.st_mode) and not folder.st_mode & 0o077
    return address if private and folder.st_uid == os.geteuid() else None


def withdraw(note: Path) -> None:
    """Take the socket, its folder and the note away."""
    address = address_in(note)
    if address is not None and address.parent.name.startswith(_PREFIX) and address.name == _NAME:
        shutil.rmtree(address.parent, ignore_errors=True)
    with suppress(OSError):
        note.unlink(missing_ok=True)


def _short_folder() -> str | None:
    """Return the first folder for such things whose name is short; None: the system's choice."""
    for folder in (os.environ.get("XDG_RUNTIME_DIR", ""), tempfile.gettempdir(), "/tmp"):
        usable = os.path.isabs(folder) and os.access(folder, os.W_OK | os.X_OK)
        if usable and len(os.fsencode(folder)) < _LONGEST - 20:
            return folder
    return None
