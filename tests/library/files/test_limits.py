"""The smallest and the largest of each number in a plan are accepted, and what is accepted flies.

What is said of numbers beyond is in `sentences/fleets_beyond.txt` and `missions_beyond.txt`.
"""

from __future__ import annotations

from pathlib import Path
from random import Random
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from pluto_fleet.files.fleet import BETWEEN, FleetFile, load_fleet
from pluto_fleet.files.missions import load_missions
from pluto_fleet.files.plan_check import problems
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.model import Mission
from pluto_fleet.shared.domain.values import RADIUS, SIDE
from pluto_fleet.trials.case import Case, Strike, StrikeKind, Weather
from pluto_fleet.trials.lives import TrialRun
from tests.library.files.extremes import CATEGORIES, Extremes, extreme_app

DRONE = '[[drone]]\nid = "a"\ncategory = "scout"\nhome = [1, 1]\n'
SOURCE = f'{DRONE}[[world.source]]\nquantity = "pm10"\npeak = 3\n'
TRIP = '[[mission]]\nname = "m"\n[[mission.trip]]\naction = "measure"\ntarget = [1, 1]\n'

TURNS = 4000
"""Of a run's clock: more show nothing new, and a plan may well last for years."""


def load(
    folder: Path, fleet: str, missions: str, number: int = 0
) -> tuple[FleetFile, list[Mission[Any]]]:
    """Read both files of a plan."""
    (folder / "f.toml").write_text(fleet, encoding="utf-8")
    (folder / "m.toml").write_text(missions, encoding="utf-8")
    app = extreme_app(number)
    found = load_fleet(folder / "f.toml", app)
    return found, load_missions(folder / "m.toml", app, found.airspace)


@pytest.mark.parametrize(
    "fleet",
    [
        f"{SOURCE}at = [1, 1]\nradius = {RADIUS.least}\n",
        f"{SOURCE}at = [1, 1]\nradius = {RADIUS.most}\n",
        f"[map]\nsize = [{SIDE.most}, {SIDE.most}]\n{DRONE}",
        f"[fleet]\napart = {BETWEEN.least}\n{DRONE}",
        f"[fleet]\napart = 0\n{DRONE}",
    ],
)
def test_the_ends_are_accepted(tmp_path: Path, fleet: str) -> None:
    """Both of them, and 0 where that says that there is none."""
    load(tmp_path, fleet, TRIP)


@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(number=st.integers(0, len(CATEGORIES) - 1), seed=st.integers(0, 10**6))
def test_what_is_accepted_flies(tmp_path: Path, number: int, seed: int) -> None:
    """In the simulated world, with all that goes wrong there, and under any Stop: nothing is raised."""
    rng, app = Random(seed), extreme_app(number)
    drawn = Extremes(rng)
    try:
        fleet, missions = load(tmp_path, drawn.fleet(), drawn.missions(), number)
    except BadInput:
        return  # it was drawn into a no-fly area, say
    if problems(missions, app, fleet, fleet.airspace):
        return
    kind = rng.choice((StrikeKind.RTL, StrikeKind.LAND, StrikeKind.CRASH, StrikeKind.GATEWAY))
    strikes = (Strike(kind=kind, row=rng.choice((1, 3, 6)), after=rng.choice((0.0, 3.0))),)
    weather = Weather(crash=0.1, link=0.1, battery=0.1)
    case = Case(seed=seed, missions=tuple(missions), fleet=fleet, weather=weather, strikes=strikes)
    run = TrialRun(app, case)
    run.start_life()
    for _ in range(TURNS):
        if run.over or not run.turn():
            break
    trial = run.record.closed(run.lives)
    for brain in run.brains:
        brain.die()
    run.world.close()
    assert [said for said in run.found if not said.startswith("it goes on for ever")] == []
    assert not any("Error" in said for said in trial.wrong)
