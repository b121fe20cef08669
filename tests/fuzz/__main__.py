"""Feeds the compiler with odd input for some minutes, and prints what came of it.

    python -m tests.fuzz --minutes 10

The only exceptions may be `Rejected`: the seed of an input that ends otherwise is named, and `--seed N` makes just
that one again.
"""

from __future__ import annotations

import sys
from random import Random

from tests.fuzz.trial import WRITTEN_EVERY, Outcome, Tally, source_of, trial
from tests.kit.campaign import Campaign


def main() -> int:
    """Run until the time is over, or until inputs break the compiler."""
    campaign = Campaign("tests.fuzz", __doc__)
    campaign.draws("inputs", None)
    campaign.parser.set_defaults(minutes=10.0)
    campaign.option("--seed", type=int, dest="only", help="the same as --only")
    options = campaign.parse()
    if options.only is not None:
        print(source_of(Random(options.only))[1].decode("utf-8", "replace"))
    tally = Tally()
    for _, outcome in campaign.each(one, campaign.numbers):
        tally.add(outcome)
    return campaign.over(*tally.lines())


def one(seed: int) -> Outcome:
    """Make an input and compile it."""
    return trial(Random(seed), on_disk=seed % WRITTEN_EVERY == 0)


if __name__ == "__main__":
    sys.exit(main())
