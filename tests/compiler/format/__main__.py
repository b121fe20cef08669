"""Formats many layouts of every example, and checks what `plutoc fmt` promises.

    python -m tests.compiler.format --mutants 2000

A formatted source must mean the same, have the same comments between the same words, and be
formatted already. Where one is not, the seed that shows it is named, and the exit code is 1.
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser
from collections.abc import Sequence
from time import perf_counter

from tests.compiler.format.mutants import NAMES, broken_promises, forms, mutant
from tests.compiler.format.promises import alone


def main(arguments: Sequence[str] | None = None) -> int:
    """Format the mutants that the command line asks for."""
    parser = ArgumentParser(
        prog="python -m tests.compiler.format", description=__doc__.splitlines()[0]
    )
    parser.add_argument("--mutants", type=int, default=2000, metavar="N", help="of all together")
    parser.add_argument("--first", type=int, default=0, metavar="SEED", help="the first seed")
    options = parser.parse_args(arguments)
    began, broken = perf_counter(), 0
    each = -(-options.mutants // len(NAMES))
    seeds = range(options.first, options.first + each)
    for name in NAMES:
        comments = sum(len(alone(mutant(name, seed))) for seed in seeds)
        one_form = len(forms(name, seeds[: max(each // 10, 2)])) == 1
        found = list(broken_promises(name, seeds))
        print(f"{name}: {each} mutants, {comments} comments, {len(found)} broken promises")
        for seed, why in found[:3]:
            print(f"  seed {seed}: {why}")
        if not one_form:
            print("  layouts that differ in blanks only are not all formatted alike")
        broken += len(found) + (not one_form)
    print(
        f"{each * len(NAMES)} mutants in {perf_counter() - began:.1f} s, {broken} broken promises"
    )
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
