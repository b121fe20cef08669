"""Rounds: in each, every case runs once, and each round begins with another case.

So a disturbance of the machine affects all of them alike, and none always runs first.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from importlib.util import find_spec
from pathlib import Path
from statistics import median

from contenders.process import Said

PATIENCE = 300.0
"""Seconds that a case may take: one that waits for ever must not keep all others waiting."""

HOME = Path(__file__).parents[1]
"""Where the contenders are imported from."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """A contender with some work to do."""

    name: str
    module: str
    """Of the package `contenders`."""
    arguments: tuple[str, ...] = ()
    needs: str = "asyncio"
    """What must be installed for it."""
    rounds: int | None = None
    """It runs in so many rounds only; None: in all."""

    @property
    def command(self) -> list[str]:
        """What is run."""
        return [sys.executable, "-m", f"contenders.{self.module}", *self.arguments]


@dataclass(slots=True, kw_only=True)
class Measured:
    """What a case has said of itself, over all rounds."""

    flights: int = 0
    cpu: list[float] = field(default_factory=list)
    wall: list[float] = field(default_factory=list)
    on_the_ground: list[float] = field(default_factory=list)
    threads: int = 0
    peak_mib: float = 0.0

    def add(self, said: Said) -> None:
        """Take in what a process has said."""
        self.flights = said["flights"]
        self.cpu += said["cpu"]
        self.wall += said["wall"]
        self.on_the_ground += said["on_the_ground"]
        self.threads = max(self.threads, said["threads"])
        self.peak_mib = max(self.peak_mib, said["peak_mib"])

    @property
    def trip(self) -> Spread:
        """Microseconds of CPU a flight."""
        return Spread.of(seconds / self.flights * 1e6 for seconds in self.cpu)


@dataclass(frozen=True, slots=True, kw_only=True)
class Spread:
    """The least and the median of some figures."""

    minimum: float
    median: float

    @classmethod
    def of(cls, figures: Iterable[float]) -> Spread:
        """Return those of these."""
        known = list(figures)
        return cls(minimum=min(known), median=median(known))

    def over(self, other: Spread) -> Spread:
        """Return the ratio of minima, and that of medians."""
        return Spread(minimum=self.minimum / other.minimum, median=self.median / other.median)


def environment() -> dict[str, str]:
    """Return what a process is run with: bytecode is kept, and hashes are those of every run."""
    unwanted = ("PYTHONDONTWRITEBYTECODE", "PYTHONPROFILEIMPORTTIME", "PYTHONASYNCIODEBUG")
    kept = {name: value for name, value in os.environ.items() if name not in unwanted}
    path = os.pathsep.join(filter(None, [str(HOME), kept.get("PYTHONPATH")]))
    return {**kept, "PYTHONPATH": path, "PYTHONHASHSEED": "0"}


def installed(cases: Iterable[Case]) -> tuple[list[Case], list[str]]:
    """Return the cases that can run, and what is missing for the others."""
    known = list(cases)
    missing = dict.fromkeys(case.needs for case in known if find_spec(case.needs) is None)
    return [case for case in known if case.needs not in missing], list(missing)


def asked(case: Case, patience: float = PATIENCE) -> Said:
    """Run a case once, and return what it says."""
    try:
        done = subprocess.run(
            case.command,
            env=environment(),
            capture_output=True,
            text=True,
            check=False,
            timeout=patience,
        )
    except subprocess.TimeoutExpired:
        raise SystemExit(f"{case.name} was not done within {patience:.0f} s") from None
    if done.returncode:
        raise SystemExit(f"{case.name} failed:\n{done.stderr}")
    said: Said = json.loads(done.stdout.splitlines()[-1])
    return said


def run(
    cases: Sequence[Case],
    rounds: int,
    tell: Callable[[str], None],
    ask: Callable[[Case], Said] = asked,
) -> dict[str, Measured]:
    """Run them all, round after round."""
    measured = {case.name: Measured() for case in cases}
    for number in range(rounds):
        tell(f"round {number + 1} of {rounds}")
        first = number * len(cases) // rounds
        for case in (*cases[first:], *cases[:first]):
            if case.rounds is None or number < case.rounds:
                measured[case.name].add(ask(case))
    return measured
