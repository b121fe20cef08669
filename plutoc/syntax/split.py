"""Whether two lines with a mistake are one mistake, at the break between them."""

from __future__ import annotations

import re

from plutoc.source import Source
from plutoc.syntax.lex import lexed
from plutoc.syntax.lines import Line, joined
from plutoc.syntax.newlines import NAME
from plutoc.syntax.state import State, would_feed

_BREAK = re.compile(r"[ \t]*\r?\n[ \t]*")
_WORD = re.compile(r"\w+|->|[^\w\s]")
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
    return would_feed(base, lexed(text.replace("\r", "").replace("\n", "")))


def _are_near(source: Source, first: Line, second: Line) -> bool:
    middle = source.text[first.span.end : second.span.start]
    short = second.span.end - first.span.start <= _LONGEST
    return short and _BREAK.fullmatch(middle) is not None


def is_shifted(source: Source, first: Line, below: State, second: Line) -> bool:
    """Say whether the last letter of a line stands at the beginning of the next one."""
    letter, *rest = second.tokens
    if first.tokens[-1].type != NAME or letter.type != NAME or len(letter) > 1 or not rest:
        return False
    if source.text[first.span.end : second.span.start] != "\n":
        return False
    return would_feed(below, Line(tokens=tuple(rest), end=second.end).ended)


def is_exchanged(source: Source, above: State, first: Line, below: State, second: Line) -> bool:
    """Say whether both lines are in order once the words beside the break change places."""
    left, right = source.quote(first.span), source.quote(second.span)
    if len(left) + len(right) > _LONGEST:
        return False
    last, head = str(first.tokens[-1]), _WORD.match(right)
    if head is None or not left.endswith(last):
        return False
    return would_feed(above, lexed(left.removesuffix(last) + head[0])) and would_feed(
        below, lexed(last + right[head.end() :])
    )
