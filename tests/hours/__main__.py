"""Hours of the day come as `zoneinfo` says, around both changes of a year in twelve zones.

    python -m tests.hours --each 200
    python -m tests.hours --real

Each mission has an `at`, a `window`, a `deadline` or rounds with `every`, drawn from its zone and number, and is flown
in virtual time with a date and a zone. With `--real` ten flights in real time follow, by a clock that `faketime` (a
package of Debian's) sets, moves and lets sleep.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from tests.hours import real
from tests.hours.virtual import ZONES, Case
from tests.kit.campaign import Campaign


def in_virtual_time(case: tuple[str, int]) -> list[str]:
    """Return what is wrong with a case."""
    return Case(*case).wrong()


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly all; return the exit code."""
    campaign = Campaign("tests.hours", __doc__)
    campaign.option("--each", type=int, default=200, metavar="N", help="missions of each zone")
    campaign.option("--real", action="store_true", help="and ten flights in real time")
    campaign.side_by_side()
    campaign.in_time()
    options = campaign.parse(arguments)
    cases = [(zone, number) for number in range(options.each) for zone in ZONES]
    for case, wrong in campaign.each(in_virtual_time, cases):
        if wrong:
            campaign.found(f"{case[0]} {case[1]}", *wrong)
    if options.real:
        for number, wrong in campaign.each(real.flown, range(len(real.CASES)), threads=True):
            if wrong:
                campaign.found(f"real {number}", *wrong)
    return campaign.over(f"{len(ZONES)} zones")


if __name__ == "__main__":
    sys.exit(main())
