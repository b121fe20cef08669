"""Values as TOML writes them."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def value(of: object) -> str:
    """Write a text, a number, a boolean, or a list or an inline table of these."""
    match of:
        case bool():
            return "true" if of else "false"
        case str():
            return text(of)
        case Mapping():
            inner = ", ".join(f"{key(str(name))} = {value(one)}" for name, one in of.items())
            return f"{{ {inner} }}" if inner else "{}"
        case list() | tuple():
            return f"[{', '.join(map(value, of))}]"
        case _:
            return repr(of)


def text(of: str) -> str:
    """Write a text: what JSON escapes, TOML escapes alike, but for one character."""
    return json.dumps(of, ensure_ascii=False).replace("\x7f", "\\u007f")


def key(of: str) -> str:
    """Write a key, in quotes where it must be."""
    return of if _BARE.fullmatch(of) else text(of)


def numbers(of: Sequence[float]) -> str:
    """Write a list of numbers that are no whole ones."""
    return f"[{', '.join(repr(float(one)) for one in of)}]"
