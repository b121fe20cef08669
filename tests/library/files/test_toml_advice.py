"""A plan file that is not TOML: the reader of a package tells the same mistake as the library's."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.files import reading
from pluto_fleet.shared.alone import files
from pluto_fleet.shared.domain.errors import BadInput
from tests.kit.sentences import entries
from tests.library.files.test_sentences import SENTENCES
from tests.paths import EXAMPLES

PLANS = [path.read_text("utf-8") for path in sorted(EXAMPLES.glob("*/*.toml"))]


@pytest.mark.parametrize("text", [text for text, _ in entries(SENTENCES / "advice.txt")])
def test_the_reader_of_a_package_shows_the_same_line(text: str) -> None:
    """And says what is usual, instead of what is meant."""
    with pytest.raises(BadInput) as full:
        reading.parsed("plan.toml", text)
    with pytest.raises(BadInput) as small:
        files.parsed("plan.toml", text)
    shown = re.compile(r"plan\.toml:\d+: is not valid TOML: .*, in `.*`; ")
    one, other = shown.match(str(full.value)), shown.match(str(small.value))
    assert one
    assert other
    assert one[0] == other[0]
    assert str(small.value) == other[0] + files.USUAL


@given(st.sampled_from(PLANS), st.integers(0, 3000), st.text(max_size=3))
def test_there_is_advice_for_every_broken_plan(plan: str, at: int, put: str) -> None:
    """Wherever it is cut and something else stands there."""
    for text in (plan[:at] + put, plan[:at] + put + plan[at + 1 :]):
        try:
            reading.parsed("plan.toml", text)
        except BadInput as error:
            assert str(error).startswith("plan.toml")
