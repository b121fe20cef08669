"""What may stand in a text or a comment, and what its escapes mean."""

from __future__ import annotations

import re
from collections.abc import Iterator

ESCAPES = {'\\"': '"', "\\\\": "\\"}
"""The only two: a text cannot hold what a screen does not show."""

_ESCAPE = re.compile(r"\\.", re.DOTALL)

_INVISIBLE = (
    "\u00ad\u034f\u061c\u115f\u1160\u17b4\u17b5\u180b-\u180e"  # hyphens, joiners and fillers
    "\u200b\u200e\u200f\u202a-\u202e\u2060-\u206f\u3164\ufeff\uffa0"  # that show nothing,
    "\ufff9-\ufffb\U0001d173-\U0001d17a\U000e0000-\U000e00ff"  # or reorder what a screen shows
)
_JOINERS = "\u200c\u200d"
_VARIANTS = "\ufe00-\ufe0f\U000e0100-\U000e01ef"
_SHOWN = f"(?<=[^\x00-\u02ff{_INVISIBLE}{_JOINERS}])"
"""Behind a letter that joins its neighbour, or an emoji."""

HIDDEN = re.compile(
    r"\r(?!\n)|"  # goes back to the beginning of the line: the text behind it hides the one before
    "["
    "\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f"  # control characters, but tabs and newlines
    "\u2028\u2029"  # ends of lines for some programs only
    f"{_INVISIBLE}"
    "\ud800-\udfff"  # halves of characters: no encoding can write them
    "]|"
    # What joins letters of many scripts or parts of an emoji is seen there, and nowhere else.
    f"(?!{_SHOWN})(?![\ufe0e\ufe0f](?<=[0-9#*].)\u20e3)[{_JOINERS}{_VARIANTS}]"
)
"""Characters that cannot be seen, or that make other ones look as what they are not."""

SPACES = re.compile("[\u00a0\u1680\u2000-\u200a\u202f\u205f\u3000]")
"""Spaces that are none for the language."""


_DIGITS = re.compile(r"(-?[0-9]+(?:\.[0-9]+)?[0-9_]*)([eE]?[0-9]{0,2})")
_MOST_DIGITS = 15


def written_out(quantity: str) -> str | None:
    """Say how a number is written here that other languages write so: `1e9`, `1_000`."""
    from decimal import Decimal  # only for mistakes

    match = _DIGITS.fullmatch("".join(quantity.split()))
    if match is None or not set(match[0]) & set("_eE"):
        return None
    help = "numbers are written out, with digits and a point only"
    plain = format(Decimal(match[0].replace("_", "").rstrip("eE")), "f")
    return f"{help}: `{plain}`" if sum(map(str.isdigit, plain)) <= _MOST_DIGITS else help


def unescaped(quoted: str) -> str:
    """Return what a text says: without its quotes, its escapes resolved."""
    return _ESCAPE.sub(lambda match: ESCAPES.get(match[0], match[0]), quoted[1:-1])


def wrong_escapes(quoted: str) -> Iterator[re.Match[str]]:
    """Find the escapes that mean nothing."""
    return (match for match in _ESCAPE.finditer(quoted) if match[0] not in ESCAPES)
