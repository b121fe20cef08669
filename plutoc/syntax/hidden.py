"""Characters that nobody sees, which a text and a comment may not hold."""

from __future__ import annotations

import re

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
