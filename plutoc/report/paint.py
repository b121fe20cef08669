"""The colours of a report."""

from __future__ import annotations

RED, YELLOW, BLUE, CYAN, BOLD = "1;31", "1;33", "1;34", "1;36", "1"


def paint(text: str, code: str, colour: bool) -> str:
    """Return a text in a colour, if colours are wanted."""
    return f"\033[{code}m{text}\033[0m" if colour and text else text
