"""`python -m plutoc`, and the program that pip installs."""

from __future__ import annotations

import os
import sys

from plutoc.cli import main

TYPE_CHECKING = False  # `typing` itself is slow to import
if TYPE_CHECKING:
    from typing import NoReturn


def start() -> NoReturn:
    """Run one command, and end with its exit code.

    Python would first take apart, one by one, what a compiler has built and loaded: that takes as
    long as Python's own start, and all that there is to write is written. Only where somebody
    watches the program is it left to end as others do.
    """
    code = main()
    if sys.gettrace() is None and sys.getprofile() is None and "coverage" not in sys.modules:
        os._exit(code)
    sys.exit(code)


if __name__ == "__main__":
    start()
