"""Fits journals of drones whose motion is known, and says how often it was told right.

    python -m tests.calibrating --cases 100

A case is told right if every value is in its interval: pace, overheads, spreads, drain and charge, and of multicopters
outdoors accelerations and speeds. The intervals say that 95 of 100 are. So few that chance brings them about less than once
in twenty times are a failure (90 of 100, 937 of 1000), or more than 15 of 100 that leave open how legs are shaped.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from tests.calibrating.cases import CHANCE, OPEN, Tally, fitted
from tests.kit.campaign import Campaign


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; 1 if too few cases were told right."""
    campaign = Campaign("tests.calibrating", __doc__)
    campaign.draws("cases", 100)
    campaign.parse(arguments)
    tally = Tally()
    for number, case in campaign.each(fitted, campaign.numbers):
        tally.add(number, *case)
    if tally.chance < CHANCE:
        campaign.found("too few cases were told right")
    if len(tally.open) > OPEN * (tally.cases + len(tally.open)):
        campaign.found("too many cases were left open")
    return campaign.over(*tally.lines())


if __name__ == "__main__":
    sys.exit(main())
