"""How densely an area is covered: by the distance of its places, or by what photos have in common."""

from __future__ import annotations

from functools import partial
from math import atan, tan
from typing import TYPE_CHECKING, Any

from ..app import App
from ..shared.alone.world import HEIGHT, WIDTH
from ..shared.domain import values
from ..shared.domain.actions import MEASURE, PHOTO
from ..shared.domain.quantities import Type
from ..shared.events.declared import AlongField
from .reading import PlanTable

if TYPE_CHECKING:
    from .sweep import Covered, Sides

SPACING = values.Quantity(Type.LENGTH, 0.05, 10_000.0)
"""The side of the square around each place."""
OVERLAP = values.Quantity(Type.PERCENT, 0.0, 0.9)
"""The share of its ground that a photo has in common with one beside it."""
VIEW = values.Quantity(Type.ANGLE, 0.1, 3.0)

SIMULATED = (2 * atan(WIDTH / 2), 2 * atan(HEIGHT / 2))
"""What a camera of a simulated drone sees along x and along y, in radians."""


def read_covered(table: PlanTable, height: float) -> Covered | None:
    """Return what is covered from a place of an area; None: that is wrong, and noted."""
    spacing = table.value("spacing", SPACING)
    overlap = table.value("overlap", _overlaps)
    view = table.value("camera_view", partial(values.each, VIEW, "angle", (2,)))
    if "spacing" in table.data and "overlap" in table.data:
        table.problem("has a spacing and an overlap: leave out one", "overlap")
    elif "spacing" not in table.data and "overlap" not in table.data:
        table.problem("has no spacing", "spacing", is_missing=True)
    elif spacing is not None:
        return lambda _: (spacing, spacing)
    elif overlap is not None:
        wide, deep = (2 * height * tan(angle / 2) for angle in view or SIMULATED)
        return partial(_overlapping, wide, deep, *overlap)
    return None


def _overlapping(wide: float, deep: float, ahead: float, aside: float, is_wide: bool) -> Sides:
    """Return what photos that show so much ground cover beside what they have in common."""
    x, y = (ahead, aside) if is_wide else (aside, ahead)
    return wide * (1 - x), deep * (1 - y)


def _overlaps(value: object) -> tuple[float, float]:
    """Read how much photos have in common with the next one of their lane, and with that of the next lane."""
    if not isinstance(value, list):
        return OVERLAP(value), OVERLAP(value)
    found: tuple[Any, Any] = values.each(OVERLAP, "share", (2,), value)
    return found


def read_on_the_way(table: PlanTable, app: App) -> bool:
    """Return whether an area's action is done on the way, and note if it cannot be."""
    if not table.value("on_the_way", values.boolean):
        return False
    action = table.data.get("action")
    able = [name for one in app.fields if isinstance(one, AlongField) for name in one.actions]
    if "along" in table.data:
        table.problem("does its own action on the way: leave out along", "along")
    elif action in (PHOTO, MEASURE) and action not in able:
        said = f"the app does not {action} on the way: declare `action {action} along` in it"
        table.problem(said, "on_the_way")
    elif action not in able:
        table.problem(f"only {PHOTO} and {MEASURE} can be done on the way", "on_the_way")
    return action in able
