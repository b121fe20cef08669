"""A share of what `python -m tests.compiler.format` checks."""

from __future__ import annotations

import pytest

from tests.compiler.format.__main__ import main
from tests.compiler.format.mutants import EXAMPLES, NAMES, broken_promises, forms, text_of
from tests.compiler.format.promises import formatted

SHARE = 34
"""Of each source: 306 in all."""


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


def test_the_script_says_how_many_it_made(capsys: pytest.CaptureFixture[str]) -> None:
    """A mutant of each source, here."""
    assert main(["--mutants", "9", "--first", "1000"]) == 0
    assert f"{len(NAMES)} mutants in " in capsys.readouterr().out
