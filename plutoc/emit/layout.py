"""How a line that is too long is broken: as Black would break it, or not at all.

It is tried for what generated code has: calls and displays. What comes of it counts only if its
shapes are known to be Black's (`canonical.py`); else Black is asked.
"""

from __future__ import annotations

import re

from plutoc.emit.lines import INDENT
from plutoc.emit.python import LINE_LENGTH

_SIGN = re.compile(
    r'"(?:[^"\\]|\\.)*"'
    r"|'[^'\\]*\"[^'\\]*'"
    r"|(?P<open>[(\[{])|(?P<close>[)\]}])|(?P<comma>,)|(?P<odd>[#\'])"
)
_DISPLAY = re.compile(r"(?<![\w\])}])[(\[{]$")
_TAIL = re.compile(r",|(?: -> [\w.]+(?: \| [\w.]+)*)?:|")


def laid_out(line: str) -> list[str] | None:
    """Return the lines that a line becomes; None where that is not ours to say."""
    bracket = _last_bracket(line)
    if bracket is None:
        return [line] if len(line) <= LINE_LENGTH else None
    begin, end, commas = bracket
    inner = line[begin + 1 : end].strip()
    # a tuple of one must have its comma; any other is there to have an element a line
    magic = inner.endswith(",") and (line[begin] != "(" or len(commas) > 1)
    if len(line) <= LINE_LENGTH and not magic:
        return [line]
    if not inner:
        return None
    indent = " " * (len(line) - len(line.lstrip(" ")))
    head, tail = line[: begin + 1], indent + line[end:]
    deeper = indent + " " * INDENT
    is_display = _DISPLAY.search(head) is not None
    if not commas:  # nothing but one element, which gets no comma
        alone = laid_out(deeper + inner)
        return None if alone is None else [head, *alone, tail]
    if not inner.endswith(",") and not is_display and len(deeper) + len(inner) <= LINE_LENGTH:
        return [head, deeper + inner, tail]
    lines = [head]
    for one, other in zip([begin, *commas], [*commas, end], strict=True):
        element = line[one + 1 : other].strip()
        if element:
            broken = laid_out(f"{deeper}{element},")
            if broken is None:
                return None
            lines += broken
    return [*lines, tail]


def _last_bracket(line: str) -> tuple[int, int, list[int]] | None:
    """Return where the last pair of brackets begins and ends, and the commas right within it.

    Nothing but a comma, or the end of a definition, may follow it.
    """
    stack: list[tuple[int, list[int]]] = []
    found: tuple[int, int, list[int]] | None = None
    for sign in _SIGN.finditer(line):
        match sign.lastgroup:
            case "open":
                stack.append((sign.start(), []))
            case "close":
                if not stack:
                    return None
                begin, commas = stack.pop()
                found = begin, sign.start(), commas
            case "comma":
                if stack:
                    stack[-1][1].append(sign.start())
            case "odd":
                return None
            case _:
                pass
    if stack or found is None or _TAIL.fullmatch(line, found[1] + 1) is None:
        return None
    return found
