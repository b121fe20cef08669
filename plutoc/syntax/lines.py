"""A source with mistakes, cut into lines that can be judged one by one.

A line is what stands between two newlines (as layout.py leaves them), or ends with the brace that
opens the app. Which line is which is told by what stands in it, never by what stood before: so a
mistake in one of them costs no other.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from lark import Token

from plutoc.source import Source, Span
from plutoc.syntax.grammar import State, lexed, would_feed
from plutoc.syntax.tokens import BEGINNERS, END, EQUAL, NAME, NEWLINE, made_up, span

_BREAK = re.compile(r"[ \t]*\r?\n[ \t]*")
_WORD = re.compile(r"\w+|->|[^\w\s]")
_LONGEST = 2000
"""In characters: a longer one was not typed on one line, and to read it once more takes time."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """The tokens of a line (at least one), and what ends it."""

    tokens: tuple[Token, ...]
    end: Token

    @property
    def first(self) -> str:
        """The type of its first token."""
        return self.tokens[0].type

    @property
    def span(self) -> Span:
        """Its place."""
        return span(self.tokens[0]).to(span(self.tokens[-1]))

    @property
    def ended(self) -> tuple[Token, ...]:
        """Its tokens, and the newline that ends a statement, but not the beginning of the app."""
        opens = self.tokens[-1].type == "LBRACE" and self.has("APP")
        return self.tokens if opens else (*self.tokens, made_up(NEWLINE, ""))

    def has(self, kind: str) -> bool:
        """Return whether one of its tokens is of that type."""
        return any(token.type == kind for token in self.tokens)


def lines_of(tokens: Sequence[Token]) -> list[Line]:
    """Cut tokens into lines."""
    opens = _opens_the_app(tokens)
    lines: list[Line] = []
    start = 0
    for i, token in enumerate(tokens):
        if token.type in (NEWLINE, END) or i == opens:
            stop = i + 1 if i == opens else i
            if stop > start:
                end = tokens[i + 1] if i == opens else token
                lines.append(Line(tokens=tuple(tokens[start:stop]), end=end))
            start = i + 1
    return lines


def joined(lines: Iterable[Line]) -> Line:
    """Return several lines as one."""
    parts = list(lines)
    return Line(
        tokens=tuple(token for line in parts for token in line.tokens),
        end=parts[-1].end,
    )


def _opens_the_app(tokens: Sequence[Token]) -> int:
    """Return where the brace is that the app's statements stand behind, or -1."""
    first, ends_its_line = None, -1
    for i, token in enumerate(tokens):
        if token.type == NEWLINE:
            first = None
            continue
        first = first or token.type
        if token.type == "LBRACE":
            if first == "APP":
                return i
            if ends_its_line < 0 and (tokens[i + 1].line or 0) > (token.line or 0):
                ends_its_line = i
                first = None
    return ends_its_line


def begins_a_statement(line: Line) -> bool:
    """Return whether a line looks like one of those that stand in an app."""
    second = line.tokens[1].type if len(line.tokens) > 1 else END
    return line.first in BEGINNERS or (line.first == NAME and second in (EQUAL, "_ARROW"))


def goes_on(line: Line) -> bool:
    """Return whether a line can only be the rest of what is in brackets: `limit: 3 min,` or `)`."""
    second = line.tokens[1].type if len(line.tokens) > 1 else END
    return line.first in ("RPAR", "RSQB", "COMMA") or (line.first == NAME and second == "COLON")


def is_split(source: Source, base: State, first: Line, second: Line) -> bool:
    """Return whether two lines are a statement once the break between them is gone."""
    if is_torn(source, base, first, second):
        return True
    return _are_near(source, first, second) and would_feed(base, joined([first, second]).ended)


def is_torn(source: Source, base: State, first: Line, second: Line) -> bool:
    """Return whether two lines are a statement once a word with a break in it is whole again."""
    if not _are_near(source, first, second):
        return False
    text = source.quote(first.span.to(second.span))
    return would_feed(base, lexed(text.replace("\r", "").replace("\n", "")))


def _are_near(source: Source, first: Line, second: Line) -> bool:
    middle = source.text[first.span.end : second.span.start]
    short = second.span.end - first.span.start <= _LONGEST
    return short and _BREAK.fullmatch(middle) is not None


def is_shifted(source: Source, first: Line, below: State, second: Line) -> bool:
    """Return whether the last letter of a line stands at the beginning of the next one."""
    letter, *rest = second.tokens
    if first.tokens[-1].type != NAME or letter.type != NAME or len(letter) > 1 or not rest:
        return False
    if source.text[first.span.end : second.span.start] != "\n":
        return False
    return would_feed(below, Line(tokens=tuple(rest), end=second.end).ended)


def is_exchanged(source: Source, above: State, first: Line, below: State, second: Line) -> bool:
    """Return whether both lines are in order once the words beside the break change places."""
    left, right = source.quote(first.span), source.quote(second.span)
    if len(left) + len(right) > _LONGEST:
        return False
    last, head = str(first.tokens[-1]), _WORD.match(right)
    if head is None or not left.endswith(last):
        return False
    return would_feed(above, lexed(left.removesuffix(last) + head[0])) and would_feed(
        below, lexed(last + right[head.end() :])
    )
