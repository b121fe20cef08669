"""Plan files as TOML: where things stand, keys with hundreds of parts, and what is said of what is no TOML."""

from __future__ import annotations

import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.files import reading
from pluto_fleet.files.toml import MOST, line_of, line_of_long_key, places
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.values import KeyPath
from tests.paths import EXAMPLES

TEXT = '''# a comment with [[mission]] in it
title = """
[[mission]]
name = "no key" """
[[mission]]
name = "first" # [[mission]]

[[mission.trip]]
action = 'a = "b"'
target = [
  1.0, # one ]
  [2.0, 3.0],
]
[mission.trip.item]
mass = "4 g"

[[ mission . trip ]]
"quoted key" = { a = 1, b = { c = "}" }, "d" = [] }
item.mass.unit = "g"
[[mission]]
[[mission.trip]]
at = 2020-01-01 08:00:00
[other]
x = -1e5
'''


def test_every_table_key_and_element_has_its_line() -> None:
    """Comments, long texts, nested lists, inline tables and dotted keys are all seen through."""
    expected: dict[KeyPath, int] = {
        ("title",): 2,
        ("mission", 0): 5,
        ("mission", 0, "name"): 6,
        ("mission", 0, "trip", 0): 8,
        ("mission", 0, "trip", 0, "action"): 9,
        ("mission", 0, "trip", 0, "target", 0): 11,
        ("mission", 0, "trip", 0, "target", 1, 1): 12,
        ("mission", 0, "trip", 0, "item"): 14,
        ("mission", 0, "trip", 0, "item", "mass"): 15,
        ("mission", 0, "trip", 1): 17,
        ("mission", 0, "trip", 1, "quoted key", "b", "c"): 18,
        ("mission", 0, "trip", 1, "item", "mass", "unit"): 19,
        ("mission", 1): 20,
        ("mission", 1, "trip", 0, "at"): 22,
        ("other", "x"): 24,
    }
    tomllib.loads(TEXT)
    found = places(TEXT)
    assert {place: found.get(place) for place in expected} == expected
    windows = places(TEXT.replace("\n", "\r\n"))
    assert windows == found


def test_what_is_missing_stands_where_its_table_does() -> None:
    """The nearest thing around a path gives its line; an empty text gives none."""
    found = places(TEXT)
    assert line_of(found, ("mission", 1, "trip", 0, "target", 2)) == 21
    assert line_of(found, ("fleet", "x")) is None


@given(st.text(alphabet="[]{}=.,\"'#\n a1\\", max_size=40))
def test_no_text_stops_the_scanner(text: str) -> None:
    """Even what is not TOML is only scanned as far as it goes."""
    places(text)


LONG = ".".join("k" * (MOST + 1))


@pytest.mark.parametrize(
    ("text", "line"),
    [
        (f"{LONG} = 1", 1),
        (f"a = 1\n[{LONG}]\n", 2),
        (f"a = {{ {LONG} = 1 }}", 1),
        (" . ".join(['"a.b"', "'c'", "d-1"] * MOST) + " = 1", 1),
        (f'a = "{LONG}"', None),
        (f"a = [{', '.join(['1.5'] * 500)}]", None),
        ("a.b.c = 1\n" * 500, None),
        ("# ..............\n" * 500, None),
        ("." * 1000, None),
        ("", None),
    ],
)
def test_only_keys_count(text: str, line: int | None) -> None:
    """Not texts, numbers, or rows of dots."""
    assert line_of_long_key(text) == line


PLANS = [path.read_text("utf-8") for path in sorted(EXAMPLES.glob("*/*.toml"))]


@given(st.sampled_from(PLANS), st.integers(0, 3000), st.text(max_size=3))
def test_there_is_advice_for_every_broken_plan(plan: str, at: int, put: str) -> None:
    """Wherever it is cut and something else stands there."""
    for text in (plan[:at] + put, plan[:at] + put + plan[at + 1 :]):
        try:
            reading.parsed("plan.toml", text)
        except BadInput as error:
            assert str(error).startswith("plan.toml")
