"""Edits apps by random sequences of operations, and holds each edit against what was meant."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from tests.kit.campaign import Campaign
from tests.service.sequences import Tally, run


def one_sequence(seed: int) -> Tally:
    """Make and undo a sequence; an edit that was not the one meant raises."""
    tally = Tally()
    run(seed, tally)
    return tally


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the sequences that the command line asks for."""
    campaign = Campaign("tests.service", __doc__)
    campaign.draws("sequences", 10_000)
    campaign.parse(arguments)
    whole = Tally()
    for _, tally in campaign.each(one_sequence, campaign.numbers):
        whole.done += tally.done
        whole.refused += tally.refused
    return campaign.over(
        *(
            f"{name:24} {n:7} done {whole.refused[name]:7} refused"
            for name, n in whole.done.most_common()
        )
    )


if __name__ == "__main__":
    sys.exit(main())
