"""A window on a source: the lines in which places lie, with the places underlined."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from plutoc.report.marks import Mark, under
from plutoc.report.terminal import BLUE, columns, paint, shown
from plutoc.source import Source, Span
from plutoc_runtime.domain.text import printable

_NEAR = 2
"""Places so many lines apart share a window."""
_WIDEST = 160
"""Of a longer line, only the part around the place is shown."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """A place to be underlined, with which sign and colour, and what is said about it."""

    source: Source
    span: Span
    label: str
    sign: str
    code: str

    def lines(self) -> tuple[int, int]:
        """Return the first and the last of its lines."""
        start, end = self.span.start, self.span.end
        first, _ = self.source.position(start)
        # what ends with the end of a line does not reach into the next one
        last, _ = self.source.position(max(start, end - 1))
        return first, last


def windows(places: Iterable[Place]) -> list[list[Place]]:
    """Put places together that lie near to each other; the first of all stays the first."""
    groups: list[list[Place]] = []
    for place in places:
        near = (group for group in groups if all(_fits(place, other) for other in group))
        group = next((g for g in near if any(_is_near(place, other) for other in g)), None)
        if group is None:
            groups.append([place])
        else:
            group.append(place)
    return groups


def _is_near(one: Place, other: Place) -> bool:
    (first, last), (others_first, others_last) = one.lines(), other.lines()
    return first <= others_last + _NEAR and others_first <= last + _NEAR


def _fits(one: Place, other: Place) -> bool:
    """Can both be shown, in one source and not cut off?"""
    same = one.source is other.source or one.source == other.source
    return same and not any(
        _is_wide(place.source.line(line)) for place in (one, other) for line in place.lines()
    )


def _is_wide(text: str) -> bool:
    return len(text) > _WIDEST or columns(text)[-1] > _WIDEST


def draw(places: Sequence[Place], gutter: int, arrow: str, colour: bool) -> list[str]:
    """Return a window's lines, with line numbers as wide as `gutter`."""
    source, pad, bar = places[0].source, " " * gutter, paint("|", BLUE, colour)
    line, column = source.position(places[0].span.start)
    at = f"{printable(source.path)}:{line}:{column}"
    out = [f"{pad}{paint(arrow, BLUE, colour)} {at}", f"{pad} {bar}"]
    parts: dict[int, list[_Part]] = {}
    for place in places:
        for number, part in _parts(place):
            parts.setdefault(number, []).append(part)
    last = min(parts)
    for number in _shown_lines(sorted(parts)):
        if number > last + 1:
            out.append(paint("...", BLUE, colour))
        text, marks = _line(source.line(number), parts.get(number, ()))
        out.append(f"{paint(str(number).rjust(gutter), BLUE, colour)} {bar} {text}".rstrip())
        out += [f"{pad} {bar} {row}" for row in (under(marks, colour) if marks else ())]
        last = number
    return out


def last_line(places: Iterable[Place]) -> int:
    """Return the number of the last line that is shown of these."""
    return max(place.lines()[1] for place in places)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Part:
    """What lies of a place in one line, in characters."""

    start: int
    end: int
    label: str
    place: Place


def _parts(place: Place) -> list[tuple[int, _Part]]:
    """Return where to mark a place: of what takes several lines, the first and the last one."""
    source, span = place.source, place.span
    (first, last), start = place.lines(), source.position(span.start)[1] - 1
    length = len(source.line(first))
    if first == last:
        end = min(start + span.end - span.start, max(length, start + 1))
        return [(first, _Part(start=start, end=end, label=place.label, place=place))]
    text = source.line(last)
    end = min(source.position(span.end - 1)[1], len(text))
    begin = min(len(text) - len(text.lstrip()), end)
    return [
        (first, _Part(start=start, end=length, label="", place=place)),
        (last, _Part(start=begin, end=end, label=place.label, place=place)),
    ]


def _shown_lines(marked: Sequence[int]) -> list[int]:
    """Return the lines to show: one that would be left out alone is shown, too."""
    between = [one + 1 for one, next_ in pairwise(marked) if next_ == one + 2]
    return sorted([*marked, *between])


def _line(text: str, parts: Sequence[_Part]) -> tuple[str, list[Mark]]:
    """Return a line as it is shown, and the marks under it."""
    first, end, before, after = 0, len(text), "", ""
    if _is_wide(text):
        first = max(parts[0].start - _WIDEST // 4, 0) if parts else 0
        end = min(first + _WIDEST // 2, len(text))
        before, after = "… " if first else "", " …" if end < len(text) else ""
    piece = text[first:end]
    line = before + "".join(map(shown, piece)) + after
    at = [len(before) + column for column in columns(piece)]
    marks = []
    for part in parts:
        start, stop = (at[min(max(char, first), end) - first] for char in (part.start, part.end))
        place = part.place
        marks.append(
            Mark(
                start=start,
                end=max(stop, start + 1),
                sign=place.sign,
                label=printable(part.label),
                code=place.code,
            )
        )
    return line, marks
