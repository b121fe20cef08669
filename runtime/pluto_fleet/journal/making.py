"""Writes a whole journal into a file of its own, before it gets its name."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from contextlib import closing, contextmanager
from pathlib import Path

from .database import connect
from .format import APPLICATION, TABLES, VERSION, row_checksum, tip_checksum
from .place import beside
from .reading import Row


@contextmanager
def made(path: Path, rows: Sequence[Row], epoch: int) -> Iterator[Path]:
    """Give a file beside this path that holds these rows; it goes if it gets no other name."""
    part = beside(path, f".{os.getpid()}.part")
    part.unlink(missing_ok=True)
    try:
        with closing(connect(part, "mode=rwc")) as database:
            database.execute("PRAGMA synchronous = FULL")
            database.execute(f"PRAGMA application_id = {APPLICATION}")
            database.execute(f"PRAGMA user_version = {VERSION}")
            database.execute("BEGIN IMMEDIATE")
            for table in TABLES.values():
                database.execute(table)
            database.executemany("INSERT INTO journal VALUES (?, ?, ?, ?, ?)", map(_columns, rows))
            last = rows[-1].seq
            tip = last, epoch, tip_checksum(last, epoch)
            database.execute("INSERT INTO tip VALUES (0, ?, ?, ?)", tip)
            database.execute("COMMIT")
            database.execute("PRAGMA journal_mode = WAL")
        yield part
    finally:
        part.unlink(missing_ok=True)


def _columns(row: Row) -> tuple[int, int, int, str, int]:
    wall = round(row.wall * 1000)
    checksum = row_checksum(row.seq, row.epoch, wall, row.text.encode())
    return row.seq, row.epoch, wall, row.text, checksum
