"""Files in which a merge has left its marks are taken apart into their two sides."""

from __future__ import annotations

from hashlib import sha256

import pytest

from plutoc.emit.merge_conflicts import sides, was_merged


def digest(text: str) -> str:
    return sha256(text.encode()).hexdigest()


@pytest.mark.parametrize(
    ("text", "ours", "theirs"),
    [
        ("a\n<<<<<<< HEAD\nb\n=======\nc\n>>>>>>> x\nd\n", "a\nb\nd\n", "a\nc\nd\n"),
        ("<<<<<<< HEAD\nb\n||||||| 1\no\n=======\n>>>>>>> x\n", "b\n", ""),
        ("<<<<<<<\n=======\nc\n>>>>>>>\n", "", "c\n"),
        ("<<<<<<< a\r\n1\r\n=======\r\n2\r\n>>>>>>> b\r\n", "1\r\n", "2\r\n"),
        (
            "<<<<<<< a\n1\n||||||| b\n<<<<<<<<< c\n0\n=========\n9\n>>>>>>>>> d\n=======\n2\n>>>>>>> e\n",
            "1\n",
            "2\n",
        ),
        ("<<<<<<< a\n1\n=======\n2\n>>>>>>> b\nTitle\n=======\n", "1\nTitle\n=======\n", None),
        (2 * "<<<<<<< a\n1\n=======\n2\n>>>>>>> b\n", "1\n1\n", "2\n2\n"),
    ],
)
def test_each_side_is_put_together(text: str, ours: str, theirs: str | None) -> None:
    """In each style, with anything within what was before."""
    wanted = ours.encode(), (theirs if theirs is not None else "2\nTitle\n=======\n").encode()
    assert sides(text.encode()) == wanted


@pytest.mark.parametrize(
    "text",
    [
        "a\n",
        "print('<<<<<<< HEAD')\n",
        "<<<<<<< HEAD\n",
        "<<<<<<< HEAD\na\n=======\n",
        "<<<<<<< a\n<<<<<<< b\n=======\n>>>>>>> c\n",
        "<<<<<<< HEAD\na\n>>>>>>> x\n",
        ">>>>>>> x\n<<<<<<< a\n=======\n>>>>>>> c\n",
    ],
)
def test_what_has_no_whole_marks_has_no_sides(text: str) -> None:
    """It is a text as any other."""
    assert sides(text.encode()) is None


def test_both_sides_must_have_been_written() -> None:
    """One that was changed is not lost beside one that we know."""
    text = b"<<<<<<< HEAD\nb\n=======\nc\n>>>>>>> x\n"
    assert was_merged(text, {digest("b\n"), digest("c\n")})
    assert not was_merged(text, {digest("b\n")})
    assert not was_merged(text + b"d\n", {digest("b\n"), digest("c\n")})
    assert not was_merged(b"b\n", {digest("b\n")})
