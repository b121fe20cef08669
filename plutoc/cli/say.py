"""Diagnostics on their way out: text on standard error, all else on standard output."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterable, Iterator, Sequence
from typing import TextIO

from plutoc.diagnostic import Diagnostic, arranged
from plutoc_runtime import output

Words = Iterable[tuple[bool, str]]
"""Texts, and whether each goes to standard output."""


def say(
    diagnostics: Sequence[Diagnostic], format: str = "text", troubles: Sequence[str] = ()
) -> None:
    """Print what the compiler found; once a run, for one of the formats is a single document.

    `troubles` are what kept files from being read. A person is told of them on standard error, where
    they were met; here they are told to programs.
    """
    speak(worded(diagnostics, format, troubles))


def worded(
    diagnostics: Sequence[Diagnostic], format: str, troubles: Sequence[str] = ()
) -> Iterator[tuple[bool, str]]:
    """Yield what there is to print, and whether it goes to standard output."""
    found = arranged(diagnostics)
    match format:
        case "json":
            from plutoc.report import json

            for diagnostic in found:
                yield True, json.render_line(diagnostic)
        case "github":
            from plutoc.report import github

            for sentence in troubles:
                yield True, github.render_trouble(sentence)
            for diagnostic in found:
                yield True, github.render_line(diagnostic)
        case "sarif":
            from plutoc import __version__
            from plutoc.report import sarif

            yield True, sarif.render(found, troubles, version=__version__, title=_title)
        case _ if found:
            from plutoc.report.text import render

            yield False, render(found, colour=in_colour(sys.stderr)).rstrip("\n")
            yield False, f"`plutoc explain {found[0].code}` tells more"


def speak(words: Words) -> None:
    """Print some texts, each where it belongs."""
    for on_output, text in words:
        (output.line if on_output else output.tell)(text)


def in_colour(stream: TextIO | None) -> bool:
    """Follow no-color.org and force-color.org; else colour is for terminals."""
    if os.environ.get("NO_COLOR"):
        return False
    if os.environ.get("FORCE_COLOR"):
        return True
    return os.environ.get("TERM") != "dumb" and stream is not None and stream.isatty()


def _title(code: str) -> str | None:
    from plutoc.explain.pages import codes, page

    return page(code).title if code in codes() else None
