"""Completion: what was cut out of an example is among the first, and any place of any text has an answer."""

from __future__ import annotations

import random

from plutoc.service.completion.complete import complete
from plutoc.service.document import Document
from tests.compiler.service.test_hover import ALFALFA
from tests.lsp.holes import FIRST, cuts, mistakes, offered, rank


def test_what_was_cut_out_is_among_the_first_and_all_that_is_offered_is_legal() -> None:
    """A share of the thousand holes of `python -m tests.lsp`."""
    chosen = random.Random(3).sample(cuts(1000), 25)
    among = 0
    for cut in chosen:
        made = offered(cut)
        assert mistakes(cut, made) == [], (cut.path, cut.word)
        found = rank(cut, made)
        among += found is not None and found < FIRST
    assert among >= 0.95 * len(chosen)


def test_any_place_of_any_text_has_an_answer() -> None:
    """Each item replaces what is begun at the cursor, and is offered once."""
    chance = random.Random(5)
    answered = 0
    for _ in range(60):
        start = chance.randrange(len(ALFALFA))
        text = ALFALFA[:start] + chance.choice('([{}])"#\n,->') + ALFALFA[start + 3 :]
        at = chance.randrange(len(text))
        items = complete(Document(path="a.pluto", text=text), at)
        answered += bool(items)
        for item in items:
            assert item.span.start <= at <= item.span.end
            assert item.label and item.insert and "\n" not in text[item.span.start : at]
        assert len({(item.insert, item.span) for item in items}) == len(items)
    assert answered > 20
