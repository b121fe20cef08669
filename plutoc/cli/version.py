"""`--version`."""

from __future__ import annotations

from plutoc import __version__
from plutoc_runtime import output


def tell_version() -> None:
    """Say which version this is."""
    output.line(f"plutoc {__version__}")
