"""Python in the style of this repository."""

from __future__ import annotations

import black


def formatted(code: str) -> str:
    """Return code as `black` writes it."""
    return black.format_str(code, mode=black.Mode(line_length=100))
