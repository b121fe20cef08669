"""Keys with hundreds of parts are found before `tomllib` sees them."""

from __future__ import annotations

import pytest

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
