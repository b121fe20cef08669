"""Whether two lines with a mistake are one mistake, at the break between them."""

from __future__ import annotations

import re

from plutoc.source import Source
from plutoc.syntax.grammar import parser
from plutoc.syntax.lines import Line, joined
from plutoc.syntax.state import State, would_feed

_BREAK = re.compile(r"[ \t]*\r?\n[ \t]*")
_LONGEST = 2000
"""In characters: nobody wrote a longer statement on one line, and it would be read once more."""


def is_split(source: Source, base: State, first: Line, second: Line) -> bool:
    """Say whether two lines are a statement once the break between them is gone."""
    if is_torn(source, base, first, second):
        return True
    return _are_near(source, first, second) and would_feed(base, joined([first, second]).ended)


def is_torn(source: Source, base: State, first: Line, second: Line) -> bool:
    """Say whether two lines are a statement once a word with a break in it is whole again."""
    if not _are_near(source, first, second):
        return False
    text = source.quote(first.span.to(second.span))
    return would_feed(base, parser().lex(text.replace("\r", "").replace("\n", "")))


def _are_near(source: Source, first: Line, second: Line) -> bool:
    middle = source.text[first.span.end : second.span.start]
    short = second.span.end - first.span.start <= _LONGEST
    return short and _BREAK.fullmatch(middle) is not None


def is_exchanged(above: State, first: Line, below: State, second: Line) -> bool:
    """Say whether both lines are in order once the words beside the break change places."""
    *one, last = first.tokens
    head, *other = second.tokens
    changed = (
        Line(tokens=(*one, head), end=first.end),
        Line(tokens=(last, *other), end=second.end),
    )
    return would_feed(above, changed[0].ended) and would_feed(below, changed[1].ended)
