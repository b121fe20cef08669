"""Diagnostics on their way out: text on standard error, JSON on standard output."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from typing import TextIO

from plutoc.diagnostic import Diagnostic
from plutoc_runtime.cli import output


def say(diagnostics: Sequence[Diagnostic], format: str = "text") -> None:
    """Print what the compiler found."""
    if format == "json":
        from plutoc.report.json import render_line

        for diagnostic in diagnostics:
            output.line(render_line(diagnostic))
    elif diagnostics:
        from plutoc.report.text import render

        output.tell(render(diagnostics, colour=in_colour(sys.stderr)).rstrip("\n"))


def in_colour(stream: TextIO | None) -> bool:
    """Follow no-color.org and force-color.org; else colour is for terminals."""
    if os.environ.get("NO_COLOR"):
        return False
    if os.environ.get("FORCE_COLOR"):
        return True
    return os.environ.get("TERM") != "dumb" and stream is not None and stream.isatty()
