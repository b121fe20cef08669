"""What is at the places of a package's files: nothing, files, or something that is in the way.

By the system's own calls, and as few of them as can be: there are hundreds of files, and most of
them are as they shall be.
"""

from __future__ import annotations

import os
import stat
from pathlib import Path

_TO_READ = (
    os.O_RDONLY
    | getattr(os, "O_BINARY", 0)
    | getattr(os, "O_NOFOLLOW", 0)
    | getattr(os, "O_NONBLOCK", 0)
)
"""Through no link, and without waiting for what comes out of a pipe: it may have come just now."""
_AT_ONCE = 1 << 20


class InTheWay(Exception):
    """A file cannot be written through what is there: a link, or what is no folder."""

    def __init__(self, path: str, is_on_the_way: bool) -> None:
        self.place = Path(path)
        self.is_on_the_way = is_on_the_way


def facts_of(top: str, path: str, passed: set[str]) -> os.stat_result | None:
    """Return the facts of a file, None where there is none; raise `InTheWay` where none can be.

    Folders on the way that can be, or are there, are added to `passed`, and not looked at again.
    """
    parent, _, _ = path.rpartition("/")
    if parent not in passed:
        parts = parent.split("/") if parent else []
        for number in range(1, len(parts) + 1):
            one = os.path.join(top, *parts[:number])
            facts = _stat(one)
            if facts is not None and not stat.S_ISDIR(facts.st_mode):
                raise InTheWay(one, is_on_the_way=True)
        passed.add(parent)
    target = os.path.join(top, path)
    facts = _stat(target)
    if facts is not None and not stat.S_ISREG(facts.st_mode):
        raise InTheWay(target, is_on_the_way=False)
    return facts


def held(target: str, facts: os.stat_result | None) -> bytes | None:
    """Return what a file holds, of which these facts were known; None where there is none."""
    if facts is None:
        return None
    try:
        handle = os.open(target, _TO_READ)
    except FileNotFoundError:
        return None
    try:
        data = os.read(handle, facts.st_size + 1)
        while more := os.read(handle, _AT_ONCE):
            data += more
        return data
    finally:
        os.close(handle)


def _stat(path: str) -> os.stat_result | None:
    try:
        return os.lstat(path)
    except (FileNotFoundError, NotADirectoryError):
        return None
