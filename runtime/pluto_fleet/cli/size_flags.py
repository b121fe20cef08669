"""The flags of `size`."""

from __future__ import annotations

from argparse import ArgumentParser
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from ..arguments import whole_number
from ..shared.domain.fields import time_of_day
from ..shared.domain.quantities import Type, parse_quantity, time_from, typed
from ..shared.domain.text import quoted

LEAST, MOST = 0.5, 0.9999
"""The confidences that can be asked for."""

MOST_DRONES, MOST_RUNS = 1000, 1_000_000


@dataclass(frozen=True, slots=True)
class Deadline:
    """When the missions must be completed."""

    text: str
    seconds: float
    """Since midnight, or since the first mission begins."""
    is_time_of_day: bool


def deadline(text: str) -> Deadline:
    """Read 08:30, or a time such as 20min."""
    if ":" not in text:
        return Deadline(text, time_from(text), False)
    try:
        return Deadline(text, time_of_day(text.strip()), True)
    except ValueError as error:
        raise ValueError(f"{quoted(text)} {error}") from None


def confidence(text: str) -> float:
    """Read 99%, or 0.99."""
    try:
        share = parse_quantity(text, Type.PERCENT)
    except ValueError as error:
        raise ValueError(f"{quoted(text)} {error}") from None
    if not LEAST <= share <= MOST:
        raise ValueError(f"{quoted(text)} is not between 50 % and 99.99 %: write it like 99%")
    return share


def add_size(size: ArgumentParser, time: Callable[[str], float]) -> None:
    """Add the flags of `size` that no other command has."""
    size.add_argument(
        "--by",
        metavar="TIME",
        type=typed(deadline),
        help="by when all missions must be completed: how long after the first begins, such as"
        ' "20 min", or a time of day, such as 08:30; default: no matter when',
    )
    size.add_argument(
        "--confidence",
        metavar="SHARE",
        type=typed(confidence),
        default=0.99,
        help="how probable that shall be (default 99%%)",
    )
    size.add_argument(
        "--runs",
        metavar="N",
        type=whole_number(1, MOST_RUNS),
        help="how often a fleet is simulated at most; default: as often as the confidence takes",
    )
    size.add_argument(
        "--max",
        dest="most",
        metavar="N",
        type=whole_number(1, MOST_DRONES),
        help="how many drones at most; default: four for each mission, and four more",
    )
    size.add_argument(
        "--swap",
        metavar="TIME",
        type=time,
        help="batteries are swapped in this time instead of charged in the dock",
    )
    size.add_argument(
        "--write", metavar="F.toml", type=Path, help="write the fleet into a new fleet file"
    )
    size.add_argument(
        "--plot",
        metavar="FILE",
        type=Path,
        help="draw how sure fleets of each size are, into an .svg or a .png; needs matplotlib",
    )
    size.add_argument("--json", action="store_true", help="print one JSON object instead")
