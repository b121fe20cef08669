"""How high a vehicle is: above where it was armed, whatever its satellites, and its home, say meanwhile."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.mavlink.state import VehicleState

GROUND = 2.0
IN_AIR = 2
ON_GROUND = 1
ARMED = 128


def heard(height: float, home: float = 488.0) -> dict[str, Any]:
    """Return what is told of a position, so high above a home that is so high above sea level."""
    return {
        "clock": 0,
        "place": [47.397742, 8.545594],
        "heights": [home + height, height],
        "velocity": [0.0, 0.0, 0.0],
        "heading": None,
    }


def told(landed: int, base: int) -> VehicleState:
    """Return the state of one that has told no position yet."""
    state = VehicleState(None, GROUND)
    state.hear("landed", landed)
    state.hear("beat", {"base": base, "mode": 0})
    state.hear("landed", landed)
    return state


def test_what_stands_is_on_the_ground_to_whatever_height_its_home_has_drifted() -> None:
    state = told(ON_GROUND, 0)
    state.hear("position", heard(-1.4))
    assert state.position is not None
    assert state.position[2] == GROUND


def test_a_home_that_is_set_anew_counts_in_the_air_alone() -> None:
    """And not where it is heard of for the first time."""
    state = told(ON_GROUND, 0)
    state.hear("position", heard(0.0))
    state.hear("position", heard(0.0, home=495.0))
    assert not state.lifted
    state = told(IN_AIR, ARMED)
    state.hear("position", heard(10.0))
    state.hear("position", heard(10.1, home=488.4))
    assert not state.lifted
    state.hear("position", heard(7.1, home=491.4))
    assert state.lifted == pytest.approx(3.0)
