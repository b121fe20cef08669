"""What an action gave is what the app knows, with either copy of the runtime in its navigation."""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, nan

import pytest

from pluto_fleet.drones.commands import result_of
from pluto_fleet.shared.domain.errors import FlightFailed
from pluto_fleet.shared.domain.model import Photo, Point


@dataclass
class Picture:
    """A photo of another copy of the runtime."""

    position: Point
    width: float
    height: float


def test_a_photo_is_one_of_this_copy() -> None:
    gave = Picture((1, 2, 3), 2, 1.5)
    assert result_of("cf1", "take_photo", gave) == Photo(
        position=(1.0, 2.0, 3.0), width=2.0, height=1.5
    )
    whole = Photo(position=(1, 2, 3), width=2, height=1, sees=("bloom",), sharpness=0.5, file="a")
    assert result_of("cf1", "take_photo", whole) == whole


@pytest.mark.parametrize(
    ("action", "gave"),
    [
        ("measure", None),
        ("measure", "21"),
        ("measure", nan),
        ("take_photo", 3.0),
        ("take_photo", Picture((1, 2, inf), 1, 1)),
    ],
)
def test_anything_else_is_a_mistake_of_the_navigation(action: str, gave: object) -> None:
    with pytest.raises(FlightFailed, match=f"navigation of cf1 made a mistake: {action} gave"):
        result_of("cf1", action, gave)
