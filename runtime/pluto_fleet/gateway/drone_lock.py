"""Exclusive access to drones: a lock for each, in a folder that all processes of a user share.

The locks belong to the process that takes them and end with it, so nothing has to be cleaned up after
a crash.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from hashlib import sha256
from pathlib import Path

from ..files.addresses import which
from ..process import locks
from ..process.ipc import is_private
from ..shared.domain.errors import BadInput
from ..shared.domain.text import quoted

LEAVING = 8.0
"""Seconds that a gateway whose drones have landed may take to release them."""

_EACH = 0.05
"""The polling interval, in seconds."""


class DroneInUse(BadInput):
    """Another process commands one of these drones."""


@contextmanager
def lock_drones(
    drones: Mapping[str, str], folder: Path | None = None, patience: float = 0.0
) -> Iterator[None]:
    """Lock these drones, by their ids and URIs; raise `DroneInUse` if another process commands one.

    `folder` is where the locks are; default: where they are for all processes of this user.
    As their last holder may just be ending, it waits for `patience` seconds.
    """
    until = time.monotonic() + patience
    place = folder or _folder()
    locks: dict[str, int] = {}
    owners: dict[str, str] = {}
    try:
        for id, uri in drones.items():
            name = _name(uri)
            if name in locks:
                raise BadInput(f"{owners[name]} and {id} have the same URI {quoted(uri)}")
            owners[name], locks[name] = id, _taken(place / name, id, uri, until)
        yield
    finally:
        for lock in locks.values():
            with suppress(OSError):
                os.close(lock)


def _taken(file: Path, id: str, uri: str, until: float) -> int:
    while (lock := locks.take(file)) is None:
        if time.monotonic() < until:
            time.sleep(_EACH)
            continue
        who = locks.holder(file)
        whose = "another process" if who is None else f"process {who}"
        raise DroneInUse(
            f"{id} ({quoted(uri)}) is commanded by {whose} already, and two must not fly one drone:"
            " stop that flight first, or wait: a minute after its drones are down it lets go of them"
        )
    return lock


def _name(uri: str) -> str:
    """Return the lock file's name, the same for all forms of a drone's URI, whichever dongle it names."""
    return sha256(which(uri).encode("utf-8", "surrogatepass")).hexdigest()[:24]


def _folder() -> Path:
    """Return the folder of this user's locks, which is created if needed."""
    runtime = os.environ.get("XDG_RUNTIME_DIR", "")
    usable = os.path.isabs(runtime) and os.access(runtime, os.W_OK | os.X_OK)
    folder = Path(runtime if usable else tempfile.gettempdir()) / f"pluto-drones-{os.geteuid()}"
    with suppress(FileExistsError):
        folder.mkdir(mode=0o700)
    if not is_private(folder):
        raise BadInput(
            f"{folder}: it must be yours, and no other user may enter it: it says which drones are"
            " commanded; move it away"
        )
    return folder
