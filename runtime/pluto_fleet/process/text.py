"""Formatting that only a command line or a flight needs."""

from __future__ import annotations

from shlex import quote

from ..shared.domain.text import printable


def in_shell(text: object) -> str:
    """Quote a word of a command line for a shell."""
    word = str(text)
    if word.isprintable():
        return quote(word)
    return "$'" + printable(word.replace("\\", "\\\\").replace("'", "\\'")) + "'"


def of(drone: str, reason: str) -> str:
    """Add the drone to a reason that does not name it."""
    return reason if reason.startswith(f"{drone} ") else f"{drone}: {reason}"
