"""Formats many layouts of every example, and checks what `plutoc fmt` promises.

A formatted source must mean the same, have the same comments between the same words, and be formatted already;
and layouts that differ in blanks only are all formatted alike.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from tests.format.mutants import NAMES, broken_promises, forms
from tests.kit.campaign import Campaign

SHARE = 50


def one_share(share: tuple[str, int, int]) -> list[str]:
    """Format layouts of one source, and return which promises were broken."""
    name, first, last = share
    seeds = range(first, last)
    broken = [f"{name}, seed {seed}: {why}" for seed, why in broken_promises(name, seeds)]
    if len(forms(name, seeds[: max(len(seeds) // 10, 2)])) != 1:
        broken.append(f"{name}, from seed {first}: layouts that differ in blanks only")
    return broken


def main(arguments: Sequence[str] | None = None) -> int:
    """Format the mutants that the command line asks for."""
    campaign = Campaign("tests.format", __doc__)
    campaign.option("--mutants", type=int, default=2000, metavar="N", help="of all together")
    campaign.option("--first", type=int, default=0, metavar="SEED", help="the first seed")
    campaign.side_by_side()
    options = campaign.parse(arguments)
    last = options.first + -(-options.mutants // len(NAMES))
    starts = range(options.first, last, SHARE)
    shares = [(name, start, min(start + SHARE, last)) for name in NAMES for start in starts]
    for (name, *_), broken in campaign.each(one_share, shares):
        if broken:
            campaign.found(name, *broken[:3])
    return campaign.over(f"at most {SHARE} layouts a case")


if __name__ == "__main__":
    sys.exit(main())
