"""`--version`."""

from __future__ import annotations

from pluto_fleet.cli import output
from plutoc import __version__


def tell_version() -> None:
    """Say which version this is."""
    output.line(f"plutoc {__version__}")
