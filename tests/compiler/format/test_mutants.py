"""A share of what `python -m tests.format` checks."""

from __future__ import annotations

from random import Random

import pytest

from tests.format.layouts import Liberty, laid_out, words_of
from tests.format.mutants import EXAMPLES, NAMES, broken_promises, forms, text_of
from tests.format.promises import formatted, keep, meaning
from tests.kit.graphs.graph import random_source

SHARE = 10
"""Of each source."""


@pytest.mark.parametrize("name", NAMES)
def test_any_layout_keeps_its_comments_and_its_meaning(name: str) -> None:
    """And what is formatted stays as it is."""
    assert list(broken_promises(name, range(SHARE))) == []


def test_random_apps_keep_them_as_well() -> None:
    for seed in range(30):
        random = Random(seed)
        text = random_source(random)
        keep(laid_out(words_of(text), random, Liberty()), meaning(text))


@pytest.mark.parametrize("name", NAMES)
def test_layouts_that_differ_in_blanks_and_line_breaks_become_one(name: str) -> None:
    """The form depends on what is written, not on how it was laid out."""
    assert len(forms(name, range(5))) == 1


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_are_in_canonical_form(name: str) -> None:
    """What people learn from looks as what they will write."""
    assert formatted(text_of(name)) == text_of(name)
