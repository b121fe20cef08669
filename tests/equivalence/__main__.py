"""Holds optimised packages against plain ones on random graphs, plans, seeds and mishaps.

    python -m tests.equivalence --graphs 10000 --seed 1
    python -m tests.equivalence --only 1/4711

Prints what was seen how often, and each graph that leaves two traces, made as small as it goes;
exits with 1 if there is one, or if something that should have occurred never did.
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from collections.abc import Iterator
from multiprocessing import get_context
from time import perf_counter

from tests.equivalence.campaign import Tally, blamed, differs, one_graph
from tests.equivalence.coverage import missed
from tests.equivalence.shrink import shrunk

SHOWN = 5
"""Findings that are made smaller and printed."""


def main() -> int:
    """Run the campaign that the command line asks for."""
    parser = ArgumentParser(prog="python -m tests.equivalence")
    parser.add_argument("--graphs", type=int, default=10_000, metavar="N")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--only", metavar="SEED/NUMBER", help="one graph, as it was named")
    options = parser.parse_args()
    began = perf_counter()
    names = [f"{options.seed}/{number}" for number in range(options.graphs)]
    if options.only:
        names = [options.only]
    tally = Tally()
    with get_context("spawn").Pool(options.processes) as pool:
        for each in pool.imap_unordered(one_graph, names, chunksize=min(50, len(names))):
            tally.add(each)
    print("\n".join(lines(tally)))
    print(f"{perf_counter() - began:.0f} s")
    unseen = [] if options.only else missed(tally.seen)
    for what in unseen:
        print(f"never seen: {what}")
    return 1 if tally.findings or unseen else 0


def lines(tally: Tally) -> Iterator[str]:
    """Yield what a campaign has come to."""
    for what, count in sorted(tally.seen.items()):
        yield f"{count:8} {what}"
    share = tally.graphs / max(1, tally.graphs + tally.refused)
    yield f"{tally.graphs} sound graphs ({share:.0%} of those drawn), {tally.flights} pairs of runs,"
    yield f"{tally.events} events; {len(tally.findings)} runs leave two traces"
    for finding in sorted(tally.findings, key=lambda finding: len(finding.text))[:SHOWN]:
        yield ""
        small = shrunk(finding, differs)
        yield str(small)
        yield f"after the pass: {blamed(small)}"


if __name__ == "__main__":
    sys.exit(main())
