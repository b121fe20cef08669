"""Diagnostics on a terminal."""

from __future__ import annotations

from dataclasses import replace

from plutoc.diagnostic import Diagnostic, Related, Severity
from plutoc.report.text import render
from plutoc.source import Source, Span


def diagnostic(text: str, marked: str, **facts: str) -> Diagnostic:
    """A finding about the marked part of a text."""
    start = text.index(marked)
    return Diagnostic(
        code="P1003",
        severity=Severity.ERROR,
        message="something is wrong",
        source=Source("app.pluto", text),
        span=Span(start, start + len(marked)),
        label=facts.get("label", ""),
        help=facts.get("help"),
    )


def under(text: str, marked: str) -> str:
    """Render, and return what the marks stand under, counted in cells of a terminal."""
    lines = render([diagnostic(text, marked)], colour=False).split("\n")
    return lines[4].split("| ", 1)[1]


def window(report: str) -> list[str]:
    """Return the lines of a report's first window, without its head and the count."""
    return report.split("\n\n")[0].rstrip("\n").split("\n")[3:]


def test_marks_stand_under_what_they_mean() -> None:
    """Behind tabs, behind wide characters, behind combining ones."""
    assert under("a bad", "bad") == "  ^^^"
    assert under("\tbad", "bad") == "    ^^^"
    assert under("日本 bad", "bad") == "     ^^^"
    assert under("日本 bad", "日本") == "^^^^"
    assert under("e\u0301 bad", "bad") == "  ^^^"


def test_of_a_span_over_several_lines_the_first_and_the_last_are_shown() -> None:
    """With what is between them, if it is no more than a line."""
    two = render([diagnostic("a [b,\n   c]\n", "[b,\n   c]", label="here")], colour=False)
    assert window(two) == ["1 | a [b,", "  |   ^^^", "2 |    c]", "  |    ^^ here"]
    three = render([diagnostic("a [b,\nx\nc]\n", "[b,\nx\nc]")], colour=False)
    assert window(three) == ["1 | a [b,", "  |   ^^^", "2 | x", "3 | c]", "  | ^^"]
    many = render([diagnostic("a [b,\nx\ny\nc]\n", "[b,\nx\ny\nc]")], colour=False)
    assert window(many) == ["1 | a [b,", "  |   ^^^", "...", "4 | c]", "  | ^^"]


def with_related(text: str, marked: str, *others: str) -> Diagnostic:
    """A finding about the marked part of a text, with other parts that have to do with it."""
    found = diagnostic(text, marked, label="main")
    spans = [Span(text.index(other), text.index(other) + len(other)) for other in others]
    return replace(
        found,
        related=tuple(
            Related(source=found.source, span=span, label=f"of {other}")
            for span, other in zip(spans, others, strict=True)
        ),
    )


def test_places_that_overlap_stand_below_each_other() -> None:
    """Else no reader could tell where each begins and ends."""
    assert window(render([with_related("one two\n", "one", "one two")], colour=False)) == [
        "1 | one two",
        "  | ^^^ main",
        "  | ------- of one two",
    ]


def test_places_in_near_lines_share_a_window() -> None:
    """In the order of the source; what lies far away, or in another file, has its own."""
    text = "a\nb\nc\nd\ne\n"
    near = render([with_related(text, "c", "a")], colour=False)
    assert window(near) == ["1 | a", "  | - of a", "2 | b", "3 | c", "  | ^ main"]
    far = render([with_related(text, "e", "b")], colour=False)
    assert " ::: app.pluto:2:1\n" in far
    elsewhere = Related(source=Source("hooks.py", text), span=Span(0, 1), label="there")
    both = render([replace(diagnostic(text, "a"), related=(elsewhere,))], colour=False)
    assert " ::: hooks.py:1:1\n" in both


def test_signs_that_may_melt_into_one_keep_their_columns() -> None:
    """They are shown one by one: terminals disagree about how wide they are together."""
    assert under("👩\u200d🚀 bad", "bad") == " " * 6 + "^^^"
    assert under("👍🏽 bad", "bad") == " " * 3 + "^^^"
    assert under("❤\ufe0f bad", "bad") == " " * 2 + "^^^"
    assert under("न\u0947 bad", "bad") == " " * 2 + "^^^"
    assert under("각 bad", "bad") == " " * 3 + "^^^"
    assert under("\u1100\u1161\u11a8 bad", "bad") == " " * 3 + "^^^"


def test_nothing_of_a_diagnostic_can_write_to_the_terminal() -> None:
    """Neither its path nor its message, its labels or its help."""
    evil = "\x1b[2J\u202e\r"
    source = Source(f"a{evil}.pluto", "bad")
    found = Diagnostic(
        code="P1003",
        severity=Severity.ERROR,
        message=f"m{evil}",
        source=source,
        span=Span(0, 3),
        label=f"l{evil}",
        related=(Related(source=source, span=Span(0, 1), label=f"r{evil}"),),
        help=f"h{evil}\nnext",
    )
    shown = render([found], colour=False)
    assert all(char.isprintable() or char == "\n" for char in shown)
    assert "help: h\\x1b[2J\\u202e\\r\n    next\n" in shown


def test_long_line_is_cut_around_the_place() -> None:
    """And the marks still stand under it."""
    lines = render([diagnostic("x" * 500 + " bad " + "y" * 500, "bad")], colour=False).split("\n")
    at = lines[4].index("^^^")
    assert lines[3][at : at + 3] == "bad"
    assert len(lines[3]) < 120


def test_cap() -> None:
    """Twenty, then how many more."""
    shown = render([diagnostic("a bad", "bad")] * 25, colour=False)
    assert shown.count("error[P1003]") == 20
    assert "… and 5 more" in shown and shown.endswith("25 errors\n")


def test_no_warning_takes_an_errors_place() -> None:
    """Those that are shown stay in their order."""
    error = diagnostic("a bad", "bad")
    warning = replace(error, severity=Severity.WARNING)
    shown = render([*[warning] * 25, error, *[warning] * 5], colour=False)
    assert shown.count("warning[") == 19
    assert shown.count("error[") == 1
    assert "… and 11 more\n" in shown and shown.endswith("1 error, 30 warnings\n")


def test_colour_only_where_wanted() -> None:
    """Without it, no escape sequence at all."""
    found = [diagnostic("a bad", "bad", label="here", help="mend it")]
    assert "\x1b[1;31m" in render(found, colour=True)
    assert "\x1b" not in render(found, colour=False)


def test_a_byte_order_mark_takes_no_column() -> None:
    """Editors neither show it nor count it."""
    shown = render([diagnostic("\ufeffa bad", "bad")], colour=False)
    assert " --> app.pluto:1:3\n" in shown
    assert window(shown) == ["1 | a bad", "  |   ^^^"]
    at_it = render([diagnostic("\ufeffbad", "\ufeff")], colour=False)
    assert " --> app.pluto:1:1\n" in at_it
