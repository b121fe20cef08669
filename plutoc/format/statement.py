"""How one statement is laid out: its words → a document.

A comment keeps its place among the words, so a line ends behind it wherever it stands; elsewhere a
statement is broken only if it is too long: in its brackets, an element a line, and before arrows.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from plutoc.format.document import (
    NEWLINE,
    NOTHING,
    SPACE,
    Document,
    Group,
    IfBroken,
    Indent,
    Remark,
)
from plutoc.format.words import Word
from plutoc.syntax.tokens import ARROW, CLOSING, EQUAL, NAME, OPENING

_TIGHT_BEFORE = frozenset({"COLON", "DOT", "LPAR", *CLOSING})
_TIGHT_BEHIND = frozenset({"DOT", *OPENING})
_LISTED = frozenset({NAME, "TEXT"})
"""What lists without brackets consist of: a comma before anything else ends one, and is left out."""


def statement(words: Sequence[Word]) -> Document:
    """Lay out a statement; what stands behind its last word is not part of it."""
    first, *stops = _stops(words)
    if not stops:
        return _run(first)
    arrows: list[Document] = []
    for before, stop in zip([first, *stops], stops, strict=False):
        arrows.append((_comments(before[-1]), SPACE, "-> ", _run(stop)))
    return Group((_run(first), Indent(tuple(arrows))))


def _stops(words: Sequence[Word]) -> Iterator[Sequence[Word]]:
    """Split at the arrows."""
    start = 0
    for i, word in enumerate(words):
        if word.kind == ARROW:
            yield words[start:i]
            start = i + 1
    yield words[start:]


def _run(words: Sequence[Word], *, in_brackets: bool = False, goes_on: bool = False) -> Document:
    """Lay out words that follow one another; `goes_on`: the first begins a line, indented already.

    Inside brackets a line must not begin with `NAME =`, which would close them: what stands so is
    broken before the `=`, too.
    """
    parts: list[Document] = []
    i = 0
    while i < len(words):
        begin, i = i, _behind(words, i)
        parts.append(words[begin].text if i == begin + 1 else _brackets(words[begin:i]))
        if i == len(words):
            break
        word, then = words[i - 1], words[i]
        closes = goes_on and begin == 0 and (word.kind, then.kind) == (NAME, EQUAL)
        if in_brackets and (_has_comments(word) or closes):
            rest = (_comments(word), NEWLINE, _run(words[i:], in_brackets=True, goes_on=True))
            parts.append(rest if goes_on else Indent(rest))
            break
        if word.comma and then.kind in _LISTED:
            parts.append(",")
        if then.kind not in _TIGHT_BEFORE and word.kind not in _TIGHT_BEHIND:
            parts.append(" ")
    return tuple(parts)


def _brackets(words: Sequence[Word]) -> Document:
    """Lay out what stands in brackets, with these."""
    opening, *inside, closing = words
    content: list[Document] = [_below(opening)]
    items = list(_items(inside))
    for i, item in enumerate(items):
        comma = "," if i + 1 < len(items) else IfBroken(",")
        run = _run(item, in_brackets=True)
        content.append((SPACE if i else NOTHING, run, comma, _comments(item[-1])))
    if not items and not _has_comments(opening):
        return opening.text + closing.text
    content_and_end = (Indent(tuple(content)), NOTHING, closing.text)
    return Group((opening.text, _beside(opening), *content_and_end))


def _items(words: Sequence[Word]) -> Iterator[Sequence[Word]]:
    """Split at the commas that are in no brackets of their own."""
    start = i = 0
    while i < len(words):
        i = _behind(words, i)
        if words[i - 1].comma or i == len(words):
            yield words[start:i]
            start = i


def _behind(words: Sequence[Word], i: int) -> int:
    """Return where what begins at the i-th word ends: behind it, or behind the bracket it opens."""
    depth = 0
    for at in range(i, len(words)):
        depth += (words[at].kind in OPENING) - (words[at].kind in CLOSING)
        if not depth:
            return at + 1
    raise AssertionError("in a sound source every bracket is closed")


def _has_comments(word: Word) -> bool:
    return word.beside is not None or any(word.below)


def _comments(word: Word) -> Document:
    return (_beside(word), _below(word))


def _beside(word: Word) -> Document:
    return Remark(word.beside) if word.beside is not None else ()


def _below(word: Word) -> Document:
    """Each comment on its line; within a statement blank lines are not kept."""
    return tuple((NEWLINE, comment) for comment in word.below if comment)
