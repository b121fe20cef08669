"""Texts that need not be formatted: every line has a shape that Black is known to leave alone.

`canonical.txt` has those shapes. A test makes it of what Black writes, and holds it against three
releases of Black. So most compiles need not wait for Black; what it has not said yet, it is asked.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

from plutoc.emit.layout import laid_out
from plutoc.emit.lines import Logical, logical_lines

KNOWN = Path(__file__).with_name("canonical.txt")
_WORDS = ("import", "from", "def", "async", "class", "@", "D", "#")


def settled(text: str) -> list[Logical]:
    """Return a text's logical lines, broken as Black would where that is known."""
    return [_settled(line) for line in logical_lines(text)]


def _settled(line: Logical) -> Logical:
    if is_known(line):
        return line
    broken = [part for one in line.lines for part in laid_out(one) or [one]]
    found = logical_lines("\n".join(broken))
    if len(found) != 1 or not is_known(found[0]):
        return line
    return Logical(lines=found[0].lines, blanks=line.blanks, shapes=found[0].shapes)


def text_of(lines: Iterable[Logical]) -> str:
    """Return the text of some lines."""
    return "".join("\n" * line.blanks + "\n".join(line.lines) + "\n" for line in lines)


def is_known(line: Logical) -> bool:
    """Say whether Black leaves a line as it is."""
    return line.shapes is not None and known().issuperset(line.shapes)


def are_well_apart(lines: Iterable[Logical]) -> bool:
    """Say whether Black leaves the empty lines between lines as they are."""
    return known().issuperset(distances(lines))


def shapes_of(text: str) -> set[str]:
    """Return all shapes in a text that Black wrote."""
    lines = logical_lines(text)
    return {*distances(lines), *(shape for line in lines for shape in line.shapes or ())}


def distances(lines: Iterable[Logical]) -> Iterator[str]:
    """Yield how far each line is from the one before, and what the two are."""
    before = "start"
    indent = 0
    functions: list[int] = []
    for line in lines:
        kind = _kind(line)
        turn = "in" if line.indent > indent else "out" if line.indent < indent else "on"
        left = [one for one in functions if one >= line.indent]
        functions = [one for one in functions if one < line.indent]
        top = " top" if not line.indent else ""
        yield f"| {before} {turn}{' left' if left else ''}{top} {line.blanks} {kind}"
        if kind in ("def", "async", "class"):
            functions.append(line.indent)
        before, indent = kind, line.indent
    yield f"| {before} end"


def _kind(line: Logical) -> str:
    first = line.lines[0].strip()
    if first.startswith('"""'):
        return "D"
    for word in _WORDS:
        if first.startswith(word) and not first[len(word) : len(word) + 1].isalnum():
            return word
    return "opens" if first.endswith(":") else "x"


@cache
def known() -> frozenset[str]:
    """Return the shapes that Black leaves alone."""
    return frozenset(KNOWN.read_text(encoding="ascii").split("\n"))
