"""Putting a new text in the place of a user's source."""

from __future__ import annotations

import os
import shutil
import stat
from pathlib import Path

from plutoc.cli.endings import Unusable
from plutoc.cli.files import shown
from plutoc.emit.write import CannotWrite, Change, Changes, write
from plutoc_runtime.domain.text import printable


def rewrite(path: Path, before: str, after: str) -> None:
    """Replace a source wholly or not at all; raise `Unusable` where that cannot be.

    The new text is written aside and renamed. It keeps the file's permissions; where the path is a
    symbolic link, what it leads to is replaced and the link stays.
    """
    target = Path(os.path.realpath(path))

    def save(aside: str, data: bytes) -> None:
        Path(aside).write_bytes(data)
        shutil.copymode(target, aside)

    change = Change(path=target.name, before=before, after=after)
    try:
        mode = target.stat().st_mode
        if not stat.S_ISREG(mode):
            raise Unusable(f"{shown(path)} is no ordinary file and was not changed")
        # A rename asks nobody for leave to replace a file that must not be written.
        if not (mode & 0o222 and os.access(target, os.W_OK)):
            raise Unusable(f"{shown(path)} is read-only and was not changed")
        write(Changes(folder=target.parent, first=False, files=(change,)), save=save)
    except CannotWrite as error:
        raise Unusable(f"{printable(str(error))}; {shown(path)} was not changed") from None
    except OSError as error:
        why = error.strerror or str(error)
        raise Unusable(f"{shown(path)} cannot be written: {why}") from None
