"""What holds for all drones of a fleet file: `[fleet]`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from plutoc_runtime.domain.model import AfterTrip
from plutoc_runtime.domain.quantities import Type

from . import limits, values

if TYPE_CHECKING:
    from .table import Table

APART = 0.5
"""Metres: two Crazyflies nearer than that blow each other off course."""

CRAZYFLIE = "crazyflie"
"""How drones are flown where the file names nothing else."""

OWN = "own"
"""Localization is the drones' own affair."""

KEYS = ("after_trip", "apart", "max_airborne", "navigation", "localization")


@dataclass(frozen=True, slots=True, kw_only=True)
class Behaviour:
    """`[fleet]`."""

    after_trip: AfterTrip = AfterTrip.HOME
    apart: float = APART
    max_airborne: int | None = None
    navigation: str = CRAZYFLIE
    localization: str = OWN


def read_behaviour(top: Table) -> Behaviour:
    """Return it, with what goes without saying."""
    table = top.table("fleet")
    if table is None:
        return Behaviour()
    table.only(KEYS, "[fleet]")
    apart = table.read("apart", partial(values.quantity, kind=Type.LENGTH, limit=limits.APART))
    return Behaviour(
        after_trip=table.read("after_trip", _after_trip) or AfterTrip.HOME,
        apart=APART if apart is None else apart,
        max_airborne=table.read("max_airborne", partial(values.integer, least=1)),
        navigation=table.read("navigation", values.name) or CRAZYFLIE,
        localization=table.read("localization", values.name) or OWN,
    )


def _after_trip(value: object) -> AfterTrip:
    for choice in AfterTrip:
        if value == choice.value:
            return choice
    raise values.Wrong(f"is none of: {', '.join(choice.value for choice in AfterTrip)}")
