"""What a journal's file holds: three tables, and a checksum in every row.

The page `docs/journal.md` says the same for other programs.
"""

from __future__ import annotations

from zlib import crc32

APPLICATION = 0x506C7574
"""`Plut`, in the place where SQLite's files say whose they are."""

VERSION = 1
"""Of the format; a reader refuses what is newer."""

TABLES = {
    "journal": """CREATE TABLE journal (
  seq INTEGER PRIMARY KEY, -- 0 is the header; then no number is left out
  epoch INTEGER NOT NULL, -- how often the journal had been opened
  wall INTEGER NOT NULL, -- milliseconds since 1970
  text TEXT NOT NULL, -- the events of one instant: a JSON list of objects
  checksum INTEGER NOT NULL
)""",
    "snapshot": """CREATE TABLE snapshot (
  seq INTEGER PRIMARY KEY, -- it stands for all rows up to this one
  epoch INTEGER NOT NULL,
  wall INTEGER NOT NULL,
  text TEXT NOT NULL,
  checksum INTEGER NOT NULL
)""",
    "tip": """CREATE TABLE tip (
  id INTEGER PRIMARY KEY, -- 0: there is one row
  seq INTEGER NOT NULL, -- of the journal's last row
  epoch INTEGER NOT NULL,
  checksum INTEGER NOT NULL
)""",
}


def row_checksum(seq: object, epoch: object, wall: object, text: bytes) -> int:
    """Return the checksum of a row: of its numbers and its text."""
    return crc32(text, crc32(f"journal {seq} {epoch} {wall} ".encode()))


def snapshot_checksum(seq: object, epoch: object, wall: object, text: bytes) -> int:
    """Return the checksum of a snapshot."""
    return crc32(text, crc32(f"snapshot {seq} {epoch} {wall} ".encode()))


def tip_checksum(seq: object, epoch: object) -> int:
    """Return the checksum of the tip, without which the last rows could be gone unnoticed."""
    return crc32(f"tip {seq} {epoch} ".encode())
