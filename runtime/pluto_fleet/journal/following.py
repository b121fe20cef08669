"""Is a file that is open still where it was, and where is it now?

A file can be deleted or renamed while it is written, and whoever writes it is told nothing.
"""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

Identity = tuple[int, int]
"""Which file it is, whatever its name: its device and its number there."""

_OPEN = Path("/proc/self/fd")
_DELETED = " (deleted)"


def identity(path: Path) -> Identity | None:
    """Return which file has this name; None: none that can be seen."""
    try:
        found = os.stat(path)
    except OSError:
        return None
    return found.st_dev, found.st_ino


def size(path: Path) -> int:
    """Return how many bytes the file of this name has; 0: none that can be seen."""
    try:
        return os.stat(path).st_size
    except OSError:
        return 0


def moved_to(which: Identity) -> Path | None:
    """Return the name that an open file has now; None: it has none, or the system does not say."""
    with suppress(OSError):
        for entry in _OPEN.iterdir():
            with suppress(OSError):
                name = os.readlink(entry)
                if identity(entry) == which and not name.endswith(_DELETED):
                    return Path(name) if identity(Path(name)) == which else None
    return None
