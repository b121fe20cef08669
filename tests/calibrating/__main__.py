"""Fits journals of drones whose motion is known, and says how often it was told right.

    python -m tests.calibrating --cases 100

A case is told right if every value is in its interval: pace, overheads, spreads, drain and charge.
Fewer than 95 of 100 are a failure.
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.calibrating.campaign import campaign


def main() -> int:
    """Run the campaign; 1 if too few cases were told right."""
    parser = ArgumentParser(prog="python -m tests.calibrating", description=__doc__)
    parser.add_argument("--cases", type=int, default=100, help="how many (default: 100)")
    parser.add_argument("--first", type=int, default=0, help="the first one (default: 0)")
    options = parser.parse_args()
    with TemporaryDirectory() as folder:
        tally = campaign(range(options.first, options.first + options.cases), Path(folder))
    print("\n".join(tally.lines()))
    return 1 if tally.whole < 0.95 * tally.cases else 0


if __name__ == "__main__":
    sys.exit(main())
