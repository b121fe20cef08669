"""What to write where a plan file is not TOML, and the same mistake told by the reader of a package."""

from __future__ import annotations

import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.files import reading
from pluto_fleet.shared.alone import files
from pluto_fleet.shared.domain.errors import BadInput
from tests.paths import ROOT

EXAMPLES = ROOT / "examples"
PLANS = [path.read_text("utf-8") for path in sorted(EXAMPLES.glob("*/*.toml"))]

ADVICE = [
    ("name = North ward", 'write name = "North ward"'),
    ("safe_time = 3 min  # long", 'write safe_time = "3 min"'),
    ("repeat = True", "write repeat = true"),
    ("repeat = yes", "write repeat = true"),
    ("home = 0,5", "a number has a point: home = 0.5"),
    ("priority = 01", "write priority = 1"),
    ("name =", "write a value behind name ="),
    ("name", 'a line is a key and its value, such as name = "North"'),
    ('name: "North"', 'write = instead of the colon: name = "North"'),
    ('name = "North', 'the text has no closing quote: write name = "North"'),
    ("name = 'O'Hara'", """write name = "O'Hara\""""),
    ("name = “North”", 'quotes are straight: "text"'),
    ('name = "a" // b', "a comment begins with #"),
    ('name = "a";', "write no ; at the end of a line"),
    ('name = "C:\\ward"', "in a text a backslash is written \\\\"),
    ("target = [4.0 3.0]", "a comma stands between two values"),
    ('item = { name = "a" mass = "4 g" }', "a comma stands between two values"),
    ("areas = [\n  [1, 2]\n  [3, 4]\n]\nname = 3", "a comma stands between two values"),
    ("areas = [\n  [1, 2]\n", "the list that begins in line 2 has no closing ]"),
    ("target = [4.0, 3.0", "the list that begins in line 2 has no closing ]"),
    ("target = [4.0, 3.0\nname = 1", "the list that begins in line 2 has no closing ]"),
    ("target = [4.0, 3.0\n\n[[mission.trip]]", "the list that begins in line 2 has no closing ]"),
    ("areas = [\n  [1, 2],\n  [3, 4\n\n[map]", "the list that begins in line 4 has no closing ]"),
    ("name = 1\nother = 2\nname = 3", "name is given in line 2 already"),
    ("? = 3", 'a line is a key and its value, such as name = "North"'),
    ('item = { name = "a"', "the { has no closing } in its line"),
    ("a = 1\na.b = 2", files.USUAL),
    ('name = "a"\nname = "b"', "name is given in line 2 already"),
    ("[[mission.trip]", "write [[mission.trip]]"),
    ("[map", "write [map]"),
    ("[map]\n[map]", "write [[map]] here and in line 2"),
]


@pytest.mark.parametrize(("text", "said"), ADVICE)
def test_it_says_what_to_write(text: str, said: str) -> None:
    with pytest.raises(BadInput) as told:
        reading.parsed("plan.toml", f"# A plan\n{text}\n")
    assert str(told.value).endswith(f"; {said}")


@pytest.mark.parametrize(("text", "said"), ADVICE)
def test_the_reader_of_a_package_shows_the_same_line(text: str, said: str) -> None:
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
