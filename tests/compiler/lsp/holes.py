"""Holes cut into the examples: is what stood there among what is offered?

`python -m tests.compiler.lsp.holes` cuts a thousand, and prints the share of them in which the word that was
cut out, or that was only begun, is among the first five completions, and what was not.
"""

from __future__ import annotations

import argparse
import random
import time
from collections import Counter
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


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--holes", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    ranks: Counter[str] = Counter()
    missed: Counter[tuple[str, str, str]] = Counter()
    wrong: Counter[tuple[str, str, str]] = Counter()
    slowest = []
    drawn = cuts(options.holes, options.seed)
    for cut in drawn:
        begun = time.process_time()
        made = offered(cut)
        slowest.append(time.process_time() - begun)
        found = rank(cut, made)
        for mistake in mistakes(cut, made):
            wrong[cut.role, mistake, f"{cut.path.parent.name}, {cut.word}"] += 1
        ranks[
            "first" if found == 0 else "five" if found is not None and found < FIRST else "no"
        ] += 1
        if found is None or found >= FIRST:
            missed[cut.role, cut.word, f"{cut.path.parent.name} {found} kept {cut.kept}"] += 1
    slowest.sort()
    share = 1 - ranks["no"] / len(drawn)
    print(f"{len(drawn)} holes: {share:.1%} among the first five, {ranks['first']} the very first")
    print(
        f"median {slowest[len(slowest) // 2] * 1000:.0f} ms, p95 {slowest[len(slowest) * 95 // 100] * 1000:.0f} ms, most {slowest[-1] * 1000:.0f} ms"
    )
    print(f"{sum(wrong.values())} completions are wrong")
    for what, where, how in (*sorted(wrong), *sorted(missed)):
        print(f"  {what}: {where} ({how})")


if __name__ == "__main__":
    main()
