"""`simulate --runs N --plot FILE`: how the runs lie, as a picture; matplotlib draws it."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.text import percent

if TYPE_CHECKING:
    from .summary import Run

KINDS = (".svg", ".png")

_BINS = 20
_INK = "#4c72b0"


def kind_of(path: Path) -> str:
    """Return which kind of picture a file's name asks for."""
    kind = path.suffix.lower()
    if kind not in KINDS:
        raise BadInput(f"{path}: a plot is an SVG or a PNG: give it a name that ends so")
    return kind


def drawing() -> Any:
    """Return matplotlib, or say how to come by it: before anything flies."""
    try:
        return import_module("matplotlib")
    except ImportError:
        raise BadInput(
            "a plot needs matplotlib, the extra `plot` of this package: "
            'pip install "matplotlib>=3.8"'
        ) from None


def plot(path: Path, title: str, runs: Sequence[Run]) -> None:
    """Write the picture: the same runs give the same bytes."""
    kind = kind_of(path)
    matplotlib = drawing()
    shape = import_module("matplotlib.figure").Figure(figsize=(10, 3.2), layout="constrained")
    good = [run.makespan for run in runs if run.success]
    panels = (
        ("makespan of what succeeded, s", good),
        ("flights", [float(run.attempts) for run in runs]),
        ("lowest battery, %", [100 * run.battery for run in runs if run.battery is not None]),
    )
    for axes, (what, values) in zip(shape.subplots(1, len(panels)), panels, strict=True):
        axes.set_xlabel(what)
        if values:
            axes.hist(values, bins=min(_BINS, max(1, len(set(values)))), color=_INK)
            axes.locator_params(axis="y", integer=True)
        else:
            axes.set(xticks=[], yticks=[])
    shape.axes[0].set_ylabel("runs")
    rate = percent(len(good) / len(runs))
    shape.suptitle(f"{title}: {len(good)} of {len(runs)} succeeded ({rate})".replace("$", r"\$"))
    picture = BytesIO()
    metadata = {"Date": None} if kind == ".svg" else {"Software": None}
    with matplotlib.rc_context({"svg.hashsalt": "pluto"}):
        shape.savefig(picture, format=kind[1:], metadata=metadata)
    try:
        path.write_bytes(picture.getvalue())
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        why = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        raise BadInput(f"{path}: the plot cannot be written: {why}") from None
