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

    def __init__(self, path: Path, what: str, whole: tuple[Path, str] | None) -> None:
        """`whole` is the newest copy of it that is whole, and when it was made."""
        self.what = what
        back = "there is no whole copy beside it: put back one of yours"
        if whole is not None:
            copied, made = whole
            back = f"its copy of {made} is whole: to go on from that, put {copied} in its place"
        super().__init__(
            f"{path}: the journal is damaged: {what}. The command journal prints what can be read; {back}"
        )


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


def damaged(path: Path, what: str, whole: tuple[Path, str] | None = None) -> Damaged:
    """The journal is damaged."""
    return Damaged(path, what, whole)


def missing_instants(seq: int) -> str:
    """Something that was written is not there."""
    return f"entry {seq} cannot be found"


def strange(path: Path, what: str) -> JournalError:
    """The journal holds what was written, and not what an app of this version writes."""
    return JournalError(f"{path}: the journal cannot be used: {what}")


def header_lacks(path: Path, what: str) -> JournalError:
    """The header does not say what is needed to go on."""
    return strange(path, f"its first row lacks {what}")


def unfit(seq: int, error: ValueError) -> str:
    """An entry is not what this version knows."""
    return f"entry {seq} is not as this version knows it: {error}"


def does_not_follow(seq: int) -> str:
    """An entry cannot come after those before it."""
    return f"entry {seq} does not fit to what is said before it"


def odd_rows(error: Exception) -> str:
    """The rows are no rows."""
    return f"its rows do not fit together ({type(error).__name__})"


def unknown_drone(drone: str) -> str:
    """A mission has a drone that the fleet does not have."""
    name = printable(bounded(drone, _LONGEST_NAME))
    return f"a mission has the drone {name}, which is not in its fleet"


def no_header() -> str:
    """The header row is unreadable."""
    return "its first row, which says whose it is, cannot be read"


def no_beginning() -> str:
    """The beginning of the file is damaged."""
    return "the first bytes of the file are not what was written"


def other_tables() -> str:
    """The tables are not those of a journal."""
    return "its tables are not those of a journal"


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
