"""The errors of journals, with their messages."""

from __future__ import annotations

import sqlite3
from errno import EDQUOT, EFBIG, ENOSPC
from pathlib import Path

from .. import __version__
from ..shared.domain.errors import BadInput
from ..shared.domain.text import bounded, counted, printable

TROUBLE = (sqlite3.Error, UnicodeDecodeError)
"""The exceptions of the database; the second where it quotes damaged text."""


class JournalError(BadInput):
    """A journal cannot be created, opened or resumed; nothing acknowledged is lost."""


class Damaged(JournalError):
    """A journal is damaged, at least in part."""


def exists(path: Path) -> JournalError:
    """A new journal would overwrite another."""
    if path.is_dir():
        return is_folder(path)
    return JournalError(
        f"{path}: there is a journal already, or some other file, and it is never overwritten:"
        " go on with a journal by resume, or name another place with --journal"
    )


def missing(path: Path) -> JournalError:
    """The journal does not exist."""
    return JournalError(f"{path}: there is no such journal")


def is_folder(path: Path) -> JournalError:
    """The path is a folder."""
    return JournalError(f"{path}: it is a folder: name the journal, which is a file")


def no_file(path: Path) -> JournalError:
    """The path is a pipe or a device."""
    return JournalError(f"{path}: it is no file: a journal is a file of its own")


def empty(path: Path) -> JournalError:
    """The file is empty."""
    return JournalError(
        f"{path}: the file is empty: it is no journal, and there is nothing to read"
    )


def no_journal(path: Path) -> JournalError:
    """The file is not a journal."""
    return JournalError(f"{path}: it is no journal of an app: nothing in it was read or changed")


def of_another_version(path: Path, version: int, known: int) -> JournalError:
    """The journal was written by a version of the library that writes another format."""
    return JournalError(
        f"{path}: its format is {version}, and pluto-fleet {__version__} reads {known}: install the"
        " pluto-fleet that wrote it"
    )


def in_use(path: Path, pid: int | None) -> JournalError:
    """Another process has it open."""
    who = f"process {pid}" if pid else "another process"
    return JournalError(
        f"{path}: {who} is writing this journal, and only one at a time may: let it end first, or"
        " stop it (the command journal reads beside it)"
    )


def of_another_app(path: Path, theirs: str, ours: str) -> JournalError:
    """The journal belongs to another app."""
    called = printable(bounded(theirs, _LONGEST_NAME))
    return JournalError(
        f"{path}: this is a journal of {called}, and this app is {ours}: use {called}"
    )


_LONGEST_NAME = 80


def cannot_make(path: Path, error: Exception) -> JournalError:
    """The journal cannot be created there."""
    return JournalError(
        f"{path}: the journal cannot be made: {why(error)}; name another place with --journal"
    )


def cannot_open(path: Path, error: Exception) -> JournalError:
    """The journal cannot be opened."""
    return JournalError(f"{path}: the journal cannot be opened: {why(error)}")


def cannot_write(path: Path, error: Exception, seq: int) -> JournalError:
    """A commit failed: nothing is acknowledged from now on."""
    return JournalError(
        f"{path}: the journal cannot be written: {why(error)}. What was written before,"
        f" {counted(seq, 'row')}, is safe, and nothing later counts: make room or mend the disk, then"
        " resume"
    )


def gone(file: Path, now: Path | None, journal: Path) -> JournalError:
    """The journal was deleted or renamed while it was written."""
    if now is not None:
        return JournalError(
            f"{now}: it is part of a journal that is being written, and was moved away from {file}:"
            " move it back, and then resume"
        )
    return JournalError(
        f"{file}: it was deleted while the flight was being written into it: nothing of that flight"
        " can be gone on with"
        + (f"; what {journal.name} itself holds is older" if file != journal else "")
    )


def cut_short(file: Path) -> JournalError:
    """The journal was truncated or overwritten while it was written."""
    return JournalError(
        f"{file}: it was cut short or written over while the flight was being written into it: nothing of"
        " that flight can be gone on with"
    )


def cannot_mend(path: Path, why_not: str) -> JournalError:
    """A damaged journal cannot be repaired, and stays as it is."""
    return JournalError(f"{path}: the journal cannot be mended: {why_not}")


def refused(path: Path, error: Exception) -> JournalError:
    """The database reports an error on reading."""
    if code(error) in (sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_NOTADB, sqlite3.SQLITE_ERROR):
        return damaged(path, f"{why(error)}")
    return cannot_open(path, error)


def why(error: Exception) -> str:
    """Return the reason of an error of the disk."""
    if isinstance(error, OSError):
        if error.errno in (ENOSPC, EDQUOT, EFBIG):
            return "the disk is full"
        return (error.strerror or str(error)).lower()
    if isinstance(error, UnicodeDecodeError):
        return _WHY[sqlite3.SQLITE_CORRUPT]
    return _WHY.get(code(error), str(error))


