"""`python -m plutoc`."""

from __future__ import annotations

import sys

from plutoc.cli import main

if __name__ == "__main__":
    sys.exit(main())
