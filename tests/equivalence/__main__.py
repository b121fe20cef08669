"""Holds optimised packages against plain ones on random graphs, plans, seeds and mishaps.

    python -m tests.equivalence --graphs 10000 --seed 1
    python -m tests.equivalence --only 1/4711

Prints what was seen how often, and each graph that leaves two traces, made as small as it goes;
exits with 1 if there is one, or if something that should have occurred never did.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator

from tests.equivalence.campaign import Tally, blamed, one_graph, smallest
from tests.equivalence.coverage import missed
from tests.kit.campaign import Campaign

SHOWN = 5
"""Findings that are made smaller and printed."""


def main() -> int:
    """Run the campaign that the command line asks for."""
    campaign = Campaign("tests.equivalence", __doc__)
    campaign.draws("graphs", 10_000, seeded=True)
    campaign.parser.set_defaults(at_once=2)
    options = campaign.parse()
    tally = Tally()
    for _, each in campaign.each(one_graph, campaign.names):
        tally.add(each)
    for finding in sorted(tally.findings, key=lambda finding: len(finding.text))[:SHOWN]:
        small = smallest(finding)
        campaign.found(finding.name, str(small), f"after the pass: {blamed(small)}")
    unseen = [] if options.only else missed(tally.seen)
    return campaign.over(*lines(tally), fails=[f"never seen: {what}" for what in unseen])


def lines(tally: Tally) -> Iterator[str]:
    """Yield what a campaign has come to."""
    for what, count in sorted(tally.seen.items()):
        yield f"{count:8} {what}"
    share = tally.graphs / max(1, tally.graphs + tally.refused)
    yield f"{tally.graphs} sound graphs ({share:.0%} of those drawn), {tally.flights} pairs of runs,"
    yield f"{tally.events} events; {len(tally.findings)} runs leave two traces"


if __name__ == "__main__":
    sys.exit(main())
