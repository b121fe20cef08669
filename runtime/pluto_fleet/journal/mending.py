"""Repairing a damaged journal: replacing it by one with all rows up to the first missing one."""

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
    """The outcome of a repair."""

    rows: int
    """How many rows there are now, without the header."""
    lost: int
    """How many sound rows are left out because of a missing one before them."""
    kept: Path
    """The path of the damaged journal."""


def mend(path: Path) -> Mended | None:
    """Repair a journal, and keep the damaged one beside it; return None if nothing is damaged."""
    path = Path(os.path.realpath(path))
    kept = beside(path, ".damaged")
    begun = kept.exists() and not path.exists()  # an earlier repair was interrupted
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
    """Return the readable rows, and whether something is damaged."""
    with closing(Reader(path, locked=True)) as reader:
        rows = list(reader.rows())
    return rows, reader.damaged is not None


def _moved(path: Path, kept: Path) -> Path:
    """Rename the damaged journal together with its log, which has its newest rows."""
    number, first = 1, kept
    while os.path.lexists(kept):
        number += 1
        kept = first.with_name(f"{first.name}-{number}")
    path.rename(kept)
    for suffix in ("-wal", "-shm"):
        with suppress(FileNotFoundError):
            beside(path, suffix).rename(beside(kept, suffix))
    return kept
