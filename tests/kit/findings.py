"""Findings as text, to be compared with what a case says: place, sentence, labels, help, and what mends it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from plutoc.diagnostic import Diagnostic
from plutoc.source import Source, Span


def findings(found: Iterable[Diagnostic]) -> str:
    """Return findings one below the other; `-- nothing` where there are none."""
    lines = [line for each in found for line in _lines(each)]
    return "\n".join(["-- found", *lines] if lines else ["-- nothing"])


def _lines(found: Diagnostic) -> Iterator[str]:
    yield f"{found.severity.value} {found.code} at {_place(found.source, found.span)}"
    yield f"  {found.message}"
    if found.label:
        yield f"  here: {found.label}"
    for related in found.related:
        yield f"  {_place(related.source, related.span)}: {related.label}"
    for line in (found.help or "").splitlines():
        yield f"    {line}"
    if found.fix is not None:
        yield f"  fix: {_place(found.source, found.fix.span)} becomes {_quoted(found.fix.text)}"


def _place(source: Source, span: Span) -> str:
    line, column = source.position(span.start)
    return f"{line}:{column} {_quoted(source.quote(span))}"


def _quoted(text: str) -> str:
    """Return a text on one line, without what cannot be seen; a long one is cut."""
    shown = text if len(text) <= 60 else f"{text[:60]}…"
    return f"`{shown}`" if shown.isprintable() else ascii(shown)
