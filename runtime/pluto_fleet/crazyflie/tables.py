"""Where tables of contents are kept: they take seconds over the radio, and change with the firmware."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from ..process.ipc import is_private

_NAME = "crazyflie"


def kept_in(flight: Path) -> str | None:
    """Return a folder for them: the user's own cache, else one of this flight, else None.

    cflib runs what it finds there, so nobody else may write it.
    """
    with suppress(OSError, RuntimeError):  # there is no home folder
        given = os.environ.get("XDG_CACHE_HOME", "")
        base = Path(given) if os.path.isabs(given) else Path.home() / ".cache"
        folder = base / "pluto" / _NAME
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if folder.is_absolute() and is_private(folder) and os.access(folder, os.W_OK):
            return str(folder)
    with suppress(OSError):
        folder = flight / _NAME
        folder.mkdir(mode=0o700, exist_ok=True)
        if is_private(folder):
            return str(folder)
    return None
