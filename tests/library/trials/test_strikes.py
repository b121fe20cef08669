"""Each thing that can strike does strike, and the missions bear it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from pluto_fleet.trials.case import BY_HAND, DEATHS, STOPS, Case, Strike, StrikeKind, Weather
from pluto_fleet.trials.lives import tried
from pluto_fleet.trials.record import TrialResult
from tests.trials.examples import example, fleet_of, missions_of

APP = example("alfalfa")
FLEET = fleet_of("alfalfa", APP)
CASE = Case(seed=3, missions=tuple(missions_of("alfalfa", APP, FLEET)[:1]), fleet=FLEET)
ROW = 4
"""A drone is on its way."""


def struck(kind: StrikeKind, after: float = 0.0) -> TrialResult:
    """Return what comes of the example when something strikes it."""
    return tried(APP, replace(CASE, strikes=(Strike(kind=kind, row=ROW, after=after),)))


@pytest.mark.parametrize("kind", StrikeKind)
def test_what_strikes_is_borne(kind: StrikeKind) -> None:
    """It strikes once, nothing is that may not be, and the mission ends."""
    trial = struck(kind, after=1.0 if kind is StrikeKind.FALL else 0.0)  # who stands cannot fall
    assert trial.fired[kind.value] == 1
    assert trial.wrong == ()
    (end,) = trial.ends.values()
    assert end == ("CANCELLED" if kind is StrikeKind.CANCEL else "COMPLETED")


@pytest.mark.parametrize(
    "kind",
    [*DEATHS, *STOPS, StrikeKind.FREEZE, StrikeKind.GATEWAY, StrikeKind.CUT, StrikeKind.DISK],
)
def test_after_these_the_app_lives_again(kind: StrikeKind) -> None:
    """Once more, and no oftener."""
    assert struck(kind).lives == 2


@pytest.mark.parametrize("kind", [*BY_HAND, StrikeKind.REBOOT, StrikeKind.FALL])
def test_these_the_app_outlives(kind: StrikeKind) -> None:
    """It need not be started again."""
    assert struck(kind).lives == 1


def test_a_lost_row_is_not_on_record_and_a_kept_one_is() -> None:
    """That is what tells two deaths apart."""
    plain = tried(APP, CASE)
    row = next(place for place, time in enumerate(plain.times, start=1) if time > 0)
    kept, lost = (
        tried(APP, replace(CASE, strikes=(Strike(kind=kind, row=row),)))
        for kind in (StrikeKind.KEPT, StrikeKind.LOST)
    )
    before = [trial.events.index(_second_life(trial)) for trial in (kept, lost)]
    assert before[0] > before[1]
    assert kept.wrong == lost.wrong == ()


def _second_life(trial: TrialResult) -> object:
    return [event for event in trial.events if event["event"] == "brain.began"][1]


@pytest.mark.parametrize(
    ("weather", "what"),
    [
        (Weather(hook=0.5), "hook raising"),
        (Weather(block=1.0), "hook blocking"),
        (Weather(late=1.0), "late wake-up"),
        (Weather(slow=0.4), "slow line"),
        (Weather(radio=0.3), "slow radio"),
        (Weather(disk=0.2), "slow disk"),
        (Weather(link=0.5), "flight: link"),
        (Weather(crash=0.6), "flight: crash"),
        (Weather(action=0.5), "flight: action"),
        (Weather(battery=0.5), "flight: battery"),
    ],
)
def test_bad_weather_is_borne(weather: Weather, what: str) -> None:
    """It is bad, and nothing is that may not be."""
    trial = tried(APP, replace(CASE, weather=weather))
    assert trial.fired[what] > 0
    assert trial.wrong == ()


@pytest.mark.parametrize(
    ("weather", "what"),
    [
        (Weather(jump=100.0), "clock jump"),
        (Weather(jump=-50.0), "clock jump"),
        (Weather(down=60.0), "failsafe"),
    ],
)
def test_bad_weather_between_two_lives_is_borne(weather: Weather, what: str) -> None:
    """It needs a death to show."""
    strikes = (Strike(kind=StrikeKind.CRASH, row=ROW, after=1.0),)
    trial = tried(APP, replace(CASE, weather=weather, strikes=strikes))
    assert trial.fired[what] > 0
    assert trial.wrong == ()
