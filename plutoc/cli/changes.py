"""A source that is changed in its place."""

from __future__ import annotations

import os
import shutil
import stat
from pathlib import Path

from plutoc.cli.endings import UsageError
from plutoc.emit.write import CannotWrite, Change, Changes, write
from plutoc.project.reading import shown, why
from plutoc_runtime.domain.text import printable


def rewrite(path: Path, before: str, after: str) -> None:
    """Replace a source wholly or not at all; raise `UsageError` where that cannot be.

    The new text is written aside and renamed. It keeps the file's permissions; where the path is a
    symbolic link, what it leads to is replaced and the link stays.
    """
    target = Path(os.path.realpath(path))

    def save(aside: Path, data: bytes) -> None:
        aside.write_bytes(data)
        shutil.copymode(target, aside)

    change = Change(path=target.name, before=before, after=after)
    try:
        mode = target.stat().st_mode
        if not stat.S_ISREG(mode):
            raise UsageError(f"{shown(path)} is no ordinary file and was not changed")
        # A rename would replace a read-only file, too.
        if not (mode & 0o222 and os.access(target, os.W_OK)):
            raise UsageError(f"{shown(path)} is read-only and was not changed")
        write(Changes(folder=target.parent, first=False, files=(change,)), save=save)
    except CannotWrite as error:
        raise UsageError(f"{printable(str(error))}; {shown(path)} was not changed") from None
    except OSError as error:
        raise UsageError(f"{shown(path)} cannot be written: {why(error)}") from None
