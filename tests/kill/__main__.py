"""Kills brains and gateways of real flights at random moments, and says what came of it.

    python -m tests.kill --brain 500 --gateway 100

Every flight is resumed after each kill and judged at its end: nothing that was acknowledged may be
lost, no mission may hang, and nothing may be picked or released twice, counted by the simulated
world. The moments are drawn by the seed, but real processes meet them differently each time.
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from pathlib import Path
from tempfile import mkdtemp
from time import monotonic

from tests.kill.campaign import campaign
from tests.kill.tally import Tally


def main() -> int:
    """Run the campaign; 1 if anything was wrong."""
    parser = ArgumentParser(prog="python -m tests.kill", description=__doc__)
    parser.add_argument("--brain", type=int, default=500, help="kills of the brain (default: 500)")
    parser.add_argument("--gateway", type=int, default=100, help="of the gateway (default: 100)")
    parser.add_argument("--seed", type=int, default=1, help="which moments (default: 1)")
    parser.add_argument("--folder", type=Path, help="where to fly; default: a new one, named")
    options = parser.parse_args()
    folder = options.folder or Path(mkdtemp(prefix="kill-"))
    folder.mkdir(parents=True, exist_ok=True)
    print(f"flights in {folder}", flush=True)
    began = monotonic()

    def tell(tally: Tally) -> None:
        if tally.flights % 10 == 0 or tally.problems:
            brains, gateways = tally.brains.total(), tally.gateways.total()
            print(
                f"{monotonic() - began:.0f} s: {tally.flights} flights, {brains} brains and"
                f" {gateways} gateways killed, {len(tally.problems)} problems",
                flush=True,
            )

    tally = campaign(
        folder, brains=options.brain, gateways=options.gateway, seed=options.seed, tell=tell
    )
    print("\n".join(tally.lines()))
    print(f"{monotonic() - began:.0f} s")
    return 1 if tally.problems else 0


if __name__ == "__main__":
    sys.exit(main())
