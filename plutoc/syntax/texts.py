"""What may stand in a text or a comment, and what its escapes mean."""

from __future__ import annotations

import re
from collections.abc import Iterator

ESCAPES = {'\\"': '"', "\\\\": "\\"}
"""The only two: a text cannot hold what a screen does not show."""

_ESCAPE = re.compile(r"\\.", re.DOTALL)

HIDDEN = re.compile(
    r"\r(?!\n)|"  # goes back to the beginning of the line: the text behind it hides the one before
    "["
    "\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f"  # control characters, but tabs and newlines
    "\u2028\u2029"  # ends of lines for some programs only
    "\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069"  # reorder what a screen shows
    "\ufeff"  # a byte order mark, in the middle of a file
    "\ud800-\udfff"  # halves of characters: no encoding can write them
    "]"
)
"""Characters that cannot be seen, or that make other ones look as what they are not."""


def unescaped(quoted: str) -> str:
    """Return what a text says: without its quotes, its escapes resolved."""
    return _ESCAPE.sub(lambda match: ESCAPES.get(match[0], match[0]), quoted[1:-1])


def wrong_escapes(quoted: str) -> Iterator[re.Match[str]]:
    """Find the escapes that mean nothing."""
    return (match for match in _ESCAPE.finditer(quoted) if match[0] not in ESCAPES)
