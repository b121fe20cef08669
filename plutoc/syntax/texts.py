"""What a text says: its escapes, and numbers that are written as elsewhere.

No pattern is compiled before there is something to find: most sources have none of it.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from decimal import Decimal

ESCAPES = {'\\"': '"', "\\\\": "\\"}
"""The only two: a text cannot hold what a screen does not show."""

_ESCAPE = r"(?s:\\.)"

_DIGITS = r"(-?[0-9]+(?:\.[0-9]+)?[0-9_]*)([eE]?[0-9]{0,2})"
_MOST_DIGITS = 15


def written_out(quantity: str) -> str | None:
    """Say how a number is written here that other languages write so: `1e9`, `1_000`."""
    match = re.fullmatch(_DIGITS, "".join(quantity.split()))
    if match is None or not set(match[0]) & set("_eE"):
        return None
    help = "numbers are written out, with digits and a point only"
    plain = format(Decimal(match[0].replace("_", "").rstrip("eE")), "f")
    return f"{help}: `{plain}`" if sum(map(str.isdigit, plain)) <= _MOST_DIGITS else help


def unescaped(written: str) -> str:
    """Return what a text says: without its quotes, its escapes resolved."""
    text = written[1:-1]
    if "\\" not in text:
        return text
    return re.sub(_ESCAPE, lambda match: ESCAPES.get(match[0], match[0]), text)


def quoted(text: str) -> str:
    """Return a text as an app writes it: in quotes, and escaped."""
    plain = text.replace("\\", "\\\\").replace('"', '\\"')
    return f'"{plain}"'


def wrong_escapes(written: str) -> Iterator[re.Match[str]]:
    """Find the escapes that mean nothing."""
    if "\\" in written:
        for match in re.finditer(_ESCAPE, written):
            if match[0] not in ESCAPES:
                yield match
