"""Feeds the compiler with odd input for some minutes, and prints what came of it.

    python -m tests.fuzz --minutes 10

The only exceptions may be `Rejected`. An input that ends otherwise ends the run, and its seed is
named: `--seed N` makes just that one again.
"""

from __future__ import annotations

from argparse import ArgumentParser
from random import Random
from time import monotonic

from tests.fuzz.tally import WRITTEN_EVERY, Tally
from tests.fuzz.trial import source_of, trial


def main() -> None:
    """Run until the time is over, or until an input breaks the compiler."""
    parser = ArgumentParser(prog="python -m tests.fuzz", description=__doc__)
    parser.add_argument("--minutes", type=float, default=10.0, help="how long (default: 10)")
    parser.add_argument("--from", dest="first", type=int, default=0, help="the first seed")
    parser.add_argument("--seed", type=int, help="make this one input, show it, and compile it")
    options = parser.parse_args()
    if options.seed is not None:
        print(source_of(Random(options.seed))[1].decode("utf-8", "replace"))
        print(trial(Random(options.seed), on_disk=True))
        return
    tally, seed, end = Tally(), options.first, monotonic() + options.minutes * 60
    try:
        while monotonic() < end:
            tally.add(trial(Random(seed), on_disk=seed % WRITTEN_EVERY == 0))
            seed += 1
    except Exception:
        print(f"seed {seed} breaks the compiler")
        raise
    finally:
        print("\n".join(tally.lines()))
    print("exceptions other than Rejected: none")


if __name__ == "__main__":
    main()
