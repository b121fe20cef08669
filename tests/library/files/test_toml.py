"""Keys with hundreds of parts are found before `tomllib` sees them."""

from __future__ import annotations

import tomllib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.shared.alone.files import MOST, line_of_long_key

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


@given(st.integers(1, MOST + 5), st.sampled_from(["a", '"a.b"', "'.'", "1"]))
def test_a_key_of_fewer_parts_is_fine(parts: int, part: str) -> None:
    """The limit is what it says."""
    text = ".".join([part] * parts) + " = 1"
    assert tomllib.loads(text)
    assert line_of_long_key(text) == (1 if parts > MOST else None)
