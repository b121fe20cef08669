"""Small shares of the campaigns of `tests.trials`: examples struck everywhere, random apps in all weathers."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from invariants import hashes
from pluto_fleet.shared.domain.model import Drone
from pluto_fleet.shared.hooks.context import Context
from pluto_fleet.trials.explore import random_case
from pluto_fleet.trials.lives import tried
from tests.kit import apps
from tests.trials import campaign, strangers
from tests.trials.examples import example, fleet_of


@pytest.mark.long  # thousands of runs
@pytest.mark.first
def test_no_example_does_what_no_run_may_do(capsys: pytest.CaptureFixture[str]) -> None:
    """Struck at every row of its journal, by everything that can strike: two of those with most blocks."""
    code = campaign.main(["alfalfa", "night_round", "--seeds", "2"])  # all faults strike in two
    said = capsys.readouterr().out
    assert code == 0, said
    assert " 0 findings" in said


def test_no_random_app_does_what_no_run_may_do(capsys: pytest.CaptureFixture[str]) -> None:
    """Two categories, actions of their own, links that are lost over a slow radio, and all the rest."""
    code = strangers.main(["--apps", "6", "--cases", "2", "--drawn"])
    said = capsys.readouterr().out
    assert code == 0, said
    assert "6 apps in" in said and " 0 findings" in said


async def pollinate(drone: Drone, trip: Any, context: Context, *, dose: float) -> object:
    """Set the dose, and shed it bit by bit."""
    live = context.live(drone)
    await live.write("pollen.left", dose)
    while (left := await live.read("pollen.left")) > 0:
        await context.sleep(0.5)
        await live.write("pollen.left", max(0.0, left - dose / 3))
    return await live.read("temperature")


PLAIN = example("alfalfa")
GIVEN: Any = PLAIN.given
OWN = GIVEN.actions
SLOW = replace(OWN["pollinate"], hook=pollinate)
APP = apps.changed(PLAIN, actions={**OWN, "pollinate": SLOW})
FLEET = fleet_of("alfalfa", APP)


@pytest.mark.parametrize("seed", range(6))
def test_no_rule_is_broken_however_late_its_answers_are(seed: int) -> None:
    """The line to the gateway is slow, or the radio; the app dies while it asks; and so on."""
    trial = tried(APP, random_case(APP, FLEET, seed))
    assert trial.wrong == ()


@pytest.mark.process
def test_a_trial_does_not_depend_on_hashes() -> None:
    """With a journal, faults, a crash and all that comes of it."""
    one, two, three = hashes(missions=60, trips=2, drones=20)
    assert one == two == three
