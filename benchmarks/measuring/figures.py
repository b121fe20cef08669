"""What follows from the measurements: ratios in one run, and what they were meant to be."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from .rounds import Measured, Spread

Cases = Mapping[str, Measured]


@dataclass(frozen=True, slots=True, kw_only=True)
class Figure:
    """One figure, and what is wanted of it."""

    key: str
    says: str
    of: Callable[[Cases], Spread]
    cases: tuple[str, ...]
    """What it is made of."""
    least: float | None = None
    """It must be at least this."""
    most: float | None = None
    """It must be at most this."""
    by_median: bool = False
    """The median is what counts; the minimum otherwise."""

    def counts(self, spread: Spread) -> float:
        """Return the one number that counts."""
        return spread.median if self.by_median else spread.minimum

    @property
    def wanted(self) -> str:
        """Say what is wanted."""
        if self.least is not None:
            return f"≥ {self.least:g}"
        return "" if self.most is None else f"≤ {self.most:g}"

    def kept(self, number: float) -> bool:
        """Return whether it is as wanted."""
        enough = self.least is None or number >= self.least
        return enough and (self.most is None or number <= self.most)


def ratio(
    key: str,
    of: str,
    to: str,
    says: str,
    *,
    least: float | None = None,
    most: float | None = None,
) -> Figure:
    """Return the figure of how much CPU a trip costs in one case, in trips of another."""
    return Figure(
        key=key,
        says=says,
        of=lambda cases: cases[of].trip.over(cases[to].trip),
        cases=(of, to),
        least=least,
        most=most,
    )


def ground(key: str, case: str, says: str, *, most: float | None = None) -> Figure:
    """Return the figure of how long a drone stays down between two flights, in ms."""
    return Figure(
        key=key,
        says=says,
        of=lambda cases: Spread.of(gap * 1000 for gap in cases[case].on_the_ground),
        cases=(case,),
        most=most,
        by_median=True,
    )


FIGURES = (
    ratio(
        "ratio_ideal_contended",
        "ours_contended",
        "ideal_contended",
        "ours / hand-written asyncio, ten missions for each drone",
        most=1.0,
    ),
    ratio(
        "ratio_ideal_free",
        "ours_free",
        "ideal_free",
        "ours / hand-written asyncio, a drone for each mission",
        most=1.0,
    ),
    ratio(
        "ratio_journal",
        "ours_journal",
        "ideal_contended",
        "ours with each transition as a line of JSON / hand-written asyncio without",
        most=1.5,
    ),
    ratio(
        "times_plain",
        "ours_plain",
        "ours_contended",
        "the plain plan, `plutoc compile -O0` / ours",
    ),
    ratio(
        "ratio_direct",
        "direct_contended",
        "ideal_contended",
        "coroutines resumed from the callback / hand-written asyncio",
    ),
    ratio(
        "times_thesis",
        "thesis",
        "ours_contended",
        "the thesis's architecture in Python / ours",
        least=80,
    ),
    ratio("times_py_trees", "py_trees", "ours_contended", "py_trees / ours", least=15),
    ratio("times_transitions", "transitions", "ours_contended", "transitions / ours"),
    ratio(
        "times_python_statemachine",
        "python_statemachine",
        "ours_contended",
        "python-statemachine / ours",
    ),
    ratio("times_langgraph", "langgraph", "ours_contended", "LangGraph / ours"),
    ratio(
        "ratio_des",
        "ours_virtual_contended",
        "generators_contended",
        "ours in virtual time / bare generators",
        most=3.0,
    ),
    ratio(
        "ratio_des_free",
        "ours_virtual_free",
        "generators_free",
        "the same, a drone for each mission",
    ),
    ratio(
        "times_simpy", "simpy", "ours_virtual_contended", "SimPy / ours in virtual time", least=5
    ),
    Figure(
        key="mib_100k",
        says="MiB of 100,000 missions of 5 trips, all in flight at once",
        of=lambda cases: Spread.of([cases["ours_many"].peak_mib]),
        cases=("ours_many",),
        most=320,
    ),
    Figure(
        key="growth_100k",
        says="time of 100,000 missions in flight / of 10,000",
        of=lambda cases: Spread.of(cases["ours_many"].cpu).over(
            Spread.of(cases["ours_a_tenth"].cpu)
        ),
        cases=("ours_many", "ours_a_tenth"),
        most=12,
    ),
    Figure(
        key="threads_100k",
        says="threads while they fly",
        of=lambda cases: Spread.of([cases["ours_many"].threads]),
        cases=("ours_many",),
        most=1,
    ),
    ground(
        "landing_to_launch_ms",
        "ours_alone",
        "ms from a landing to the next launch: one mission of 60 trips, one drone",
        most=0.5,
    ),
    ground(
        "landing_to_launch_contended_ms",
        "ours_crowd",
        "the same, 60 missions waiting for 15 drones",
        most=0.5,
    ),
    ground("ideal_landing_to_launch_ms", "ideal_alone", "one mission, hand-written asyncio"),
    ground(
        "ideal_landing_to_launch_contended_ms",
        "ideal_crowd",
        "60 missions waiting, hand-written asyncio",
    ),
)


def figures(cases: Cases) -> Iterator[tuple[Figure, Spread]]:
    """Give every figure whose cases were all measured."""
    for figure in FIGURES:
        if all(name in cases for name in figure.cases):
            yield figure, figure.of(cases)
