"""Where the printer breaks lines."""

from __future__ import annotations

from plutoc.format.document import (
    NEWLINE,
    NOTHING,
    SPACE,
    Document,
    Group,
    IfBroken,
    Indent,
    Remark,
    written,
)


def printed(document: Document, width: int = 10) -> str:
    """Write a document that begins in the first column."""
    return written(document, indent=0, step=2, width=width)


def brackets(*items: Document) -> Document:
    """Return a list in brackets."""
    content = [(SPACE if i else NOTHING, item, ",") for i, item in enumerate(items[:-1])]
    last = (SPACE if content else NOTHING, items[-1], IfBroken(","))
    return Group(("[", Indent((*content, last)), NOTHING, "]"))


def test_a_group_that_fits_stands_on_one_line() -> None:
    """To the very last column."""
    assert printed(brackets("abc", "def")) == "[abc, def]"
    assert printed(brackets("abc", "defg")) == "[\n  abc,\n  defg,\n]"


def test_what_follows_up_to_the_next_break_must_fit_too() -> None:
    """A group with a tail is broken before the tail is."""
    assert printed((brackets("abc"), "12345")) == "[abc]12345"
    assert printed((brackets("abc"), "123456")) == "[\n  abc,\n]123456"
    assert printed((brackets("abc"), "12345", NEWLINE, "6")) == "[abc]12345\n6"


def test_an_outer_group_breaks_before_an_inner_one() -> None:
    """And the inner one only if it must."""
    inner = brackets("a", "b")
    assert printed(brackets(inner, "cd")) == "[\n  [a, b],\n  cd,\n]"
    assert printed(brackets(inner, "c"), 6) == "[\n  [\n    a,\n    b,\n  ],\n  c,\n]"


def test_a_remark_takes_no_room_and_breaks_what_it_stands_in() -> None:
    """The line ends behind it."""
    assert printed(brackets("a", ("b", Remark("# a long remark")))) == (
        "[\n  a,\n  b  # a long remark,\n]"
    )
    assert printed((brackets("abc", "def"), Remark("# long"), NEWLINE)) == "[abc, def]  # long\n"


def test_deep_and_wide_documents_need_no_stack() -> None:
    """What a stranger writes may be nested, and long."""
    deep: Document = "x"
    for _ in range(20_000):
        deep = Indent((deep,))
    assert printed(deep) == "x"
    assert printed(brackets(*["x"] * 20_000)).count("\n") == 20_001
