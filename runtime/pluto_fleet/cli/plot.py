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


def _drawn(shape: Figure, kind: str) -> bytes:
    drawn = BytesIO()
    metadata = {"Date": None} if kind == "svg" else {"Software": None}
    with rc_context({"svg.hashsalt": "pluto"}):
        shape.savefig(drawn, format=kind, metadata=metadata)
    return drawn.getvalue()
