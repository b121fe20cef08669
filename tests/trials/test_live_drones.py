"""An action that asks its drone and sets what is on it, in all weathers and under all strikes."""

from __future__ import annotations

from typing import Any

import pytest

from pluto_fleet.trials.explore import random_case
from pluto_fleet.trials.lives import tried
from plutoc_runtime.domain.model import Drone
from plutoc_runtime.hooks.context import Context
from tests.trials.examples import example, fleet_of


async def pollinate(drone: Drone, trip: Any, context: Context, *, dose: float) -> object:
    """Set the dose, and shed it bit by bit."""
    live = context.live(drone)
    await live.write("pollen.left", dose)
    while (left := await live.read("pollen.left")) > 0:
        await context.sleep(0.5)
        await live.write("pollen.left", max(0.0, left - dose / 3))
    return await live.read("temperature")


APP = example("alfalfa", {"pollinate": pollinate})
FLEET = fleet_of("alfalfa", APP)


@pytest.mark.parametrize("seed", range(25))
def test_no_rule_is_broken_however_late_its_answers_are(seed: int) -> None:
    """The line to the gateway is slow, or the radio; the app dies while it asks; and so on."""
    trial = tried(APP, random_case(APP, FLEET, seed))
    assert trial.wrong == ()
