"""Black, asked for some lines of a large module only.

What Black takes for a module grows faster than the module: two thirds of the time that the largest
apps take to compile. But it breaks each line for itself. So of a large module it gets the lines of
which nothing is known, some hundreds at a time, each as deep as it stands.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence

from plutoc.emit.canonical import are_well_apart, is_known, text_of
from plutoc.emit.lines import INDENT, Logical

LARGE = 400
"""Logical lines. A smaller module is given to Black as it is."""
_AT_ONCE = 200
_BETWEEN = "pluto_next_line"
_AROUND = "if pluto_around_it:"
_PLAIN = re.compile(r"(?!(?:elif|else|case|except|finally|def|async def|class|with)\b)[A-Za-z_]")


def in_pieces(lines: Sequence[Logical], ask: Callable[[str], str]) -> str | None:
    """Return the text of a large module as Black writes it; None where it must see it whole."""
    unknown = [number for number, line in enumerate(lines) if not is_known(line)]
    if len(lines) < LARGE or not are_well_apart(lines):
        return None
    if not all(_can_stand_alone(lines[number]) for number in unknown):
        return None
    done = list(lines)
    for begin in range(0, len(unknown), _AT_ONCE):
        some = unknown[begin : begin + _AT_ONCE]
        for number, written in zip(some, _asked([lines[n] for n in some], ask), strict=True):
            done[number] = Logical(lines=written, blanks=lines[number].blanks, shapes=None)
    return text_of(done)


def _can_stand_alone(line: Logical) -> bool:
    plain = _PLAIN.match(line.lines[0].lstrip(" ")) is not None
    return plain and all(map(str.strip, line.lines)) and not line.lines[-1].endswith(":")


def _asked(lines: Sequence[Logical], ask: Callable[[str], str]) -> Iterator[tuple[str, ...]]:
    """Yield each line as Black writes it within as many blocks as it stands in."""
    text = "".join(
        f"{_BETWEEN}\n{_blocks(line.indent)}{chr(10).join(line.lines)}\n" for line in lines
    )
    _, *written = re.split(rf"^{_BETWEEN}\n", ask(text), flags=re.MULTILINE)
    for line, one in zip(lines, written, strict=True):
        whole = [part for part in one.split("\n") if part.strip()]
        yield tuple(whole[line.indent // INDENT :])


def _blocks(indent: int) -> str:
    return "".join(f"{' ' * depth}{_AROUND}\n" for depth in range(0, indent, INDENT))
