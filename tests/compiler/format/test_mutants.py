"""A share of what `python -m tests.format` checks."""

from __future__ import annotations

import pytest

from tests.format.mutants import EXAMPLES, NAMES, broken_promises, forms, text_of
from tests.format.promises import formatted

SHARE = 10
"""Of each source."""


@pytest.mark.parametrize("name", NAMES)
def test_any_layout_keeps_its_comments_and_its_meaning(name: str) -> None:
    """And what is formatted stays as it is."""
    assert list(broken_promises(name, range(SHARE))) == []


@pytest.mark.parametrize("name", NAMES)
def test_layouts_that_differ_in_blanks_and_line_breaks_become_one(name: str) -> None:
    """The form depends on what is written, not on how it was laid out."""
    assert len(forms(name, range(5))) == 1


@pytest.mark.parametrize("name", EXAMPLES)
def test_examples_are_in_canonical_form(name: str) -> None:
    """What people learn from looks as what they will write."""
    assert formatted(text_of(name)) == text_of(name)
