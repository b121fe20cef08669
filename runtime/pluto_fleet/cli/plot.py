"""Plots of many runs, drawn by matplotlib."""

from __future__ import annotations

from collections.abc import Sequence
from io import BytesIO

from matplotlib import rc_context
from matplotlib.figure import Figure

_BINS = 20
_INK = "#4c72b0"


def histograms(kind: str, title: str, panels: Sequence[tuple[str, Sequence[float]]]) -> bytes:
    """Return an svg or a png with a histogram a panel: the same figures give the same bytes."""
    shape = Figure(figsize=(10, 3.2), layout="constrained")
    for axes, (what, values) in zip(shape.subplots(1, len(panels)), panels, strict=True):
        axes.set_xlabel(what)
        if values:
            axes.hist(values, bins=min(_BINS, max(1, len(set(values)))), color=_INK)
            axes.locator_params(axis="y", integer=True)
        else:
            axes.set(xticks=[], yticks=[])
    shape.axes[0].set_ylabel("runs")
    shape.suptitle(title.replace("$", r"\$"))
    return _drawn(shape, kind)


def sizes(
    kind: str, title: str, points: Sequence[tuple[int, float, float, float]], confidence: float
) -> bytes:
    """Return an svg or a png of the share of successes, with its bounds, for each number of drones."""
    shape = Figure(figsize=(7, 3.6), layout="constrained")
    axes = shape.subplots()
    drones = [point[0] for point in points]
    shares = [100 * point[1] for point in points]
    below = [100 * (share - low) for _, share, low, _ in points]
    above = [100 * (high - share) for _, share, _, high in points]
    axes.errorbar(drones, shares, yerr=(below, above), fmt="o", capsize=4, color=_INK)
    axes.axhline(100 * confidence, color="#c44e52", linewidth=1)
    axes.set(xlabel="drones", ylabel="runs that succeed, %", ylim=(-5, 105))
    axes.locator_params(axis="x", integer=True)
    shape.suptitle(title.replace("$", r"\$"))
    return _drawn(shape, kind)


def _drawn(shape: Figure, kind: str) -> bytes:
    drawn = BytesIO()
    metadata = {"Date": None} if kind == "svg" else {"Software": None}
    with rc_context({"svg.hashsalt": "pluto"}):
        shape.savefig(drawn, format=kind, metadata=metadata)
    return drawn.getvalue()
