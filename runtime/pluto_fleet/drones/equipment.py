"""A drone's sensors and gripper as the fleet file names them, in the same words for every make."""

from __future__ import annotations

from collections.abc import Mapping

from ..shared.domain.actions import USUAL_QUANTITY, Plain
from ..shared.domain.text import quoted

ANY_OTHER = "*"
"""The key in `measure` for all quantities that are not named there."""


def quantity_of(parameters: Mapping[str, Plain]) -> str:
    """Return the quantity that a trip is to measure."""
    return str(parameters.get("quantity", USUAL_QUANTITY))


def source_of(measure: Mapping[str, str], quantity: str) -> str | None:
    """Return what a quantity is read from; None: nothing is named for it."""
    return measure.get(quantity, measure.get(ANY_OTHER))


def no_source(
    drone: str, measure: Mapping[str, str], quantity: str, source: str, such_as: str
) -> str:
    """Return that no source of a quantity is named, and where to name it."""
    has = f"it measures {', '.join(measure)}; " if measure else ""
    return (
        f"{drone} cannot measure {quoted(quantity)}: {has}name its {source} in the fleet file:"
        f" measure = {{ {quantity} = {quoted(such_as)} }}"
    )


def no_gripper(drone: str, what: str, such_as: str) -> str:
    """Return that no gripper is named, and where to name it."""
    return f"{drone} cannot pick or release: name {what} in the fleet file: grip = {such_as}"
