"""What an action of a navigation gave, as the app knows such things.

A navigation that is a package of its own has another copy of `Photo` than the app, and its library
may count in numbers of its own: so what it gave is made anew. What is none of what the action gives is a
mistake of the navigation's, and no result.
"""

from __future__ import annotations

from math import isfinite
from typing import Any, SupportsFloat

from plutoc_runtime.domain.actions import PICK, RELEASE
from plutoc_runtime.domain.errors import Failure, FlightFailed
from plutoc_runtime.domain.model import Photo
from plutoc_runtime.domain.text import shown

LONGEST = 60


def outcome_of(drone: str, action: str, gave: object) -> object:
    """Return a number, a `Photo` or nothing; raise `FlightFailed` if it is none of these."""
    if action in (PICK, RELEASE):
        return None
    try:
        return _photo(gave) if action == "take_photo" else _number(gave)
    except (AttributeError, TypeError, ValueError):
        reason = f"the navigation of {drone} made a mistake: {action} gave {shown(gave)[:LONGEST]}"
        raise FlightFailed(Failure.ACTION, reason) from None


def _number(gave: object) -> float:
    if isinstance(gave, str) or not isinstance(gave, SupportsFloat):
        raise TypeError
    if not isfinite(number := float(gave)):
        raise ValueError
    return number


def _photo(gave: Any) -> Photo:
    """Return a photo like this one, of whichever copy of the class it is."""
    x, y, z = gave.position
    file = getattr(gave, "file", None)
    return Photo(
        position=(_number(x), _number(y), _number(z)),
        width=_number(gave.width),
        height=_number(gave.height),
        sees=tuple(map(str, getattr(gave, "sees", ()))),
        sharpness=_number(getattr(gave, "sharpness", 1.0)),
        file=None if file is None else str(file),
    )
