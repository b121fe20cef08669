"""Where things stand in a TOML text."""

from __future__ import annotations

import tomllib

from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.files.toml import TomlPath, line_of, places

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
    expected: dict[TomlPath, int] = {
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


KEYS = st.text(min_size=1, max_size=4) | st.sampled_from(["a", "b-c", "1", 'q"', "x.y", "#"])
SCALARS = st.one_of(
    st.integers(-9, 9),
    st.booleans(),
    st.text(max_size=6),
    st.sampled_from(["#", "]", "}", "[[a]]", 'x"""y', "'''", "\\", "a\nb"]),
)
VALUES = st.recursive(
    SCALARS,
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(KEYS, inner, max_size=3),
    max_leaves=8,
)


def basic(text: str) -> str:
    """Write any text as a TOML string."""
    escaped = "".join(
        c if c.isascii() and c.isprintable() and c not in '"\\' else f"\\U{ord(c):08x}"
        for c in text
    )
    return f'"{escaped}"'


def written(value: object) -> str:
    match value:
        case bool():
            return str(value).lower()
        case str():
            return basic(value)
        case list():
            return "[\n" + ", # ]\n".join(written(element) for element in value) + "\n]"
        case dict():
            pairs = (f"{basic(key)} = {written(inner)}" for key, inner in value.items())
            return "{ " + ", ".join(pairs) + " }"
        case _:
            return str(value)


def paths(value: object, place: TomlPath) -> list[TomlPath]:
    inner: list[TomlPath] = [place] if place else []
    if isinstance(value, dict):
        return inner + [p for key, v in value.items() for p in paths(v, (*place, key))]
    if isinstance(value, list):
        return inner + [p for i, v in enumerate(value) for p in paths(v, (*place, i))]
    return inner


@given(st.dictionaries(KEYS, VALUES, max_size=4))
def test_everything_that_tomllib_finds_has_a_line(data: dict[str, object]) -> None:
    """For any document each path has a line, and top-level keys have exactly theirs."""
    text, lines = "", {}
    for key, value in data.items():
        text += "# [x]\n"
        lines[key] = text.count("\n") + 1
        text += f"{basic(key)} = {written(value)}\n"
    assert tomllib.loads(text) == data
    found = places(text)
    assert set(found) == set(paths(data, ()))
    assert {key: found[key,] for key in data} == lines


@given(st.text(alphabet="[]{}=.,\"'#\n a1\\", max_size=40))
def test_no_text_stops_the_scanner(text: str) -> None:
    """Even what is not TOML is only scanned as far as it goes."""
    places(text)
