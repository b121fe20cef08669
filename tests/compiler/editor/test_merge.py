"""Two people at one file: put together where they changed different statements."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plutoc.editor.merge import Conflict, merged

BASE = "a\nb\nc\nd\ne\n"


@pytest.mark.parametrize(
    ("ours", "theirs", "both"),
    [
        ("A\nb\nc\nd\ne\n", "a\nb\nc\nd\nE\n", "A\nb\nc\nd\nE\n"),
        ("a\nB\nc\nd\ne\n", "a\nb\nC\nd\ne\n", "a\nB\nC\nd\ne\n"),  # one below the other
        ("a\nx\nb\nc\nd\ne\n", "a\nb\nc\nd\ne\ny\n", "a\nx\nb\nc\nd\ne\ny\n"),
        ("a\nb\nd\ne\n", "a\nb\nc\nd\n", "a\nb\nd\n"),
        ("A\nb\nc\nd\ne\n", "A\nb\nc\nd\ne\n", "A\nb\nc\nd\ne\n"),  # the same
        ("A\nb\nc\nd\ne\n", "A\nb\nc\nd\nE\n", "A\nb\nc\nd\nE\n"),
        ("a\nb\nc\nd\ne", "A\nb\nc\nd\ne\n", "A\nb\nc\nd\ne"),
        (BASE, "", ""),
    ],
)
def test_different_lines_are_put_together(ours: str, theirs: str, both: str) -> None:
    assert merged(BASE, ours, theirs) == both
    assert merged(BASE, theirs, ours) == both


@pytest.mark.parametrize(
    ("ours", "theirs"),
    [
        ("A\nb\nc\nd\ne\n", "X\nb\nc\nd\ne\n"),
        ("a\nx\nb\nc\nd\ne\n", "a\ny\nb\nc\nd\ne\n"),
        ("a\nc\nd\ne\n", "a\nB\nc\nd\ne\n"),
        ("", "a\nb\nc\nd\nE\n"),
    ],
)
def test_the_same_lines_are_for_a_person_to_decide(ours: str, theirs: str) -> None:
    with pytest.raises(Conflict):
        merged(BASE, ours, theirs)


def test_a_statement_of_several_lines_belongs_together() -> None:
    ours, theirs = "a\nB\nc\nd\ne\n", "a\nb\nc\nD\ne\n"
    assert merged(BASE, ours, theirs, [(0, 0), (1, 2), (3, 3)]) == "a\nB\nc\nD\ne\n"
    with pytest.raises(Conflict):
        merged(BASE, ours, theirs, [(1, 3)])


LINES = st.lists(st.sampled_from("ab\n"), max_size=12).map("".join)


@given(LINES, LINES, LINES)
def test_who_changed_nothing_takes_all_and_the_order_does_not_matter(
    base: str, ours: str, theirs: str
) -> None:
    assert merged(base, base, theirs) == theirs
    try:
        both = merged(base, ours, theirs)
    except Conflict:
        with pytest.raises(Conflict):
            merged(base, theirs, ours)
    else:
        assert merged(base, theirs, ours) == both
