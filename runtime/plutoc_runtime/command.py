"""The command line of a generated package: the door to the library."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .app import App

SEAM = (1, 0)


def start(name: str, load: Callable[[], App]) -> int:
    """Run the command that the program was called with, and return its exit code."""
    code: int = import_module("pluto_fleet.entry").start(name, load, brain=__package__, seam=SEAM)
    return code


def main(app: App, argv: Sequence[str] | None = None) -> int:
    """Run one command of an app that is loaded, and return its exit code."""
    code: int = import_module("pluto_fleet.entry").main(app, argv, brain=__package__, seam=SEAM)
    return code
