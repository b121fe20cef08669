"""What was promised beside what was flown, as tables in Markdown."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from statistics import mean, median, stdev

from pluto_fleet.shared.domain.text import duration, number, percent
from tests.prediction.record import Flown, Promise

ERROR, POINTS = 5.0, 5.0
"""Percent of a makespan, and points of a battery, by which a promise may be wrong."""


def error(promise: Promise, flights: Sequence[Flown]) -> float:
    """Return by how many percent of the makespan flown the one promised is longer."""
    seen = median(one.makespan for one in flights)
    return 100.0 * (promise.median - seen) / seen


def points(promise: Promise, flights: Sequence[Flown]) -> float:
    """Return by how many points the lowest level promised is higher than the one seen."""
    return 100.0 * (promise.battery - median(one.battery for one in flights))


def report(
    promises: Mapping[str, Promise], flights: Mapping[str, Sequence[Flown]]
) -> Iterator[str]:
    """Yield the lines of the report: a row for each plan, the summary, and the spread."""
    done = {plan: ended for plan, all_ in flights.items() if (ended := _ended(all_))}
    both = [(promises[plan], done[plan]) for plan in promises if plan in done]
    yield from _table(
        (
            "plan",
            "drones",
            "simulate: median (5–95 %)",
            "crtp-sim",
            "error",
            "lowest battery: simulate",
            "crtp-sim",
            "points",
            "flights: simulate",
            "crtp-sim",
            "dry run",
        ),
        (_row(promise, seen) for promise, seen in both),
    )
    yield ""
    for plan, all_ in flights.items():
        for one in all_:
            if one.code:
                yield f"{plan}: a flight ended with exit code {one.code}, and does not count"
    if both:
        yield from _summary(both)
    if repeated := [(promise, seen) for promise, seen in both if len(seen) > 1]:
        yield ""
        yield from _table(
            ("plan", "flights", "seen: mean ± s.d.", "least–most", "promised (5–95 %)", "inside"),
            (_spread(promise, seen) for promise, seen in repeated),
        )


def _ended(flights: Sequence[Flown]) -> list[Flown]:
    """Return the flights whose missions were all completed."""
    return [one for one in flights if one.code == 0]


def _row(promise: Promise, flights: Sequence[Flown]) -> tuple[str, ...]:
    same = promise.exact == promise.dry_run
    return (
        promise.plan,
        str(promise.drones),
        f"{duration(promise.median)} ({duration(promise.p5)}–{duration(promise.p95)})",
        duration(median(one.makespan for one in flights)),
        f"{error(promise, flights):+.1f} %",
        percent(promise.battery),
        percent(median(one.battery for one in flights)),
        f"{points(promise, flights):+.1f}",
        number(promise.flights),
        number(median(one.flights for one in flights)),
        "as simulated" if same else f"{promise.dry_run}, and not {promise.exact}",
    )


def _summary(both: Sequence[tuple[Promise, Sequence[Flown]]]) -> Iterator[str]:
    errors = [abs(error(*one)) for one in both]
    off = [abs(points(*one)) for one in both]
    near = sum(one <= ERROR for one in errors)
    low = sum(one <= POINTS for one in off)
    yield (
        f"makespan within {ERROR:g} %: {near} of {len(both)}; median error {median(errors):.1f} %,"
        f" largest {max(errors):.1f} %"
    )
    yield (
        f"lowest battery within {POINTS:g} points: {low} of {len(both)}; largest difference"
        f" {max(off):.1f}"
    )


def _spread(promise: Promise, flights: Sequence[Flown]) -> tuple[str, ...]:
    spans = [one.makespan for one in flights]
    inside = sum(promise.p5 <= span <= promise.p95 for span in spans)
    return (
        promise.plan,
        str(len(spans)),
        f"{mean(spans):.1f} s ± {stdev(spans):.1f} s",
        f"{min(spans):.1f}–{max(spans):.1f} s",
        f"{promise.p5:.1f}–{promise.p95:.1f} s",
        f"{inside} of {len(spans)}",
    )


def _table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    yield f"| {' | '.join(header)} |"
    yield f"|{' --- |' * len(header)}"
    for row in rows:
        yield f"| {' | '.join(row)} |"