def code(error: Exception) -> int:
    """Return SQLite's primary error code."""
    number: int = getattr(error, "sqlite_errorcode", sqlite3.SQLITE_CORRUPT)
    return number & 0xFF


_WHY = {
    sqlite3.SQLITE_FULL: "the disk is full",
    sqlite3.SQLITE_READONLY: "it may only be read",
    sqlite3.SQLITE_BUSY: "another program holds it",
    sqlite3.SQLITE_LOCKED: "another program holds it",
    sqlite3.SQLITE_IOERR: "the disk reports an error",
    sqlite3.SQLITE_CANTOPEN: "it may not be opened, or not be written",
    sqlite3.SQLITE_CORRUPT: "its pages do not fit together",
    sqlite3.SQLITE_NOTADB: "its first page is not what was written",
}


def damaged(path: Path, what: str) -> Damaged:
    """The journal is damaged."""
    return Damaged(
        f"{path}: the journal is damaged: {what}. The command journal prints what can be read;"
        " with --mend it makes a whole journal of that, or put back a copy of the file"
    )


def unsound_row(seq: int, last: int) -> str:
    """A row's checksum is wrong."""
    return f"row {seq} of {last} is not what was written{_before(seq)}"


def missing_rows(first: int, until: int, last: int) -> str:
    """Acknowledged rows are missing."""
    rows = f"row {first}" if first == until else f"rows {first} to {until}"
    return f"{rows} of {last} cannot be found{_before(first)}"


def unreadable_from(seq: int, last: int, why_not: str) -> str:
    """Nothing more can be read from a row on."""
    return f"from row {seq} of {last} on it cannot be read ({why_not}){_before(seq)}"


def _before(seq: int) -> str:
    return f"; {counted(seq - 1, 'row')} before it can be read" if seq > 1 else ""


def strange(path: Path, what: str) -> JournalError:
    """The journal holds what was written, and not what an app of this version writes."""
    return JournalError(f"{path}: the journal cannot be used: {what}")


def header_lacks(path: Path, what: str) -> JournalError:
    """The header does not say what is needed to go on."""
    return strange(path, f"its first row lacks {what}")


def unfit(seq: int, error: ValueError) -> str:
    """A row is what was written, and not what this version knows."""
    return f"row {seq} is not as this version knows it: {error}"


def unknown_drone(drone: str) -> str:
    """A mission has a drone that the fleet does not have."""
    name = printable(bounded(drone, _LONGEST_NAME))
    return f"a mission has the drone {name}, which is not in its fleet"


def does_not_follow(kind: str, error: Exception) -> str:
    """An event cannot come after those before it."""
    kind = printable(bounded(kind, _LONGEST_NAME))
    return f"{kind} does not fit to what is said before it ({type(error).__name__})"


def no_header() -> str:
    """The header row is unreadable."""
    return "its first row, which says whose it is, cannot be read"


def no_beginning() -> str:
    """The beginning of the file is damaged."""
    return "the first bytes of the file are not what was written"


def other_tables() -> str:
    """The tables are not those of a journal."""
    return "its tables are not those of a journal"


def lost_log() -> str:
    """Acknowledged parts of the write-ahead log are lost."""
    return "part of what was written last, in the file beside it that ends in -wal, cannot be read"


def torn(seq: int) -> str:
    """The last row is incomplete, and dropped."""
    return (
        f"row {seq}, the last one, is not what was written: it is left out, as if the app had been"
        " killed right before it"
    )


def torn_log() -> str:
    """The last commit in the log is incomplete."""
    return (
        "what was being written last is not whole and is left out: so it is when a machine loses"
        " its power in the middle of it"
    )


def bad_snapshot(seq: int) -> str:
    """A snapshot's checksum is wrong; the rows are used instead."""
    return f"the snapshot of row {seq} is damaged: the rows are read instead"


def unreadable_snapshots() -> str:
    """The snapshots cannot be listed."""
    return "the snapshots cannot be read: the rows are read instead"


def no_home() -> JournalError:
    """The user has no home folder."""
    return JournalError(
        "there is no home folder to keep journals in: name the journal, which for fly is --journal"
    )


def no_default_place(folder: Path, error: OSError) -> JournalError:
    """The folder of journals cannot be created or written."""
    return JournalError(
        f"{folder}: the journal cannot be kept here: {why(error)}; name another place with --journal"
    )


def none_yet(app: str, folder: Path) -> JournalError:
    """There is no newest journal."""
    return JournalError(f"{app}: there is no journal in {folder}: name the one that is meant")
