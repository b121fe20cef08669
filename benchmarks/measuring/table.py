"""The measurements as text for people, and as values for programs."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from .figures import FIGURES, Cases, figures
from .rounds import Measured


def lines(cases: Cases) -> Iterator[str]:
    """Give the figures, then the measurements that they come from."""
    yield f"{'minimum':>9}{'median':>9}  wanted"
    for figure, spread in figures(cases):
        numbers = f"{spread.minimum:9.2f}{spread.median:9.2f}"
        kept = figure.kept(figure.counts(spread))
        yield f"{numbers}  {figure.wanted:6} {' ' if kept else '✗'} {figure.says}"
    yield ""
    yield f"{'µs of CPU a trip':22}{'minimum':>9}{'median':>9}{'runs':>6}{'MiB':>7}{'threads':>9}"
    for name, measured in cases.items():
        trip = measured.trip
        cost = f"{trip.minimum:9.2f}{trip.median:9.2f}{len(measured.cpu):6}"
        yield f"{name:22}{cost}{measured.peak_mib:7.0f}{measured.threads:9}"


def results(cases: Cases, missing: Sequence[str], about: Mapping[str, object]) -> dict[str, object]:
    """Return all that was measured: the figures by their keys, and what they come from."""
    known = list(figures(cases))
    return {
        **{figure.key: None for figure in FIGURES},  # something is not installed, or not asked for
        **{figure.key: round(figure.counts(spread), 4) for figure, spread in known},
        "minima": {figure.key: round(spread.minimum, 4) for figure, spread in known},
        "medians": {figure.key: round(spread.median, 4) for figure, spread in known},
        "cases": {name: raw(measured) for name, measured in cases.items()},
        "missing": list(missing),
        "about": dict(about),
    }


def raw(measured: Measured) -> dict[str, object]:
    """Return what was measured of one case."""
    trip = measured.trip
    return {
        "minimum_us": round(trip.minimum, 4),
        "median_us": round(trip.median, 4),
        "flights": measured.flights,
        "runs": len(measured.cpu),
        "least_wall_s": round(min(measured.wall), 6),
        "threads": measured.threads,
        "peak_mib": round(measured.peak_mib, 1),
    }
