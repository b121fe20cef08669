"""What a name may be, and which name may have been meant."""

from __future__ import annotations

import keyword
import re
import unicodedata
from collections.abc import Iterable
from enum import Enum

from plutoc.syntax.tokens import WORDS

LONGEST = 63

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")


class Style(Enum):
    """How names of a role are written."""

    SNAKE = "snake_case"
    PASCAL = "PascalCase"
    UPPER = "UPPER_CASE"


_STYLES = {
    Style.SNAKE: re.compile(r"[a-z][a-z0-9_]*"),
    Style.PASCAL: re.compile(r"[A-Z][A-Za-z0-9]*"),
    Style.UPPER: re.compile(r"[A-Z][A-Z0-9_]*"),
}


def is_well_formed(name: str) -> bool:
    """Return whether it is made of ASCII letters, digits and underscores, and not too long."""
    return len(name) <= LONGEST and _NAME.fullmatch(name) is not None


def has_style(name: str, style: Style) -> bool:
    """Return whether it is written as names of that role are."""
    return _STYLES[style].fullmatch(name) is not None


def in_snake_case(name: str) -> str:
    """Return the name as snake_case: `TakePhoto2` as `take_photo2`."""
    parts = re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name)
    return re.sub(r"_+", "_", parts).lower()


def in_plain_letters(name: str) -> str | None:
    """Return the name as it can be written: `Blüten-Suche` as `Bluten_Suche`; None: it cannot."""
    parts = [unicodedata.normalize("NFKD", char).encode("ascii", "ignore") for char in name]
    if any(char.isalnum() and not part for char, part in zip(name, parts, strict=True)):
        return None  # a letter of another script
    letters = b"".join(parts).decode()
    plain = re.sub(r"[^A-Za-z0-9]+", "_", letters).strip("_")
    return plain if is_well_formed(plain) else None


def reserved(name: str) -> str | None:
    """Say whose word it is, in words that follow "it is", or None where it is free."""
    if name.lower() in ("start", "end"):
        return "where every mission begins" if name.lower() == "start" else "where missions end"
    if name in WORDS:
        return "a word of the language"
    if keyword.iskeyword(name) or keyword.issoftkeyword(name):
        return "a word of Python, in which your hooks are written"
    return "what Python calls an object itself" if name == "self" else None


def near(name: str, options: Iterable[str], most: int = 3) -> list[str]:
    """Return what may have been meant, the nearest first."""
    possible = [each for each in options if abs(len(each) - len(name)) <= max(len(name), 3)]
    same = next((each for each in possible if _bare(each) == _bare(name)), None)
    if same is not None:
        return [same]
    by_lower: dict[str, str] = {}
    for each in possible:
        by_lower.setdefault(each.lower(), each)
    import difflib  # only for mistakes

    return [
        by_lower[match] for match in difflib.get_close_matches(name.lower(), by_lower, most, 0.65)
    ]


def _bare(name: str) -> str:
    """Return a name as people remember it: `TripMonitor` and `trip_monitor` are one."""
    return name.lower().replace("_", "")
