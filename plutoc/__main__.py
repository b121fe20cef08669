"""`python -m plutoc`, and the program that pip installs."""

from __future__ import annotations

import sys
from typing import NoReturn

from plutoc.cli import main


def start() -> NoReturn:
    """Run one command, and end with its exit code."""
    sys.exit(main())


if __name__ == "__main__":
    start()
