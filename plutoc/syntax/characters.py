"""Characters that are no part of the language: what cannot be seen, and what word processors write."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Sequence
from dataclasses import replace

from lark import Token

from plutoc.diagnostic import Diagnostic, Fix
from plutoc.source import Source, Span
from plutoc.syntax import errors
from plutoc.syntax.grammar import State, lexed, would_feed
from plutoc.syntax.hints import conflict
from plutoc.syntax.tokens import NAME, span

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

_ARROW = re.compile(r"[=\-‐‑–—−~－＝]+[>›≥＞]|[→⇒⟶⟹➔➜➝⇨]")
_LONGEST = 2000
_CONFLICT = 7
"""The length of the marks that a merge leaves."""
_PLAIN = {chr(ord(char) + 0xFEE0): char for char in '#%(),:=[]{}"'} | {"、": ","}
"""Signs as wide as Chinese characters, as their keyboards write them."""
_WIDE = str.maketrans(_PLAIN)
_QUOTED = re.compile(r"'([^'\"\\\n]*)'|[“”„«‘‚]([^“”„«»‘’‚\"\\\n]*)[“”»’‘]")


def slip(source: Source, base: State, tokens: Sequence[Token], i: int) -> Diagnostic | None:
    """Explain a character that is no part of the language, if it is clear what was meant.

    Its fix is there only if the line is in order after it.
    """
    found = _slip(source, tokens, i)
    if found is None or found.fix is None or _mends(source, base, tokens, found.fix):
        return found
    return replace(found, fix=None)


def _mends(source: Source, base: State, tokens: Sequence[Token], fix: Fix) -> bool:
    start, end = span(tokens[0]).start, source.text.find("\n", fix.span.end)
    line = source.text[start : fix.span.start] + fix.text + source.text[fix.span.end : end]
    if end < 0 or len(line) > _LONGEST:
        return False
    # One of several is a mend, too.
    plain = _ARROW.sub("->", line.replace(";", " ")).translate(_WIDE)
    return would_feed(base, lexed(plain))


def _slip(source: Source, tokens: Sequence[Token], i: int) -> Diagnostic | None:
    here, text = span(tokens[i]), source.text
    begin = span(tokens[i - 1]).start if i else here.start  # `=>` is an `=` and a `>`
    arrow = _ARROW.match(text, here.start) or _ARROW.match(text, begin)
    if arrow and arrow.end() > here.start:
        return _replaced(source, Span(*arrow.span()), "->", "an arrow is written `->`")
    quoted = _QUOTED.match(text, here.start)
    if quoted:
        plain = f'"{quoted[1] or quoted[2] or ""}"'
        help = 'texts stand in straight double quotes: `"text"`'
        return _replaced(source, Span(*quoted.span()), plain, help)
    if text.startswith("//", here.start):
        two = Span(here.start, here.start + 2)
        return _replaced(source, two, "#", "a comment begins with `#`")
    char = text[here.start]
    merge = conflict(text, here.start)
    if merge:
        line = Span(here.start, min(here.start + _CONFLICT, len(text)))
        return errors.unknown_character(source, line, merge)
    beside = None if char in _PLAIN else _between(tokens, i, char)
    if beside:
        return errors.unknown_character(source, here, beside)
    if char in _PLAIN:
        return _replaced(source, here, _PLAIN[char], f"write the ordinary `{_PLAIN[char]}`")
    if char == ";" and i == len(tokens) - 2:
        return _replaced(source, here, "", "a statement ends with its line: write no `;`")
    if SPACES.fullmatch(char):
        return _replaced(source, here, " ", "write an ordinary space")
    if HIDDEN.match(text, here.start) and char != "\r":
        return _replaced(source, here, "", "remove it: it cannot be seen")
    return None


def _between(tokens: Sequence[Token], i: int, char: str) -> str | None:
    """Explain a sign by what stands on its two sides."""
    if not 0 < i < len(tokens) - 1:
        return None
    left, here, right = tokens[i - 1], tokens[i], tokens[i + 1]
    touches = left.end_pos == here.start_pos and here.end_pos == right.start_pos
    names = left.type == right.type == NAME
    if left.type == NAME and left.end_pos == here.start_pos and _is_picture(char):
        return "names have only the letters a to z, digits and `_`"
    if char == "-" and names and right.isupper() and not left.isupper():
        return f"write `when {right}` at the end of the statement"
    if char == "-" and names and touches:
        return f"a name has no `-`: for instance `{left}_{right}`; an arrow is written `->`"
    if char == "<" and right[:1] == "-":
        return "arrows point to the right: write `A -> B` instead of `B <- A`"
    if char == "/" and left.type == "QUANTITY" and right.type == NAME:
        return f"a unit has no space in it: `{left}/{right}`"
    if char == "/" and left.type == "NUMBER":
        return "a fraction is written with a point: `0.5`"
    return None


def _is_picture(char: str) -> bool:
    return char > "\u2000" and unicodedata.category(char) == "So"


def _replaced(source: Source, where: Span, text: str, help: str) -> Diagnostic:
    return errors.unknown_character(source, where, help, Fix(span=where, text=text))
