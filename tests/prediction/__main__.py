"""Compares what is promised of a plan with what simulated Crazyflies take, flown through cflib.

    python -m tests.prediction
    python -m tests.prediction "long legs" pm10
    python -m tests.prediction --repeat 10 drugs_distribution
    python -m tests.prediction --random 20 --seed 7
    python -m tests.prediction --busy 8 --at-once 1 object_finder
    python -m tests.prediction --show prediction.jsonl

Each plan is simulated with many seeds, and flown in real time. What is known is kept at once, in the
file that --keep names: the same command goes on where it was interrupted.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from subprocess import Popen
from tempfile import mkdtemp
from threading import Event

from pluto_fleet.shared.domain.text import duration
from tests.apart import apart
from tests.kit.campaign import Campaign
from tests.prediction.flights import fly, promise
from tests.prediction.plans import Plan, known
from tests.prediction.random_plans import random_plans
from tests.prediction.record import Line, Promise, flown, keep, kept, promised
from tests.prediction.table import report

AT_ONCE = 4 * (os.cpu_count() or 1)
"""Flights side by side: one of five drones takes 6 % of a core, and three seconds of it to start."""
_BETWEEN = 4.0
"""Seconds between the first flights' starts."""
LOADED = 4.0
"""The load of the machine from which on a trip that fails is a finding, as it must not by our own lag."""
_LONGEST = 900.0
"""Seconds of the longest plan that is flown: among random ones there are longer ones."""
_INTERRUPTED = 128
"""The least exit code of what was interrupted."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Fly the plans that are named; 1 if a flight did not end as it should."""
    campaign = Campaign("tests.prediction", __doc__)
    campaign.unit = "plan"
    option = campaign.option
    what = "default: the examples and our own; with --random: none"
    option("names", nargs="*", metavar="PLAN", help=what)
    option("--random", type=int, default=0, metavar="N", help="also fly N random plans")
    option("--seed", type=int, default=0, metavar="S", help="what those are drawn from")
    option("--repeat", type=int, default=1, metavar="N", help="fly each plan N times")
    option("--seeds", type=int, default=50, metavar="N", help="simulate with N seeds")
    what = "keep the machine busy with N loops: then no trip may fail, however long it takes"
    option("--busy", type=int, default=0, metavar="N", help=what)
    campaign.side_by_side(AT_ONCE)
    file = Path("prediction.jsonl")
    what = f"what is known already, and gets known (default: {file})"
    option("--keep", type=Path, default=file, metavar="FILE", help=what)
    option("--show", type=Path, metavar="FILE", help="fly nothing: print what such a file has")
    options = campaign.parse(arguments)
    if options.show is not None:
        print("\n".join(_report(kept(options.show))))
        return 0
    plans = known()
    if unknown := [name for name in options.names if name not in plans]:
        campaign.parser.error(f"there is no {unknown[0]}; there are {', '.join(plans)}")
    names = options.names or ([] if options.random else list(plans))
    chosen = {name: plans[name] for name in names}
    chosen |= {plan.name: plan for plan in random_plans(options.random, options.seed)}
    folder = Path(mkdtemp(prefix="prediction-"))
    print(f"flights in {folder}; kept in {options.keep}", flush=True)
    flights = _Flights(chosen, folder, options.keep, options.seeds)
    with busy(options.busy):
        for each, cases in (
            (flights.promised, flights.unpromised()),
            (flights.flown, flights.unflown(options.repeat)),
        ):
            for name, wrong in campaign.each(each, cases, threads=True):
                if wrong:
                    campaign.found(str(name), wrong)
    return campaign.over(*_report([one for one in kept(options.keep) if one.plan in chosen]))


@contextmanager
def busy(loops: int) -> Iterator[None]:
    """Keep the machine busy."""
    spinning = [Popen([sys.executable, "-c", "while True: pass"]) for _ in range(loops)]
    try:
        yield
    finally:
        for one in spinning:
            one.kill()
            one.wait()


class _Flights:
    """What is simulated, and flown in real time; what is known is kept at once."""

    def __init__(self, plans: Mapping[str, Plan], folder: Path, file: Path, seeds: int) -> None:
        self._plans, self._folder, self._file, self._seeds = plans, folder, file, seeds
        self._sources = {
            name: plan.compiled(folder / _slug(name) / "app") for name, plan in plans.items()
        }
        self._begun = count()

    def unpromised(self) -> list[str]:
        """Return the plans that were not simulated before."""
        known = promised(kept(self._file))
        return [name for name in self._plans if name not in known]

    def promised(self, name: str) -> str:
        """Simulate a plan; return why that cannot be done."""
        place = self._folder / _slug(name) / "simulated"

        def simulated() -> Promise:
            return promise(self._plans[name], self._sources[name], place, self._seeds)

        return self._kept(name, simulated)

    def unflown(self, repeat: int) -> Iterator[str]:
        """Yield the plans that are still to be flown, the longest first, as often as that."""
        lines = kept(self._file)
        said, done = promised(lines), flown(lines)
        short = [name for name in said.keys() & self._plans if said[name].median <= _LONGEST]
        for name in sorted(short, key=lambda name: -said[name].median):
            yield from [name] * (repeat - sum(not one.code for one in done.get(name, ())))

    def flown(self, name: str) -> str:
        """Fly a plan; return what was wrong. The first flights do not begin all at once."""
        number = next(self._begun)
        if number < AT_ONCE:
            Event().wait(number * _BETWEEN)
        place = self._folder / _slug(name) / f"flight{number}"
        return self._kept(name, lambda: fly(self._plans[name], self._sources[name], place))

    def _kept(self, name: str, call: Callable[[], Line]) -> str:
        try:
            came = call()
        except AssertionError as error:
            return str(error)
        if isinstance(came, Promise):
            keep(self._file, came)
            print(f"{name}: {duration(came.median)} promised", flush=True)
            return ""
        if came.code < _INTERRUPTED:
            keep(self._file, came)
        print(f"{name}: {duration(came.makespan)} flown, exit code {came.code}", flush=True)
        if came.failed and came.load > LOADED:
            return f"{came.failed} trips have failed, at a load of {came.load:.1f}"
        return f"it ended with exit code {came.code}" if came.code else ""


def _report(lines: Sequence[Line]) -> Iterator[str]:
    return report(promised(lines), flown(lines))


def _slug(name: str) -> str:
    return "".join(letter if letter.isalnum() else "-" for letter in name)


if __name__ == "__main__":
    with apart():
        sys.exit(main())
