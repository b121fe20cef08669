"""Characters of other languages and of word processors, and what is written here in their place."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from lark import Token

from plutoc.diagnostic import Diagnostic, Fix
from plutoc.source import Source, Span
from plutoc.syntax import errors
from plutoc.syntax.grammar import parser
from plutoc.syntax.state import State, span, would_feed
from plutoc.syntax.texts import HIDDEN, SPACES

_ARROW = re.compile(r"[=\-‐‑–—−~]+[>›≥]|[→⇒⟶⟹➔➜➝⇨]")
_LONGEST = 2000
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
    return would_feed(base, parser().lex(_ARROW.sub("->", line.replace(";", " "))))


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
    if char == ";" and i == len(tokens) - 2:
        return _replaced(source, here, "", "a statement ends with its line: write no `;`")
    if SPACES.fullmatch(char):
        return _replaced(source, here, " ", "write an ordinary space")
    if HIDDEN.match(text, here.start) and char != "\r":
        return _replaced(source, here, "", "remove it: nobody sees it")
    return None


def _replaced(source: Source, where: Span, text: str, help: str) -> Diagnostic:
    return errors.unknown_character(source, where, help, Fix(span=where, text=text))
