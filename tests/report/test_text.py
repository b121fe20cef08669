"""Diagnostics on a terminal."""

from __future__ import annotations

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


def test_whole_report() -> None:
    """Message, place, window with the label, related place, help, count."""
    text = "pluto 1\n\n\n\n\n\n\n\n\nfirst = A\nsecond = B\n"
    source = Source("app.pluto", text)
    one = text.index("first")
    found = Diagnostic(
        code="P1005",
        severity=Severity.WARNING,
        message="twice",
        source=source,
        span=Span(text.index("second"), text.index("second") + 6),
        label="here",
        related=(Related(source=source, span=Span(0, 5), label="there"),),
        help="do this\nor that",
    )
    assert render([found, diagnostic(text, "first")], colour=False) == (
        "warning[P1005]: twice\n"
        "  --> app.pluto:11:1\n"
        "   |\n"
        "11 | second = B\n"
        "   | ^^^^^^ here\n"
        "  ::: app.pluto:1:1\n"
        "   |\n"
        " 1 | pluto 1\n"
        "   | ----- there\n"
        "   = help: do this\n"
        "     or that\n"
        "\n"
        "error[P1003]: something is wrong\n"
        "  --> app.pluto:10:1\n"
        "   |\n"
        "10 | first = A\n"
        "   | ^^^^^\n"
        "\n"
        "1 error, 1 warning\n"
    )
    assert one


def test_marks_stand_under_what_they_mean() -> None:
    """Behind tabs, behind wide characters, behind combining ones."""
    assert under("a bad", "bad") == "  ^^^"
    assert under("\tbad", "bad") == "    ^^^"
    assert under("日本 bad", "bad") == "     ^^^"
    assert under("日本 bad", "日本") == "^^^^"
    assert under("e\u0301 bad", "bad") == "  ^^^"


def test_span_over_several_lines_is_marked_to_the_end_of_its_first() -> None:
    """One line is enough to find the place."""
    assert under("a [b,\nc]", "[b,\nc]") == "  ^^^"


def test_place_at_the_end_of_the_file() -> None:
    """One mark, behind the last line."""
    text = "pluto 1"
    at_end = Diagnostic(
        code="P0015",
        severity=Severity.ERROR,
        message="no app",
        source=Source("app.pluto", text),
        span=Span(7, 7),
    )
    assert "1 | pluto 1\n  |        ^\n" in render([at_end], colour=False)


def test_source_cannot_write_to_the_terminal() -> None:
    """Escape sequences and overrides of the source are shown as signs."""
    shown = render([diagnostic("a \x1b[31m \u202e bad", "bad")], colour=False)
    assert "\x1b" not in shown and "\u202e" not in shown


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


def test_nothing_to_say() -> None:
    """No diagnostic, no text."""
    assert render([], colour=True) == ""


def test_colour_only_where_wanted() -> None:
    """Without it, no escape sequence at all."""
    found = [diagnostic("a bad", "bad", label="here", help="mend it")]
    assert "\x1b[1;31m" in render(found, colour=True)
    assert "\x1b" not in render(found, colour=False)
