"""What a browser counts, and what is in the file: the same text, whatever its line ends and characters."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plutoc.editor.changes import Edit, Edits, between, inverse, made
from plutoc.editor.wire import NoSuchPlace, Wire, units

TEXTS = st.lists(
    st.sampled_from(["a", "é", "𝒳", "🚁", "\r\n", "\n", "\r", "\u2028", "# ", "\ufeff", "\x0b"]),
    max_size=30,
).map("".join)


def in_browser(shown: str, edits: Edits) -> str:
    """Make edits as a browser does, which counts UTF-16 units."""
    data = shown.encode("utf-16-le")
    parts, done = [], 0
    for one in edits:
        parts += [data[done : 2 * one.start], one.text.encode("utf-16-le")]
        done = 2 * one.end
    return b"".join([*parts, data[done:]]).decode("utf-16-le")


@given(TEXTS)
def test_every_place_of_a_browser_has_one_in_the_file_and_back(text: str) -> None:
    wire = Wire(text)
    shown = Wire(wire.shown, marked=False)
    for place in (shown.on_wire(i) for i in range(len(wire.shown) + 1)):
        assert wire.on_wire(wire.in_file(place)) == place
    assert wire.length == units(wire.shown)


def edits_of(data: st.DataObject, wire: Wire) -> Edits:
    shown = Wire(wire.shown, marked=False)
    offsets = st.integers(0, len(wire.shown))
    ends = sorted(data.draw(st.lists(offsets, min_size=2, max_size=4)))
    texts = st.lists(st.sampled_from(["b", "\n", "🚁", "x\ny"]), max_size=2).map("".join)
    pairs = zip(ends[::2], ends[1::2], strict=False)
    return tuple(Edit(shown.on_wire(a), shown.on_wire(b), data.draw(texts)) for a, b in pairs)


@given(TEXTS, st.data())
def test_what_is_typed_comes_into_the_file_as_it_is_shown_or_is_refused(
    text: str, data: st.DataObject
) -> None:
    """And all that was not typed over keeps its very characters."""
    wire = Wire(text)
    typed = edits_of(data, wire)
    try:
        edits = wire.received(typed)
    except NoSuchPlace:  # a byte order mark would come to stand at the beginning
        assert "\ufeff" in text
        return
    after = made(text, edits)
    assert Wire(after).shown == in_browser(wire.shown, typed)
    assert made(after, inverse(text, edits)) == text
    assert in_browser(wire.shown, wire.sent(edits, Wire(after))) == Wire(after).shown


@given(TEXTS, TEXTS)
def test_any_change_of_the_file_is_told_so_that_a_browser_has_the_same(old: str, new: str) -> None:
    before, after = Wire(old), Wire(new)
    edits = between(old, new)
    assert made(old, edits) == new
    assert in_browser(before.shown, before.sent(edits, after)) == after.shown


def test_new_lines_end_as_the_first_one_does() -> None:
    wire = Wire("\ufeffpluto 1\r\napp a {\n}")
    assert wire.shown == "pluto 1\napp a {\n}"
    (edit,) = wire.received((Edit(8, 8, "# 🚁\n"),))
    assert edit == Edit(10, 10, "# 🚁\r\n")


@pytest.mark.parametrize(
    "edit", [Edit(0, 9, ""), Edit(-1, 0, ""), Edit(2, 1, ""), Edit(0, 0, "\ud83d")]
)
def test_a_place_outside_and_half_a_character_are_refused(edit: Edit) -> None:
    with pytest.raises(NoSuchPlace):
        Wire("🚁a").received((edit,))


def test_a_great_text_of_equal_lines_is_compared_at_once() -> None:
    """Else a file that others change could keep the editor busy without end."""
    old, new = "\n" * 400_000, "x\n" * 300_000
    assert made(old, between(old, new)) == new
