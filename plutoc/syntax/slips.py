"""Characters of other languages and of word processors, and what is written here in their place."""

from __future__ import annotations

import re
from collections.abc import Sequence

from lark import Token

from plutoc.diagnostic import Diagnostic, Fix
from plutoc.source import Source, Span
from plutoc.syntax import errors
from plutoc.syntax.state import span
from plutoc.syntax.texts import HIDDEN, SPACES

_ARROW = re.compile(r"[=\-‐‑–—−~]+[>›≥]|[→⇒⟶⟹➔➜➝⇨]")
_QUOTED = re.compile(r"'([^'\"\\\n]*)'|[“”„«‘‚]([^“”„«»‘’‚\"\\\n]*)[“”»’‘]")


def slip(source: Source, tokens: Sequence[Token], i: int) -> Diagnostic | None:
    """Explain a character that is no part of the language, if it is clear what was meant."""
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
    if char == ";" and i == len(tokens) - 2:
        return _replaced(source, here, "", "a statement ends with its line: write no `;`")
    if SPACES.fullmatch(char):
        return _replaced(source, here, " ", "write an ordinary space")
    if HIDDEN.match(text, here.start) and char != "\r":
        return _replaced(source, here, "", "remove it: nobody sees it")
    return None


def _replaced(source: Source, where: Span, text: str, help: str) -> Diagnostic:
    return errors.unknown_character(source, where, help, Fix(span=where, text=text))
