"""The lines under a line of source: marks under its places, and what they say."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from plutoc.report.terminal import paint


@dataclass(frozen=True, slots=True, kw_only=True)
class Mark:
    """A stretch of cells of one line, the end not included, and what is said about it."""

    start: int
    end: int
    sign: str
    label: str
    code: str
    """Its colour."""


def under(marks: Sequence[Mark], colour: bool) -> list[str]:
    """Return the lines under a line. Marks that overlap stand below each other.

    Of those side by side, the last says its label right behind it, the others hang theirs below:

        retry = PriorityManager(max_attempts: 3, max_attempts: 4)
                                ------------     ^^^^^^^^^^^^ the second time
                                |
                                the first time
    """
    layers: list[list[Mark]] = []
    for mark in marks:
        room = (layer for layer in layers if not any(_overlap(mark, other) for other in layer))
        layer = next(room, None)
        if layer is None:
            layers.append([mark])
        else:
            layer.append(mark)
    return [line for layer in layers for line in _side_by_side(layer, colour)]


def _overlap(one: Mark, other: Mark) -> bool:
    return one.start < other.end and other.start < one.end


def _side_by_side(marks: Sequence[Mark], colour: bool) -> list[str]:
    *others, last = sorted(marks, key=lambda mark: mark.start)
    hanging = [mark for mark in others if mark.label]
    signs = {at: (mark.sign, mark.code) for mark in marks for at in range(mark.start, mark.end)}
    said = " " + paint(last.label, last.code, colour) if last.label else ""
    lines = [_row(signs, colour) + said]
    if hanging:
        lines.append(_row(_threads(hanging), colour))
    while hanging:
        mark = hanging.pop()
        left = _row(_threads(hanging), colour)
        pad = " " * (mark.start - (hanging[-1].start + 1 if hanging else 0))
        lines.append(left + pad + paint(mark.label, mark.code, colour))
    return lines


def _threads(marks: Iterable[Mark]) -> dict[int, tuple[str, str]]:
    return {mark.start: ("|", mark.code) for mark in marks}


def _row(cells: dict[int, tuple[str, str]], colour: bool) -> str:
    """Print cells, those of one colour that stand together in one go."""
    row, run, code, at = "", "", "", 0
    for cell in sorted(cells):
        sign, its_code = cells[cell]
        if run and (cell > at or its_code != code):
            row, run = row + paint(run, code, colour), ""
        row += " " * (cell - at)
        run, code, at = run + sign, its_code, cell + 1
    return row + paint(run, code, colour)
