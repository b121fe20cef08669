"""The driver of all campaigns: many cases are tried, and none may show anything that must not be.

A campaign says what its cases are and what is tried of each. This takes the command line, goes through the cases
in processes or threads, tells how far it is, ends in time, prints what is found, and gives the exit code:

    campaign = Campaign("tests.areas", __doc__)
    campaign.draws("areas", 1000)
    campaign.parse(arguments)
    for number, judged in campaign.each(one_area, campaign.numbers):
        if judged.wrong:
            campaign.found(f"area {number}", *judged.wrong)
    return campaign.over("so many trips")
"""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from importlib import import_module
from itertools import count, islice, takewhile
from multiprocessing import get_context
from time import monotonic
from traceback import format_exc
from typing import Any, TypeVar

Case = TypeVar("Case")
Came = TypeVar("Came")
Tried = tuple[Case, Any, str | None]
"""A case, what came of it, and what it has raised."""

TELLS_EVERY = 10.0
"""Seconds after which a person at a terminal is told how far it is."""
ENOUGH = 20
"""After so many findings no more is tried."""


class Campaign:
    """One campaign, from its command line to its exit code."""

    def __init__(self, module: str, doc: str | None) -> None:
        """Its name is that of the module which `python -m` runs, its help the docstring of that."""
        self.parser = ArgumentParser(
            prog=f"python -m {module}", description=doc, formatter_class=RawDescriptionHelpFormatter
        )
        self.option = self.parser.add_argument
        self.options = Namespace()
        self.findings = 0
        self.unit = "case"
        self._tried = 0
        self._began = monotonic()

    def draws(self, cases: str, default: int | None, *, seeded: bool = False) -> None:
        """Add the options of cases that are drawn, each from its number, or from a seed and its number.

        Without a default there is no end of them but that in time.
        """
        self.unit = cases.removesuffix("s")
        self.option(f"--{cases}", dest="cases", type=int, default=default, metavar="N")
        self.option("--from", "--first", dest="first", type=int, default=0, metavar="NUMBER")
        if seeded:
            self.option("--seed", type=int, default=1, help="what all are drawn from (default: 1)")
            self.option("--only", metavar="SEED/NUMBER", help="draw this one again, and no other")
        else:
            self.option(
                "--only", type=int, metavar="NUMBER", help="draw this one again, and no other"
            )
        self.side_by_side()
        self.in_time()

    def side_by_side(self, default: int = 1) -> None:
        """Add the option that says how many cases are tried at one time."""
        self.option(
            *("--processes", "--jobs", "--at-once"),
            dest="at_once",
            type=int,
            default=default,
            metavar="N",
            help=f"how many at one time (default: {default})",
        )

    def in_time(self, default: float | None = None) -> None:
        """Add the option that says when no more cases are begun."""
        self.option("--minutes", type=float, default=default, metavar="M")

    def parse(self, arguments: Sequence[str] | None = None) -> Namespace:
        """Read the command line; the time begins."""
        self.options = self.parser.parse_args(arguments)
        self._began = monotonic()
        return self.options

    @property
    def numbers(self) -> Iterable[int]:
        """The numbers of the cases that are drawn."""
        options = self.options
        if options.only is not None:
            return [int(str(options.only).rpartition("/")[2])]
        if options.cases is None:
            return count(options.first)
        return range(options.first, options.first + options.cases)

    @property
    def names(self) -> Iterable[str]:
        """The same with their seed, as `--only` takes them."""
        if self.options.only is not None:
            return [self.options.only]
        return (f"{self.options.seed}/{number}" for number in self.numbers)

    def each(
        self, one: Callable[[Case], Came], cases: Iterable[Case], *, threads: bool = False
    ) -> Iterator[tuple[Case, Came]]:
        """Try each case, and yield what came of it, as soon as it is known.

        What one raises is a finding, and the others are tried all the same. In processes what is tried, and what
        comes of it, is plain data; threads serve where a case is a process of its own.
        """
        minutes = getattr(self.options, "minutes", None)
        ends = self._began + 60 * minutes if minutes is not None else float("inf")
        begun = takewhile(lambda _: monotonic() < ends and self.findings < ENOUGH, cases)
        told = self._began
        for case, came, raised in self._all(partial(_tried, _by_its_name(one)), begun, threads):
            self._tried += 1
            if raised is None:
                yield case, came
            else:
                self.found(f"{self.unit} {case} raises", raised)
            if sys.stderr.isatty() and monotonic() > told + TELLS_EVERY:
                told = monotonic()
                print(self._so_far(), file=sys.stderr, flush=True)

    def _all(
        self, one: Callable[[Case], Tried[Case]], cases: Iterator[Case], threads: bool
    ) -> Iterator[Tried[Case]]:
        at_once = getattr(self.options, "at_once", 1)
        if at_once == 1:
            yield from map(one, cases)
        elif threads:
            with ThreadPoolExecutor(at_once) as pool:
                yield from pool.map(one, cases)
        else:
            with get_context("spawn").Pool(at_once) as processes:
                # by shares: a pool takes all cases at once, and would see no end of them, nor of the time
                while share := list(islice(cases, 20 * at_once)):
                    yield from processes.imap_unordered(one, share)

    def found(self, what: str, *lines: str) -> None:
        """Print at once what must not be."""
        self.findings += 1
        print("\n".join([f"--- {what}", *lines]), flush=True)

    def over(self, *lines: str, fails: Iterable[str] = ()) -> int:
        """Print what all has come to, and why that does not do if so; return the exit code."""
        why = list(fails)
        print("\n".join([*lines, *why, self._so_far()]))
        return 1 if self.findings or why else 0

    def _so_far(self) -> str:
        seconds = monotonic() - self._began
        return f"{self._tried} {self.unit}s in {seconds:.0f} s, {self.findings} findings"


def _by_its_name(one: Callable[[Case], Came]) -> Callable[[Case], Came]:
    """Return a function of the script that runs as one that other processes find, too: they run no package's script.

    One within another function, and a method, stay what they are: they are tried here, or in threads.
    """
    script = sys.modules["__main__"].__spec__
    is_own = getattr(one, "__module__", "") == "__main__"
    if script is None or not is_own or "." in one.__qualname__:
        return one
    found: Callable[[Case], Came] = getattr(import_module(script.name), one.__name__)
    return found


def _tried(one: Callable[[Case], Came], case: Case) -> Tried[Case]:
    try:
        return case, one(case), None
    except Exception:  # noqa: BLE001 - whatever it is, it is a finding
        return case, None, format_exc()
