"""Cuts holes into the examples: is what stood there, or was only begun, among the first five completions?

What is missing or wrong is told by its role; the share of those that are found must be 95 of 100.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

from tests.kit.campaign import Campaign
from tests.lsp.holes import FIRST, Cut, cuts, mistakes, offered, rank

WANTED = 0.95


def one_hole(cut: Cut) -> tuple[int | None, list[str]]:
    """Complete where a word was cut out: at which place it is offered, and what else is wrong."""
    made = offered(cut)
    return rank(cut, made), mistakes(cut, made)


def main(arguments: Sequence[str] | None = None) -> int:
    """Cut the holes that the command line asks for."""
    campaign = Campaign("tests.lsp", __doc__)
    campaign.option("--holes", type=int, default=1000, metavar="N")
    campaign.option("--seed", type=int, default=0)
    campaign.side_by_side()
    options = campaign.parse(arguments)
    found, missed = 0, []
    for cut, (at, wrong) in campaign.each(one_hole, cuts(options.holes, options.seed)):
        where = f"{cut.role} {cut.word} of {cut.path.parent.name}, {cut.kept} letters kept"
        if wrong:
            campaign.found(where, *wrong)
        if at is not None and at < FIRST:
            found += 1
        else:
            missed.append(f"  not among the first: {where}")
    share = found / max(found + len(missed), 1)
    fails = [] if share >= WANTED else [f"less than {WANTED:.0%}"]
    return campaign.over(*missed, f"{share:.1%} among the first {FIRST}", fails=fails)


if __name__ == "__main__":
    sys.exit(main())
