"""`python -m plutoc`, and the program that pip installs."""

from __future__ import annotations

import os
import sys
from typing import NoReturn

from plutoc.cli import main


def start() -> NoReturn:
    """Run one command, and end with its exit code.

    Python would first take apart, one by one, what a compiler has built and loaded: four starts of
    Python after a check, eight after a compile, when all that there is to write is written. Only
    under a debugger, a profiler or coverage does the program end as others do.
    """
    code = main()
    if sys.gettrace() is None and sys.getprofile() is None and "coverage" not in sys.modules:
        os._exit(code)
    sys.exit(code)


if __name__ == "__main__":
    start()
