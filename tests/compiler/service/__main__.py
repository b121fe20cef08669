"""`python -m tests.compiler.service --sequences 10000`: the whole campaign of edits, over all cores."""

from __future__ import annotations

from argparse import ArgumentParser
from concurrent.futures import ProcessPoolExecutor

from tests.compiler.service.sequences import Tally, run

SHARE = 100


def _share(first: int) -> tuple[Tally, list[str]]:
    tally, wrong = Tally(), []
    for seed in range(first, first + SHARE):
        try:
            run(seed, tally)
        except Exception as error:  # noqa: BLE001 - told with its seed, and the rest goes on
            wrong.append(f"seed {seed}: {type(error).__name__}: {error}")
    return tally, wrong


def main() -> int:
    """Run the campaign; exit 1 if an edit was not the one meant."""
    parser = ArgumentParser(description="Random sequences of edits, held against what was meant.")
    parser.add_argument("--sequences", type=int, default=10_000)
    parser.add_argument("--first", type=int, default=0, help="the first seed")
    options = parser.parse_args()
    whole, wrong = Tally(), []
    with ProcessPoolExecutor() as pool:
        seeds = range(options.first, options.first + options.sequences, SHARE)
        for tally, told in pool.map(_share, seeds):
            whole.done += tally.done
            whole.refused += tally.refused
            wrong += told
    for sentence in wrong[:5]:
        print(sentence)
    print(f"{options.sequences} sequences, {sum(whole.done.values())} edits, {len(wrong)} wrong")
    for name, count in whole.done.most_common():
        print(f"  {name:24} {count:7} done {whole.refused[name]:7} refused")
    return 1 if wrong else 0


if __name__ == "__main__":
    raise SystemExit(main())
