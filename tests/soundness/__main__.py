"""Compares the compiler's checks with the oracle on every app that is one edit away from ours.

    python -m tests.soundness
    python -m tests.soundness --random 2000 --seed 7
    python -m tests.soundness --events 2000
    python -m tests.soundness --loops 5000 --fly 50

Prints a table and every disagreement, with the app and a run that shows it; exits with 1 if there
is one. With `--fly` what is accepted is flown, too, by hooks that never change their mind, in virtual
time, and the first of them by the driver of real flights; it exits with 1 as well where a mission then never ends.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Callable, Iterator
from itertools import chain
from random import Random

from plutoc.compile import analyse
from plutoc.source import Source
from tests.kit.campaign import Campaign
from tests.soundness.app import App, thesis_graphs
from tests.soundness.compare import Compared, compare
from tests.soundness.endings import End, endings
from tests.soundness.mutants import mutants
from tests.soundness.randoms import event_app, looping_app, random_app
from tests.soundness.table import Tally, lines

DRAWN: dict[str, Callable[[Random], App]] = {
    "random": random_app,
    "events": event_app,
    "loops": looping_app,
}


def main() -> int:
    """Compare, and print."""
    campaign = Campaign("tests.soundness", __doc__)
    campaign.option("--random", type=int, default=0, metavar="N", help="random apps instead")
    campaign.option("--events", type=int, default=0, metavar="N", help="apps with events instead")
    campaign.option("--loops", type=int, default=0, metavar="N", help="apps full of loops instead")
    campaign.option(
        "--fly", type=int, metavar="N", help="fly what is accepted, N as in real flights, too"
    )
    campaign.option("--seed", type=int, default=1, metavar="N", help="of the first; default: 1")
    campaign.option(
        "--only", action="store_true", help="that one alone: of each kind that is asked for"
    )
    campaign.in_time()
    options = campaign.parse()
    apps = edited()
    wanted = {kind: getattr(options, kind) for kind in DRAWN}
    if any(wanted.values()):
        apps = chain.from_iterable(
            drawn(kind, min(number, 1) if options.only else number, options.seed)
            for kind, number in wanted.items()
        )
    tallies: dict[str, Tally] = {}
    ends: Counter[End] = Counter()
    left = options.fly or 0
    for number, ((name, what, app), compared) in enumerate(campaign.each(_one, apps)):
        tallies.setdefault(name, Tally()).add(compared)
        if options.fly is not None and not compared.codes:
            found = [*flown(app, number), *(flown(app, number, real=True) if left else ())]
            left = max(0, left - 1)
            ends.update(found)
            if End.HANGS in found:
                campaign.found(f"{name}: {what}: HANGS", app.text)
        if not compared.agrees:
            campaign.found(f"{name}: {what}", *said(app, compared))
        elif compared.judgement and compared.judgement.doubtful:
            print("\n".join([f"doubtful: {name}: {what}", *said(app, compared)]), flush=True)
    flights = [f"{ends[end]:8} missions: {end}" for end in End if options.fly is not None]
    return campaign.over(*lines(tallies), *flights)


def _one(case: tuple[str, str, App]) -> Compared:
    return compare(case[2])


def edited() -> Iterator[tuple[str, str, App]]:
    """Yield the thesis's graphs and every mutant of each."""
    for name, app in thesis_graphs().items():
        yield name, "as it is", app
        for mutant in mutants(app):
            yield name, f"{mutant.edit}: {mutant.what}", mutant.app


def drawn(kind: str, number: int, seed: int) -> Iterator[tuple[str, str, App]]:
    """Yield random apps, each with a seed of its own."""
    for one in range(seed, seed + number):
        yield kind, f"seed {one}", DRAWN[kind](Random(one if kind == "random" else f"{kind}/{one}"))


def flown(app: App, seed: int, *, real: bool = False) -> tuple[End, ...]:
    """Fly an app that the compiler accepts."""
    checked, _ = analyse(Source(path="app.pluto", text=app.text))
    return endings(checked, seed, real=real)


def said(app: App, compared: Compared) -> Iterator[str]:
    """Yield what both say of an app on which they do not agree."""
    judgement = compared.judgement
    assert judgement
    yield f"  the compiler: {', '.join(compared.codes) or 'accepted'}"
    for verdict, run in judgement.runs.items():
        yield f"  the oracle: {verdict}: {' · '.join(run)}"
    yield from (f"  the oracle: {fault}" for fault in judgement.faults)
    yield from (f"    {line}" for line in app.text.splitlines())


if __name__ == "__main__":
    sys.exit(main())
