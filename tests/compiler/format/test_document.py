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


def test_what_follows_up_to_the_next_break_must_fit_too() -> None:
    """A group with a tail is broken before the tail is."""
    assert printed((brackets("abc"), "12345")) == "[abc]12345"
    assert printed((brackets("abc"), "123456")) == "[\n  abc,\n]123456"
    assert printed((brackets("abc"), "12345", NEWLINE, "6")) == "[abc]12345\n6"


def test_deep_and_wide_documents_need_no_stack() -> None:
    """What a stranger writes may be nested, and long."""
    deep: Document = "x"
    for _ in range(20_000):
        deep = Indent((deep,))
    assert printed(deep) == "x"
    assert printed(brackets(*["x"] * 20_000)).count("\n") == 20_001
