"""Diagnostics for a terminal: the place in the source, underlined, and what to do."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from plutoc.diagnostic import Diagnostic, Related, Severity
from plutoc.report.snippet import Place, draw, last_line, windows
from plutoc.report.terminal import BLUE, BOLD, CYAN, RED, YELLOW, paint
from plutoc_runtime.domain.text import printable


def render(diagnostics: Iterable[Diagnostic], *, colour: bool, limit: int = 20) -> str:
    """Return the report: at most `limit` diagnostics, then how many there are."""
    every = tuple(diagnostics)
    if not every:
        return ""
    parts = [render_one(diagnostic, colour=colour) for diagnostic in _worst(every, limit)]
    if len(every) > limit:
        parts.append(f"… and {len(every) - limit} more\n")
    parts.append(paint(_summary(every), BOLD, colour) + "\n")
    return "\n".join(parts)


def render_one(diagnostic: Diagnostic, *, colour: bool) -> str:
    """Return one diagnostic, with its end of line."""
    main = RED if diagnostic.severity is Severity.ERROR else YELLOW
    places = [_place(diagnostic, "^", main), *(_place(r, "-", BLUE) for r in diagnostic.related)]
    gutter = len(str(last_line(places)))
    head = paint(f"{diagnostic.severity.value}[{diagnostic.code}]", main, colour)
    lines = [head + paint(f": {printable(diagnostic.message)}", BOLD, colour)]
    for i, group in enumerate(windows(places)):
        lines += draw(group, gutter, "-->" if i == 0 else ":::", colour)
    if diagnostic.help:
        first, *rest = map(printable, diagnostic.help.split("\n"))
        equals = paint("=", BLUE, colour)
        lines.append(f"{' ' * gutter} {equals} {paint('help', CYAN, colour)}: {first}")
        lines += [f"{' ' * gutter}   {line}" for line in rest]
    return "\n".join(lines) + "\n"


def _place(at: Diagnostic | Related, sign: str, code: str) -> Place:
    return Place(source=at.source, span=at.span, label=at.label, sign=sign, code=code)


def _worst(every: Sequence[Diagnostic], limit: int) -> list[Diagnostic]:
    """Return as many as are shown, in their order: no warning takes an error's place."""
    worst = sorted(range(len(every)), key=lambda i: every[i].severity is not Severity.ERROR)
    return [every[i] for i in sorted(worst[:limit])]


def _summary(diagnostics: Sequence[Diagnostic]) -> str:
    counts = []
    for severity in Severity:
        count = sum(diagnostic.severity is severity for diagnostic in diagnostics)
        if count:
            counts.append(f"{count} {severity.value}" + ("s" if count > 1 else ""))
    return ", ".join(counts)
