"""Diagnostics as workflow commands of GitHub Actions."""

from __future__ import annotations

from plutoc.diagnostic import Diagnostic, Related, Severity
from plutoc.report.github import render_line, render_trouble
from plutoc.source import Source, Span


def finding(
    *, path: str = "app.pluto", message: str = "wrong", span: tuple[int, int] = (10, 13)
) -> Diagnostic:
    """A finding with related places and help of two lines."""
    source = Source(path, "pluto 1\n🚁 bad\nother\n")
    return Diagnostic(
        code="P1025",
        severity=Severity.WARNING,
        message=message,
        source=source,
        span=Span(*span),
        label="here",
        related=(Related(source=source, span=Span(14, 19), label="there"),),
        help="mend it\nor not",
    )


def test_a_diagnostic_is_one_command() -> None:
    """With its place, its related places and its help."""
    assert render_line(finding()) == (
        "::warning file=app.pluto,line=2,endLine=2,col=3,endColumn=6,title=P1025"
        "::wrong (here)%0Aapp.pluto:3:1: there%0Ahelp: mend it%0Aor not"
    )


def test_a_place_over_several_lines_has_no_columns() -> None:
    """GitHub does not take them there."""
    assert render_line(finding(span=(10, 16))).startswith(
        "::warning file=app.pluto,line=2,endLine=3,title=P1025::"
    )


def test_nothing_can_end_a_command_or_begin_another() -> None:
    """Neither a path nor a message: GitHub's signs are escaped, what acts is shown as a number."""
    line = render_line(finding(path="a,b:c%\n::x.pluto", message="50 %\r\n::error::\x1b[2J"))
    assert "\n" not in line and "\r" not in line and "\x1b" not in line
    assert "file=a%2Cb%3Ac%25%0A%3A%3Ax.pluto,line=2," in line
    assert "::50 %25\\r%0A::error::\\x1b[2J (here)%0A" in line


def test_a_file_that_cannot_be_read_is_an_error() -> None:
    """Without a place: there is none."""
    assert render_trouble("there is no file a%b") == (
        "::error title=plutoc::there is no file a%25b"
    )
