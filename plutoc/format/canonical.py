"""A sound text → its canonical form."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from plutoc.format.document import written
from plutoc.format.statement import statement
from plutoc.format.words import LBRACE, RBRACE, read

WIDTH = 100
"""In characters. Comments, texts and names may be longer, and are never broken."""
STEP = 2
"""How far each level is indented."""


@dataclass(frozen=True, slots=True)
class _Row:
    """A statement, a brace, or a comment on a line of its own."""

    text: str
    blank: bool
    """A blank line comes before it."""


def canonical(text: str) -> str:
    """Write a text anew: what it says, and its comments, in the one form that they have."""
    before, lines = read(text)
    rows = list(_comments(before, 0, first=True))
    depth = 0
    above_app = 0
    for words in lines:
        first, last = words[0], words[-1]
        if first.kind == RBRACE:
            depth = 0
        blank = rows.pop().blank and first.kind != RBRACE
        document = statement(words)
        row = written(document, indent=depth * STEP, step=STEP, width=WIDTH)
        if last.beside is not None:
            row += "  " + last.beside
        rows.append(_Row(" " * depth * STEP + row, blank))
        if last.kind == LBRACE:
            depth = 1
            _set_apart(rows, above_app)
        above_app = len(rows)
        rows += _comments(last.below, depth, first=last.kind == LBRACE)
    rows.pop()
    return "".join(f"\n{row.text}\n" if row.blank else f"{row.text}\n" for row in rows)


def _comments(below: Sequence[str], depth: int, *, first: bool) -> Iterator[_Row]:
    """Yield the rows of comments, and an empty last one: is there a blank line behind them?"""
    blank = False
    for comment in below:
        if comment:
            yield _Row(" " * depth * STEP + comment, blank and not first)
            first = blank = False
        else:
            blank = True
    yield _Row("", blank and not first)


def _set_apart(rows: list[_Row], start: int) -> None:
    """Put a blank line somewhere before the app, above its comments if there is none."""
    if not any(row.blank for row in rows[start:]):
        rows[start] = replace(rows[start], blank=True)
