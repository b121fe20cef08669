"""Whether to write in colour."""

from __future__ import annotations

import os

TYPE_CHECKING = False  # `typing` itself is slow to import
if TYPE_CHECKING:
    from typing import TextIO


def in_colour(stream: TextIO | None) -> bool:
    """Follow no-color.org and force-color.org; else colour is for terminals."""
    if os.environ.get("NO_COLOR"):
        return False
    if os.environ.get("FORCE_COLOR"):
        return True
    return os.environ.get("TERM") != "dumb" and stream is not None and stream.isatty()
