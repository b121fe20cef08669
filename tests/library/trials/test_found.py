"""What trials have found: each case as small as it was made, and nothing of it is wrong any more."""

from __future__ import annotations

import tomllib
from functools import cache
from pathlib import Path

import pytest

from pluto_fleet.app import App
from pluto_fleet.files.fleet import fleet_of, load_fleet
from pluto_fleet.files.missions import missions_of
from pluto_fleet.files.reading import parsed
from pluto_fleet.files.toml import toml_text
from pluto_fleet.shared.hooks.context import Context
from pluto_fleet.trials.case import FAIR, Case, strikes_of, weather_of
from pluto_fleet.trials.explore import random_missions
from pluto_fleet.trials.lives import tried
from pluto_fleet.trials.record import TrialResult
from tests.kit.apps import EXAMPLES
from tests.kit.sections import Section, compare, params
from tests.trials.examples import app_of, example

HERE = Path(__file__).with_name("apps")


@pytest.mark.parametrize("section", params(HERE / "found.txt"))
def test_what_was_found_is_right_now(section: Section, update: bool) -> None:
    """What strikes does strike; all that happens to missions is as it is kept."""
    given = tomllib.loads(section.given)
    app = app_named(given.pop("app"))
    seed, weather = given.pop("seed", 1), given.pop("weather", "")
    missions = parsed("missions.toml", toml_text({"mission": given.pop("mission")}))
    strikes = given.pop("strikes", [""])
    fleet = fleet_of(parsed("fleet.toml", toml_text(given)), app)
    told: dict[str, None] = {}
    for each in strikes:
        case = Case(
            seed=seed,
            missions=tuple(missions_of(missions, app, fleet.airspace)),
            fleet=fleet,
            weather=weather_of(weather) if weather else FAIR,
            strikes=strikes_of(each) if each else (),
        )
        trial = tried(app, case)
        assert trial.wrong == ()
        assert all(trial.fired[strike.kind.value] == 1 for strike in case.strikes)
        told[lines(trial)] = None
    compare(section, "\n".join(["-- what happens", *told]), update)


def lines(trial: TrialResult) -> str:
    """Return what happened to the missions, in its order."""
    events = [
        f"{event['mission']} {event['event']}"
        for event in trial.events
        if "mission" in event and event["event"] != "log"
    ]
    return "\n".join([*events, f"{trial.lives} lives, {dict(sorted(trial.ends.items()))}"])


@cache
def app_named(name: str) -> App:
    """Return an app of the folder; all its actions are one function, which takes a while."""

    async def work(drone: object, trip: object, context: Context) -> None:
        await context.sleep(2.0)

    text = (HERE / f"{name}.pluto").read_text(encoding="utf-8")
    return app_of(text, {"spray": work, "dust": work})


@pytest.mark.parametrize(
    ("seed", "strikes", "weather"),
    [
        pytest.param(0, "crash@4,land@5", "", id="what is noted after an event is no part of it"),
        pytest.param(14, "skip@10", "link=0.3,action=0.3", id="what goes along is begun once"),
        pytest.param(
            53,
            "fall@8",
            "crash=0.1,link=0.3,action=0.3,battery=0.3,hook=0.1,block=0.2,disk=0.02,down=5",
            id="what goes along ends with its mission",
        ),
        pytest.param(
            1085,
            "land@5",
            "action=0.1,battery=0.3,block=0.2,late=0.3,slow=0.05,radio=0.5,jump=-50,down=60",
            id="a command that has not begun begins no more while all come down",
        ),
    ],
)
def test_what_was_found_of_events_is_right_now(seed: int, strikes: str, weather: str) -> None:
    """With the missions that were drawn then."""
    app = example("pursue")
    fleet = load_fleet(EXAMPLES / "pursue" / "fleet.toml", app)
    case = Case(
        seed=seed,
        missions=tuple(random_missions(app, fleet, seed)),
        fleet=fleet,
        weather=weather_of(weather) if weather else FAIR,
        strikes=strikes_of(strikes),
    )
    assert tried(app, case).wrong == ()
