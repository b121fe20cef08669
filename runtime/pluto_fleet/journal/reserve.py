"""Room on the disk that is kept back, so that the last words can be written when there is no other."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from .place import beside

RESERVE = 256 * 1024
"""Bytes."""


def keep_back(path: Path) -> None:
    """Take up room beside a journal, all or none."""
    try:
        with beside(path, ".reserve").open("wb") as file:
            file.write(os.urandom(RESERVE))  # no file system makes less of it
            file.flush()
            os.fsync(file.fileno())
    except OSError:
        give_back(path)
        raise


def give_back(path: Path) -> None:
    """Let the room be used."""
    with suppress(OSError):
        beside(path, ".reserve").unlink()
