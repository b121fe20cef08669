"""TOML of a sane size. For a key with dots, `a.b.c`, `tomllib` pays with a copy of all before it."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from ..domain.errors import BadInput

MOST = 100
"""Parts of one key. A plan's longest key has two."""

_WORD = re.compile(
    r"""(?P<key>[A-Za-z0-9_-]+|"(?:[^"\\\n]|\\.)*"|'[^'\n]*')|(?P<dot>\.)|(?P<other>[^ \t])"""
)


def line_of_long_key(text: str) -> int | None:
    """Return the line, from 1, of a key with too many parts; None where there is none."""
    parts, before = 0, None
    for match in _WORD.finditer(text):
        kind = match.lastgroup
        if kind == "dot" and before == "key":
            parts += 1
        elif kind != "key" or before != "dot":
            parts = 0
        if parts == MOST:
            return text.count("\n", 0, match.start()) + 1
        before = kind
    return None


LARGEST = 1 << 20
"""Bytes. A plan is written by people: anything larger is another file."""


def read_toml(path: Path) -> dict[str, Any]:
    """Return what a plan file says; raise `BadInput` if it is no TOML text of a sane size."""
    import tomllib  # the compiler, which asks for long keys alone, reads few files

    try:
        with path.open("rb") as file:
            content = file.read(LARGEST + 1)
        text = content.decode("utf-8-sig")
        if len(content) > LARGEST or line_of_long_key(text):
            raise ValueError("it is larger than 1 MiB, or nested too deep")
        return tomllib.loads(text)
    except OSError as error:
        raise BadInput(f"{path}: cannot be read: {error.strerror or error}") from None
    except (ValueError, RecursionError) as error:
        raise BadInput(f"{path}: is no plan file: {error}") from None
