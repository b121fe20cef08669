"""Reading what people wrote: text, of a size that can be handled, from what is a file."""

from __future__ import annotations

import os
from pathlib import Path

from plutoc.source import LARGEST
from plutoc_runtime.domain.text import printable


class UsageError(Exception):
    """Wrong usage, or a file that cannot be read or written. The text says so to a person."""


def shown(path: Path) -> str:
    """Return a path as a message can say it."""
    return printable(os.fspath(path))


def text_of(path: Path) -> str:
    """Return a file's text, its line ends untouched."""
    try:
        with open(path, "rb", opener=_opened) as file:
            data = file.read(LARGEST + 1)
    except IsADirectoryError:
        raise UsageError(f"{shown(path)} is a folder, not a file") from None
    except FileNotFoundError:
        raise UsageError(f"there is no file {shown(path)}") from None
    except (OSError, ValueError) as error:
        raise UsageError(f"{shown(path)} cannot be read: {why(error)}") from None
    return decoded(data, shown(path))


def _opened(path: str, flags: int) -> int:
    """Open a file without waiting: a pipe without a writer is empty."""
    if not hasattr(os, "O_NONBLOCK"):
        return os.open(path, flags)
    descriptor = os.open(path, flags | os.O_NONBLOCK)
    os.set_blocking(descriptor, True)  # one with a writer is read to its end
    return descriptor


def decoded(data: bytes, name: str) -> str:
    """Return a file's text; raise `UsageError` where it is none, or too much."""
    if len(data) > LARGEST:
        raise UsageError(f"{name} is larger than {LARGEST // 1024} KiB (P0006)")
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise UsageError(f"{name} is not UTF-8 text: see line {line}") from None


def why(error: OSError | ValueError) -> str:
    """Return what the system says of an error."""
    return (isinstance(error, OSError) and error.strerror) or str(error)
