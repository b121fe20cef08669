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
from hashlib import sha256
from pathlib import Path

_LONGEST = 90
"""Bytes; the systems take some hundred."""

_PREFIX, _NAME = "pluto-", "s"


def new_address(note: Path) -> Path:
    """Make a private folder, and return where in it a socket may stand; `publish` tells others.

    It is the same folder each time, so that processes that are killed leave one at most.
    """
    withdraw(note)
    place = Path(_short_folder())
    folder = place / f"{_PREFIX}{sha256(os.fsencode(os.path.realpath(note))).hexdigest()[:12]}"
    try:
        folder.mkdir(mode=0o700)
    except FileExistsError:
        if not is_private(folder):  # somebody else was there first
            folder = Path(tempfile.mkdtemp(prefix=_PREFIX, dir=place))
    return folder / _NAME


def publish(note: Path, address: Path) -> None:
    """Write down where the socket is, once somebody listens there: whole or not at all."""
    note.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
    part = note.with_name(f".{note.name}.{os.getpid()}.part")
    try:
        part.write_text(f"{address}\n", encoding="utf-8")
        part.replace(note)
    except OSError:
        with suppress(OSError):
            part.unlink()
        raise


def address_in(note: Path) -> Path | None:
    """Return the socket that a note leads to; None: there is none, or it is not ours."""
    try:
        address = Path(note.read_text(encoding="utf-8").strip())
    except (OSError, ValueError):
        return None
    return address if is_private(address.parent) else None


def is_private(folder: Path) -> bool:
    """Whether nobody but us may enter a folder."""
    try:
        found = folder.lstat()
    except (OSError, ValueError):
        return False
    private = stat.S_ISDIR(found.st_mode) and not found.st_mode & 0o077
    return private and found.st_uid == os.geteuid()


def withdraw(note: Path) -> None:
    """Take the socket, its folder and the note away."""
    address = address_in(note)
    if address is not None and address.parent.name.startswith(_PREFIX) and address.name == _NAME:
        shutil.rmtree(address.parent, ignore_errors=True)
    with suppress(OSError):
        note.unlink(missing_ok=True)


def _short_folder() -> str:
    """Return the first folder for such things whose name is short."""
    for folder in (os.environ.get("XDG_RUNTIME_DIR", ""), tempfile.gettempdir(), "/tmp"):
        usable = os.path.isabs(folder) and os.access(folder, os.W_OK | os.X_OK)
        if usable and len(os.fsencode(folder)) < _LONGEST - 20:
            return folder
    return tempfile.gettempdir()
