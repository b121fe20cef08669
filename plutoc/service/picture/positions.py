"""`NAME.pluto.layout`: where blocks stand that were moved by hand, a sorted line each.

The file is a convenience and nothing depends on it: what cannot be read in it is passed over, and to
delete it is always safe.
"""

from __future__ import annotations

import re

from plutoc.report.layout import Point, Positions

_LINE = re.compile(
    r"([A-Za-z_][A-Za-z0-9_]{0,99})[ \t]+(-?[0-9]{1,6})[ \t]+(-?[0-9]{1,6})[ \t]*\r?"
)
FARTHEST = 999_999
"""No block stands farther from the origin than this, in pixels."""
MOST = 10_000
"""More lines than blocks that an app may have are of no use."""


def positions_in(text: str) -> dict[str, Point]:
    """Return the positions in a file's text; of two lines for one block the last one counts."""
    found: dict[str, Point] = {}
    for line in text.split("\n"):
        match = _LINE.fullmatch(line)
        if match is not None and (len(found) < MOST or match[1] in found):
            found[match[1]] = (int(match[2]), int(match[3]))
    return found


def positions_file(positions: Positions) -> str:
    """Return the text of the file: the same for the same positions."""
    return "".join(f"{name} {x} {y}\n" for name, (x, y) in sorted(positions.items()))
