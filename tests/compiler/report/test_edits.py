"""Changes that mend a source: exact, and never at the cost of a comment."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plutoc.diagnostic import Fix, error
from plutoc.edits import applied, compatible, without_arrow, without_item, without_statement
from plutoc.source import Source, Span


def span_of(text: str, part: str) -> Span:
    """Where a part of a text stands."""
    start = text.index(part)
    return Span(start, start + len(part))


def after(text: str, fix: Fix | None) -> str | None:
    """The text with a fix made; None where there is no fix."""
    return applied(Source("a.pluto", text), [fix]) if fix else None


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("use a\nuse b\n", "use b\n"),
        ("x\n  use a  \ny\n", "x\ny\n"),
        ("use a\r\nuse b\r\n", "use b\r\n"),
        ("\ufeffuse a\nb\n", "\ufeffb\n"),
        ("use a  # why\nb\n", "# why\nb\n"),
        ("b\nuse a", "b\n"),
        ("x use a\n", None),
        ("use a y\n", None),
    ],
)
def test_a_statement_goes_with_its_line(text: str, wanted: str | None) -> None:
    """Unless something else stands there; a comment stays."""
    assert after(text, without_statement(Source("", text), span_of(text, "use a"))) == wanted


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("can a, b", "can a"),
        ("can a, b, c", "can a, c"),
        ("(a,\n  b)", "(a)"),
        ("(a, # one\n  b)", None),
        ("can b", None),
    ],
)
def test_an_item_goes_with_the_comma_before_it(text: str, wanted: str | None) -> None:
    """The first one has none, and a comment between them stays."""
    assert after(text, without_item(Source("", text), span_of(text, "b"))) == wanted


@pytest.mark.parametrize(
    ("text", "guard", "wanted"),
    [
        ("y\n  a -> b\nx\n", "", "y\nx\n"),
        ("  a -> b otherwise # so\n", "otherwise", "  # so\n"),
        ("  c -> a -> b when X\n", "when X", "  c -> a\n"),
        ("  c\n    -> a -> b\n", "", "  c\n    -> a\n"),
        ("  c -> a\n    -> b otherwise\n", "otherwise", "  c -> a\n"),
        ("  a -> b -> c\n", "", None),
        ("  a -> b # on\n  # and on\n  -> c\n", "", None),
        ("  c -> [a -> b\n", "", None),
        ("{ a -> b }\n", "", None),
    ],
)
def test_an_arrow_goes_if_it_is_the_last_of_its_statement(
    text: str, guard: str, wanted: str | None
) -> None:
    """Of a longer flow, what comes before it stays."""
    source, arrow = Source("", text), Span(text.index("a"), text.index("b") + 1)
    guard_span = span_of(text, guard) if guard else None
    assert after(text, without_arrow(source, ("a", "b"), arrow, guard_span)) == wanted


@pytest.mark.parametrize("text", ["  [a, c] -> b\n", "  a -> [c, b]\n", "  a # so\n  -> b\n"])
def test_an_arrow_with_brackets_or_comments_stays(text: str) -> None:
    """Other arrows hang on the brackets, and the comment would be lost."""
    source, arrow = Source("", text), Span(text.index("a"), text.index("b") + 1)
    assert without_arrow(source, ("a", "b"), arrow, None) is None


def test_a_new_line_ends_as_the_others_do() -> None:
    """In a file of Windows' line ends, too."""
    fix = Fix(span=Span(0, 0), text="pluto 1\n")
    assert applied(Source("", "app\r\n"), [fix]) == "pluto 1\r\napp\r\n"
    assert applied(Source("", "app\n"), [fix]) == "pluto 1\napp\n"


SPANS = st.tuples(st.integers(0, 8), st.integers(0, 4)).map(lambda t: Span(t[0], t[0] + t[1]))


@settings(derandomize=True, max_examples=300)
@given(st.lists(SPANS, max_size=8))
def test_fixes_that_are_made_together_do_not_touch_each_other(spans: list[Span]) -> None:
    """Each takes away just its own characters, and there is always one that is made."""
    text = "abcdefghijkl"
    source = Source("a.pluto", text)
    found = [error("P2052", "m", source, s, fix=Fix(span=s, text="-")) for s in spans]
    taken = compatible(found)
    assert bool(taken) is bool(found)
    fixes = list(dict.fromkeys(d.fix for d in taken if d.fix))
    gone = {at for fix in fixes for at in range(fix.span.start, fix.span.end)}
    assert len(gone) == sum(fix.span.end - fix.span.start for fix in fixes)
    left = applied(source, fixes)
    assert left.replace("-", "") == "".join(c for i, c in enumerate(text) if i not in gone)
    assert left.count("-") == len(fixes)
