"""Fits journals of drones whose motion is known, and says how often it was told right.

    python -m tests.calibrating --cases 100

A case is told right if every value is in its interval: pace, overheads, spreads, drain and charge, and of multicopters
outdoors accelerations and speeds. Fewer than 95 of 100 are a failure, or more than 15 that leave open how legs are shaped.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from tests.calibrating.cases import OPEN, SHARE, Tally, fitted
from tests.kit.campaign import Campaign


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; 1 if too few cases were told right."""
    campaign = Campaign("tests.calibrating", __doc__)
    campaign.draws("cases", 100)
    campaign.parse(arguments)
    tally = Tally()
    for number, case in campaign.each(fitted, campaign.numbers):
        tally.add(number, *case)
    if tally.whole < SHARE * tally.cases:
        campaign.found("too few cases were told right")
    if len(tally.open) > OPEN * (tally.cases + len(tally.open)):
        campaign.found("too many cases were left open")
    return campaign.over(*tally.lines())


if __name__ == "__main__":
    sys.exit(main())
