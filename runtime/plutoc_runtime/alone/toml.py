"""Finds TOML keys with too many parts, for which `tomllib` takes quadratic time.

For the compiler and the library; apps do not carry it.
"""

from __future__ import annotations

import re

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
