"""How a source looks on a terminal: its colours, what to print for each character, and how wide that is.

Terminals disagree about sequences that may melt into one sign: emoji joined by invisible
characters, skin tones, signs that exist with and without colours. So what joins is taken apart:
the width of what is left is the same everywhere, and marks stand under what they mean.
"""

from __future__ import annotations

import unicodedata
from itertools import accumulate

RED, YELLOW, BLUE, CYAN, BOLD = "1;31", "1;33", "1;34", "1;36", "1"


TAB = 4
_NO_WIDTH = frozenset({"Mn", "Me"})
_SELECTORS = range(0xFE00, 0xFE10)
"""Ask for one look or the other of the sign before them."""
_SKIN_TONES = range(0x1F3FB, 0x1F400)
_JOINED_LETTERS = range(0x1160, 0x1200)
"""Vowels and ends of a Korean syllable: they are drawn into its first letter."""


def paint(text: str, code: str, colour: bool) -> str:
    """Return a text in a colour, if colours are wanted."""
    return f"\033[{code}m{text}\033[0m" if colour and text else text


def shown(char: str) -> str:
    """Return what to print for a character: tabs as spaces, and nothing that acts or reorders."""
    if char == "\t":
        return " " * TAB
    if ord(char) in _SELECTORS or ord(char) in _SKIN_TONES:
        return ""
    return char if char.isprintable() else "\N{REPLACEMENT CHARACTER}"


def width(text: str) -> int:
    """Return how many cells of a terminal a text takes, as it is shown."""
    return len(text) if text.isascii() else sum(map(_width, text))


def columns(text: str) -> list[int]:
    """Return the cell at which each character of a line begins, and the one behind the last."""
    return [0, *accumulate(width(shown(char)) for char in text)]


def _width(char: str) -> int:
    if unicodedata.category(char) in _NO_WIDTH or ord(char) in _JOINED_LETTERS:
        return 0
    return 2 if unicodedata.east_asian_width(char) in "WF" else 1
