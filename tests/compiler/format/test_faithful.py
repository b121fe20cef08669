"""A mistake of the formatter does no harm: it is noticed before its text is used."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from plutoc.format import run
from plutoc.format.run import MeaningChanged, TooLarge, same_writing
from plutoc.source import LARGEST
from tests.format.promises import formatted

TEXT = 'pluto 1\n\napp a "T" {\n  # why\n  b = K(x: 5 min)  # what\n  b -> c\n}\n'


@pytest.mark.parametrize(
    "mistake",
    [
        lambda text: text.replace("  # why\n", ""),
        lambda text: text.replace("# why", "# Why"),
        lambda text: text.replace("# what\n", "").replace("-> c", "-> c  # what"),
        lambda text: text.replace("5 min", "50 min"),
        lambda text: text.replace("5 min", "5.0 min"),
        lambda text: text.replace("  b -> c\n", ""),
        lambda text: text.replace('"T"', '"T "'),
        lambda text: text.replace("b -> c", "b -> -> c"),
        lambda text: "",
    ],
)
def test_a_text_that_does_not_say_the_same_is_never_returned(
    monkeypatch: pytest.MonkeyPatch, mistake: Callable[[str], str]
) -> None:
    """No matter what was lost, changed or moved."""
    monkeypatch.setattr(run, "canonical", mistake)
    with pytest.raises(MeaningChanged):
        formatted(TEXT)


def test_only_commas_and_blanks_may_differ() -> None:
    """Within texts and comments nothing may."""
    assert same_writing("a = K ( x:5min , )  # b,c", "a = K(x: 5 min) # b,c")
    assert not same_writing("a = K  # b,c", "a = K  # b c")
    assert not same_writing('x: "a, b"', 'x: "a b"')
    assert not same_writing("a  # b\n  -> c", "a -> c  # b")


def test_a_source_that_would_grow_too_large_is_refused() -> None:
    """It could not be read again, and that would be no mistake of ours."""
    comment = "#" * (LARGEST - 26)
    with pytest.raises(TooLarge):
        formatted(f"pluto 1\napp a {{a->b}}\n{comment}\n")
