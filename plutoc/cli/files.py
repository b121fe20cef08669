"""Reading the apps that the command line names."""

from __future__ import annotations

import sys
from pathlib import Path

from plutoc.project.reading import UsageError, decoded, shown, text_of, why
from plutoc.source import LARGEST, Source

STANDARD_INPUT = Path("-")
_OTHER_FILES = (".toml", ".py")
"""What lies beside an app, and is easily given in its place."""


def read_app(path: Path) -> Source:
    """Read a `.pluto` file; raise `UsageError` where there is nothing to parse."""
    if path.suffix.lower() in _OTHER_FILES:
        raise UsageError(f"{shown(path)} is no app: an app is a file whose name ends with .pluto")
    return Source(shown(path), text_of(path))


def read_standard_input() -> Source:
    """Read an app from standard input; raise `UsageError` where there is nothing to parse."""
    name = "standard input"
    if sys.stdin is None:
        raise UsageError(f"{name} is closed")
    try:
        data = sys.stdin.buffer.read(LARGEST + 1)
    except (OSError, ValueError) as error:
        raise UsageError(f"{name} cannot be read: {why(error)}") from None
    return Source("<stdin>", decoded(data, name))
