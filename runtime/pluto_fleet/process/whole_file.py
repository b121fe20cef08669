"""Replacing a file as a whole: after a crash it is the old one or the new one."""

from __future__ import annotations

import os
from pathlib import Path


def write_whole(
    path: Path, content: bytes | str, *, mode: int = 0o600, durable: bool = False
) -> None:
    """Replace a file, or create it with just these permissions; raise `OSError` if that fails.

    `durable`: so after a power cut, too.
    """
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    data = content.encode() if isinstance(content, str) else content
    try:
        descriptor = os.open(part, os.O_WRONLY | os.O_CREAT | os.O_TRUNC | os.O_NOFOLLOW, mode)
        with open(descriptor, "wb") as file:
            os.fchmod(descriptor, mode)
            file.write(data)
            file.flush()
            if durable:
                os.fsync(descriptor)
        os.replace(part, path)
    except OSError:
        part.unlink(missing_ok=True)
        raise
    if durable:
        settle(path.parent)


def settle(folder: Path) -> None:
    """Sync a folder, so that its new names are durable."""
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
