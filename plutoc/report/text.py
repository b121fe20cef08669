"""Diagnostics for a terminal: the place in the source, underlined, and what to do."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Sequence

from plutoc.diagnostic import Diagnostic, Related, Severity
from plutoc.source import Source, Span

_RED, _YELLOW, _BLUE, _CYAN, _BOLD = "1;31", "1;33", "1;34", "1;36", "1"
_TAB = 4
_WIDEST = 160
"""Of a longer line, only the part around the place is shown."""


def render(diagnostics: Iterable[Diagnostic], *, colour: bool, limit: int = 20) -> str:
    """Return the report: at most `limit` diagnostics, then how many there are."""
    every = tuple(diagnostics)
    if not every:
        return ""
    parts = [render_one(diagnostic, colour=colour) for diagnostic in every[:limit]]
    if len(every) > limit:
        parts.append(f"… and {len(every) - limit} more\n")
    parts.append(_paint(_summary(every), _BOLD, colour) + "\n")
    return "\n".join(parts)


def render_one(diagnostic: Diagnostic, *, colour: bool) -> str:
    """Return one diagnostic, with its end of line."""
    main = _RED if diagnostic.severity is Severity.ERROR else _YELLOW
    windows = [_Window(diagnostic.source, diagnostic.span, diagnostic.label, "^", main)]
    windows += [_of(related) for related in diagnostic.related]
    gutter = max(len(str(window.line)) for window in windows)
    head = _paint(f"{diagnostic.severity.value}[{diagnostic.code}]", main, colour)
    lines = [head + _paint(f": {diagnostic.message}", _BOLD, colour)]
    for i, window in enumerate(windows):
        lines += window.lines(gutter, "-->" if i == 0 else ":::", colour)
    if diagnostic.help:
        first, *rest = diagnostic.help.split("\n")
        equals = _paint("=", _BLUE, colour)
        lines.append(f"{' ' * gutter} {equals} {_paint('help', _CYAN, colour)}: {first}")
        lines += [f"{' ' * gutter}   {line}" for line in rest]
    return "\n".join(lines) + "\n"


class _Window:
    """One line of a source with a place in it underlined."""

    def __init__(self, source: Source, span: Span, label: str, mark: str, code: str) -> None:
        self.source, self.label, self.mark, self.code = source, label, mark, code
        self.line, self.column = source.position(span.start)
        self.text = source.line(self.line)
        # What goes on in further lines is underlined to the end of its first.
        length = max(min(span.end - span.start, len(self.text) - self.column + 1), 1)
        self.before, self.marked = _cells(self.text, self.column - 1, length)
        self.shown = "".join(map(_shown, self.text))
        self._cut()

    def _cut(self) -> None:
        if _width(self.shown) <= _WIDEST:
            return
        first = max(self.column - 1 - _WIDEST // 4, 0)
        last = first + _WIDEST // 2
        before = "… " if first else ""
        after = " …" if last < len(self.text) else ""
        self.shown = before + "".join(map(_shown, self.text[first:last])) + after
        length = max(last - self.column + 1, 1)
        self.before = len(before) + _width("".join(map(_shown, self.text[first : self.column - 1])))
        rest = "".join(map(_shown, self.text[self.column - 1 : self.column - 1 + length]))
        self.marked = max(min(self.marked, _width(rest)), 1)

    def lines(self, gutter: int, arrow: str, colour: bool) -> list[str]:
        """Return the window's lines, with line numbers as wide as `gutter`."""
        bar = _paint("|", _BLUE, colour)
        pad = " " * gutter
        number = _paint(str(self.line).rjust(gutter), _BLUE, colour)
        under = self.mark * self.marked + (f" {self.label}" if self.label else "")
        return [
            f"{pad}{_paint(arrow, _BLUE, colour)} {self.source.path}:{self.line}:{self.column}",
            f"{pad} {bar}",
            f"{number} {bar} {self.shown}".rstrip(),
            f"{pad} {bar} {' ' * self.before}{_paint(under, self.code, colour)}",
        ]


def _of(related: Related) -> _Window:
    return _Window(related.source, related.span, related.label, "-", _BLUE)


def _cells(text: str, first: int, length: int) -> tuple[int, int]:
    """Return how many cells of the terminal come before a place, and how many it takes."""
    before = _width("".join(map(_shown, text[:first])))
    return before, max(_width("".join(map(_shown, text[first : first + length]))), 1)


def _shown(char: str) -> str:
    """Return what to print for a character: tabs as spaces, and nothing that acts or reorders."""
    if char == "\t":
        return " " * _TAB
    return char if char.isprintable() else "\N{REPLACEMENT CHARACTER}"


def _width(text: str) -> int:
    """Return how many cells of a terminal a text takes."""
    return sum(
        0 if unicodedata.combining(char) else 1 + (unicodedata.east_asian_width(char) in "WF")
        for char in text
    )


def _summary(diagnostics: Sequence[Diagnostic]) -> str:
    counts = []
    for severity in Severity:
        count = sum(diagnostic.severity is severity for diagnostic in diagnostics)
        if count:
            counts.append(f"{count} {severity.value}" + ("s" if count > 1 else ""))
    return ", ".join(counts)


def _paint(text: str, code: str, colour: bool) -> str:
    return f"\033[{code}m{text}\033[0m" if colour and text else text
