"""Compares the compiler's checks with the oracle on every app that is one edit away from ours.

    python -m tests.soundness
    python -m tests.soundness --random 2000 --seed 7

Prints a table and every disagreement, with the app and a run that shows it; exits with 1 if there
is one.
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from collections.abc import Iterator
from random import Random

from tests.soundness.app import App
from tests.soundness.compare import Compared, compare
from tests.soundness.mutants import mutants
from tests.soundness.randoms import random_app
from tests.soundness.table import Tally, lines
from tests.soundness.thesis import thesis_graphs


def main() -> int:
    """Compare, and print."""
    parser = ArgumentParser(prog="python -m tests.soundness")
    parser.add_argument("--random", type=int, default=0, metavar="N", help="random apps instead")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    apps = randoms(options.random, options.seed) if options.random else edited()
    tallies: dict[str, Tally] = {}
    for name, what, app in apps:
        compared = compare(app)
        tallies.setdefault(name, Tally()).add(compared)
        if not compared.agrees or (compared.judgement and compared.judgement.doubtful):
            print("\n".join(said(f"{name}: {what}", app, compared)), flush=True)
    print("\n".join(lines(tallies)))
    return 1 if any(tally.disagreements for tally in tallies.values()) else 0


def edited() -> Iterator[tuple[str, str, App]]:
    """Yield the thesis's graphs and every mutant of each."""
    for name, app in thesis_graphs().items():
        yield name, "as it is", app
        for mutant in mutants(app):
            yield name, f"{mutant.edit}: {mutant.what}", mutant.app


def randoms(number: int, seed: int) -> Iterator[tuple[str, str, App]]:
    """Yield random apps, each with a seed of its own."""
    for one in range(seed, seed + number):
        yield "random", f"seed {one}", random_app(Random(one))


def said(title: str, app: App, compared: Compared) -> Iterator[str]:
    """Yield what both say of an app on which they do not agree."""
    judgement = compared.judgement
    assert judgement
    yield f"{'doubtful' if judgement.doubtful else 'DISAGREEMENT'}: {title}"
    yield f"  the compiler: {', '.join(compared.codes) or 'accepted'}"
    for verdict, run in judgement.runs.items():
        yield f"  the oracle: {verdict}: {' · '.join(run)}"
    yield from (f"  the oracle: {fault}" for fault in judgement.faults)
    yield from (f"    {line}" for line in app.text.splitlines())


if __name__ == "__main__":
    sys.exit(main())
