"""Panels of lines, as SVG, drawn by matplotlib: the same figures give the same bytes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO

from matplotlib import colormaps, rc_context
from matplotlib.figure import Figure


@dataclass(frozen=True, slots=True)
class Panel:
    """What is drawn beside others: a line for each name."""

    says: str
    lines: Mapping[str, Sequence[tuple[float, float]]]


def drawn(title: str, along: str, panels: Sequence[Panel]) -> bytes:
    """Return the picture, with one legend for all panels."""
    with rc_context({"svg.hashsalt": "pluto", "svg.fonttype": "none"}):
        shape = Figure(figsize=(10, 3.4), layout="constrained")
        for axes, panel in zip(shape.subplots(1, len(panels)), panels, strict=True):
            axes.set(xlabel=along, title=panel.says)
            shades = colormaps["viridis"].resampled(len(panel.lines) + 1)
            for number, (name, points) in enumerate(panel.lines.items()):
                axes.plot(*zip(*points, strict=True), marker=".", color=shades(number), label=name)
            axes.set_ylim(bottom=0)
        handles, labels = shape.axes[0].get_legend_handles_labels()
        shape.legend(handles, labels, loc="outside right center")
        shape.suptitle(title)
        file = BytesIO()
        shape.savefig(file, format="svg", metadata={"Date": None})
        return file.getvalue()
