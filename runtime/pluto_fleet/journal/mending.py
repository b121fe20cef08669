"""Puts a whole journal in the place of a damaged one: of all rows up to the first that is gone."""

from __future__ import annotations

import os
from contextlib import closing, suppress
from dataclasses import dataclass
from itertools import count
from pathlib import Path

from . import errors
from .database import SURELY_LESS_OPENINGS, Row, sync_folder
from .errors import TROUBLE
from .lock import Lock
from .place import beside
from .reader import Reader
from .store import made


@dataclass(frozen=True, slots=True, kw_only=True)
class Mended:
    """What came of it."""

    rows: int
    """How many there are now, beside the header."""
    lost: int
    """How many were whole and are left out, because one before them is not."""
    kept: Path
    """Where the damaged journal is now."""


def mend(path: Path) -> Mended | None:
    """Mend a journal, and keep the damaged one beside it; None: nothing is damaged."""
    path = Path(os.path.realpath(path))
    kept = beside(path, ".damaged")
    begun = kept.exists() and not path.exists()  # it was interrupted before
    try:
        lock = Lock.take(path)
        try:
            rows, damaged = _rows(kept if begun else path)
            if not damaged and not begun:
                return None
            whole = [row for seq, row in zip(count(), rows, strict=False) if row.seq == seq]
            if not whole:
                raise errors.cannot_mend(path, errors.no_header())
            with made(path, whole, whole[-1].epoch + SURELY_LESS_OPENINGS) as part:
                if not begun:
                    kept = _moved(path, kept)
                part.rename(path)
                sync_folder(path)
        finally:
            lock.release()
    except (OSError, *TROUBLE) as error:
        raise errors.cannot_mend(path, errors.why(error)) from None
    return Mended(rows=len(whole) - 1, lost=len(rows) - len(whole), kept=kept)


def _rows(path: Path) -> tuple[list[Row], bool]:
    """Return what can be read, and whether something is damaged."""
    with closing(Reader(path, locked=True)) as reader:
        rows = list(reader.rows())
    return rows, reader.damaged is not None


def _moved(path: Path, kept: Path) -> Path:
    """Give the damaged journal another name, with its log: without it, it would be an older one."""
    number, first = 1, kept
    while os.path.lexists(kept):
        number += 1
        kept = first.with_name(f"{first.name}-{number}")
    path.rename(kept)
    for suffix in ("-wal", "-shm"):
        with suppress(FileNotFoundError):
            beside(path, suffix).rename(beside(kept, suffix))
    return kept
