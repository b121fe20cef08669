"""The paths of journals, and of the files beside them."""

from __future__ import annotations

import os
import time
from contextlib import suppress
from pathlib import Path

from . import errors

ENDING = ".journal"


def beside(path: Path, suffix: str) -> Path:
    """Return the path of a file or folder that goes with a journal: `.lock`, `.gateway`."""
    return path.with_name(path.name + suffix)


def gateway_folder(path: Path) -> Path:
    """Return the folder of this journal's gateway."""
    return beside(path, ".gateway")


def commands_note(journal: Path) -> Path:
    """Return the note with the address for commands to a journal's app."""
    return gateway_folder(Path(os.path.realpath(journal))) / "brain"


def new(app: str, now: float) -> Path:
    """Return the default path of a new journal.

    Creates the folder, accessible to this user only.
    """
    return new_in(folder_of(app), now)


def new_in(folder: Path, now: float) -> Path:
    """Return the same in a given folder."""
    try:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        if not os.access(folder, os.W_OK | os.X_OK):
            raise PermissionError(0, "it may only be read")
    except OSError as error:
        raise errors.no_default_place(folder, error) from None
    begun = time.strftime("%Y-%m-%d-%H%M%S", time.localtime(now))
    path, number = folder / f"{begun}{ENDING}", 1
    while os.path.lexists(path) or os.path.lexists(
        beside(path, ".lock")
    ):  # another one is just being created
        number += 1
        path = folder / f"{begun}-{number}{ENDING}"
    return path


def newest(app: str) -> Path:
    """Return the latest journal in the default folder."""
    folder = folder_of(app)
    path = newest_in(folder)
    if path is None:
        raise errors.none_yet(app, folder)
    return path


def newest_in(folder: Path) -> Path | None:
    """Return the latest journal in a folder, or None."""
    found: list[tuple[int, str, Path]] = []
    with suppress(OSError):
        for path in folder.glob(f"*{ENDING}"):
            with suppress(OSError):
                found.append((written(path), path.name, path))
    return max(found)[2] if found else None


def written(path: Path) -> int:
    """Return when a journal was written last, in nanoseconds since 1970."""
    latest = path.stat().st_mtime_ns
    with suppress(OSError):
        latest = max(latest, beside(path, "-wal").stat().st_mtime_ns)
    return latest


def folder_of(app: str) -> Path:
    """Return the default folder of an app's journals."""
    state = Path(os.environ.get("XDG_STATE_HOME", ""))
    if not state.is_absolute():  # it is not set
        home = Path(os.path.expanduser("~"))
        if not home.is_absolute() or os.environ.get("HOME") == "":
            raise errors.no_home()
        state = home / ".local" / "state"
    return state / "pluto" / app
