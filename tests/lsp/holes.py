"""Holes cut into the examples, and what is offered there."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from plutoc.diagnostic import Severity
from plutoc.service.completion.complete import complete
from plutoc.service.document import Document
from plutoc.service.symbols import occurrences
from plutoc.source import Span
from plutoc.syntax.grammar import lexed
from tests.paths import ROOT

EXAMPLES = sorted((ROOT / "examples").glob("*/app.pluto"))
FIRST = 5
UNIT = "unit"


@dataclass(frozen=True, kw_only=True)
class Cut:
    """A word of an example that is taken out, but for its first letters."""

    path: Path
    text: str
    span: Span
    role: str
    kept: int = 0

    @property
    def word(self) -> str:
        return self.text[self.span.start : self.span.end]

    @property
    def left(self) -> str:
        """The text without it."""
        return self.text[: self.span.start + self.kept] + self.text[self.span.end :]

    @property
    def offset(self) -> int:
        return self.span.start + self.kept


def words(path: Path) -> Iterator[Cut]:
    """Give all words of an example that name something, and all units."""
    text = path.read_text(encoding="utf-8")
    document = Document(path=str(path), text=text)
    for one in occurrences(document.file):
        yield Cut(path=path, text=text, span=one.span, role=one.role.value)
    for token in lexed(text):
        if token.type == "QUANTITY":
            unit = token.lstrip("-0123456789.").strip()
            end = token.end_pos or 0
            yield Cut(path=path, text=text, span=Span(end - len(unit), end), role=UNIT)


def cuts(number: int, seed: int = 0) -> list[Cut]:
    """Draw different holes: every word whole, and as many of them begun."""
    whole = [cut for path in EXAMPLES for cut in words(path)]
    chance = random.Random(seed)
    begun = [
        Cut(path=cut.path, text=cut.text, span=cut.span, role=cut.role, kept=kept)
        for cut in whole
        for kept in range(1, len(cut.word))
        if cut.role != UNIT or cut.word.isalpha()
    ]
    drawn = whole if len(whole) <= number else chance.sample(whole, number)
    return drawn + chance.sample(begun, max(number - len(drawn), 0))


def offered(cut: Cut) -> list[str]:
    """Return the texts that the completions make of one with a hole, in their order."""
    items = complete(Document(path=str(cut.path), text=cut.left), cut.offset)
    return [cut.left[: i.span.start] + i.insert + cut.left[i.span.end :] for i in items]


def rank(cut: Cut, made: list[str]) -> int | None:
    """Return which of the completions is the word, from 0; None: it is not offered."""
    return made.index(cut.text) if cut.text in made else None


def mistakes(cut: Cut, made: list[str]) -> list[str]:
    """Return what is wrong with the syntax and the names of what completions make."""
    return [
        f"{one.code}: {one.message}"
        for text in made
        for one in Document(path=str(cut.path), text=text).of_names
        if one.severity is Severity.ERROR
    ]
