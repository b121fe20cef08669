"""What a trial is: cases as text, files that show one again, how one is made smaller, and that measuring changes none."""

from __future__ import annotations

import gc
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from pluto_fleet.files.fleet import default_fleet, load_fleet
from pluto_fleet.files.missions import load_missions
from pluto_fleet.files.writing import fleet_text, missions_text
from pluto_fleet.gateway.gateway import Gateway
from pluto_fleet.trials import command, explore, lives
from pluto_fleet.trials.case import (
    FAIR,
    Case,
    Strike,
    StrikeKind,
    Weather,
    strikes_of,
    strikes_text,
    weather_of,
    weather_text,
)
from pluto_fleet.trials.explore import Tally, explored, random_case, random_missions, shrunk
from pluto_fleet.trials.lives import TrialRun, tried
from pluto_fleet.trials.record import TrialResult
from tests.trials.examples import WAITING, app_of, example, fleet_of

APP = example("drugs_distribution_retry")
FLEET = fleet_of("drugs_distribution_retry", APP)

BLOWS = st.builds(
    Strike,
    kind=st.sampled_from(StrikeKind),
    row=st.integers(1, 10**6),
    after=st.sampled_from((0.0, 0.4, 1.125, 7.0)),
)


@given(st.lists(BLOWS, max_size=5).map(tuple))
def test_what_strikes_can_be_written_and_read(strikes: tuple[Strike, ...]) -> None:
    """As a word of a command line."""
    assert strikes_of(strikes_text(strikes)) == strikes


@pytest.mark.parametrize(
    "text", ["crash", "crash@", "crash@x", "fire@3", "crash@1+", "crash@-1", "crash@0"]
)
def test_what_cannot_strike_is_refused(text: str) -> None:
    """It says how it is written."""
    with pytest.raises(ValueError, match=r"is not written like|nothing that can strike"):
        strikes_of(text)


@given(
    st.builds(
        Weather,
        crash=st.sampled_from((0.0, 0.1)),
        slow=st.sampled_from((0.0, 0.4)),
        down=st.sampled_from((1.0, 60.0)),
    )
)
def test_weather_can_be_written_and_read(weather: Weather) -> None:
    """What is fair of it is left out."""
    assert weather == FAIR or weather_of(weather_text(weather)) == weather


@pytest.mark.parametrize("text", ["rain=1", "slow", "slow=much"])
def test_what_is_no_weather_is_refused(text: str) -> None:
    """It says what there is."""
    with pytest.raises(ValueError, match=r"is no weather|is not written like"):
        weather_of(text)


@pytest.mark.parametrize(
    "text", ["crash=2", "link=-0.1", "hook=nan", "slow=1e9", "radio=-1", "down=inf", "jump=nan"]
)
def test_weather_that_cannot_be_is_refused(text: str) -> None:
    """What waits for ever by itself would pass for a mistake."""
    with pytest.raises(ValueError, match=r"is not between -?\d+ and \d+"):
        weather_of(text)


@pytest.mark.parametrize("seed", range(3))
def test_drawn_missions_are_what_a_person_could_write(seed: int, tmp_path: Path) -> None:
    """Written down and read again they fly the same, row by row."""
    missions, fleet = tmp_path / "m.toml", tmp_path / "f.toml"
    drawn = random_missions(APP, FLEET, seed)
    missions.write_text(missions_text(APP, drawn), encoding="utf-8")
    fleet.write_text(fleet_text(FLEET), encoding="utf-8")
    there = load_fleet(fleet, APP)
    again = load_missions(missions, APP, there.airspace)
    first = tried(APP, Case(seed=seed, missions=tuple(drawn), fleet=FLEET))
    second = tried(APP, Case(seed=seed, missions=tuple(again), fleet=there))
    assert first.events == second.events
    assert first.ends == second.ends


@pytest.mark.parametrize("seed", range(5))
def test_the_same_case_is_the_same_trial(seed: int) -> None:
    """Event by event, under all that strikes it."""
    one, two = (tried(APP, random_case(APP, FLEET, seed)) for _ in range(2))
    assert one == two


def test_a_case_is_made_as_small_as_it_can_be() -> None:
    """What does not matter is left out: here all but one mission, one trip and one crash."""
    case = random_case(APP, FLEET, 1)
    strikes = (
        Strike(kind=StrikeKind.PAUSE, row=2),
        Strike(kind=StrikeKind.CRASH, row=5, after=2.2),
    )
    case = Case(seed=1, missions=case.missions, fleet=FLEET, weather=case.weather, strikes=strikes)

    def fails(case: Case) -> bool:
        return tried(APP, case).fired["crash"] > 0

    assert fails(case)
    small = shrunk(case, fails)
    assert small.weather == FAIR
    assert [str(strike) for strike in small.strikes] == ["crash@1"]
    assert [len(mission.trips) for mission in small.missions] in ([1], [2])  # 2: pick and release
    assert len(small.fleet.drones) == 1


def test_trials_leave_nothing_behind(monkeypatch: pytest.MonkeyPatch) -> None:
    """Many thousands come one after the other: none keeps its world in memory for long."""
    monkeypatch.setattr(explore, "FORGOTTEN", 4)
    cases = (random_case(APP, FLEET, seed) for seed in range(8))
    explored(APP, cases, Tally(), lambda _: False)
    assert [one for one in gc.get_objects() if isinstance(one, TrialRun)] == []


def test_a_plan_of_many_days_does_not_go_on_for_ever() -> None:
    """What waits as its trips say is in time, however long that takes."""
    app = app_of(WAITING)
    trip: Any = app.trip  # which has the field `delay`, by its graph
    trips = [
        trip(name=str(x), index=x, action="measure", target=(2.0, 3.0, 1.0), delay=5 * 86_400.0)
        for x in range(3)
    ]
    mission = app.mission(name="m1", index=0, trips=trips)
    trial = tried(app, Case(seed=1, missions=(mission,), fleet=default_fleet(app)))
    assert trial.wrong == ()
    assert trial.ends == {"m1": "COMPLETED"}


def _measured(seed: int, monkeypatch: pytest.MonkeyPatch) -> TrialResult:
    with monkeypatch.context() as patch:
        patch.setattr(lives, "Gateway", partial(Gateway, measures=True))
        return tried(APP, random_case(APP, FLEET, seed))


@pytest.mark.parametrize("seed", range(3))
def test_measurements_change_nothing(seed: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """No row more, no other instant, no other event, whatever strikes."""
    plain, measured = tried(APP, random_case(APP, FLEET, seed)), _measured(seed, monkeypatch)
    others = tuple(event for event in measured.events if event["event"] != "drone.flew")
    assert len(others) < len(measured.events)
    assert others == plain.events
    assert (measured.times, measured.acts, measured.ends) == (plain.times, plain.acts, plain.ends)
    assert measured.wrong == plain.wrong == ()


def test_the_bar_fills_as_runs_are_done(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the first seeds there are hundreds of runs each: it is neither full at once nor empty for long."""
    shares: list[float] = []

    class Waiting:
        def update(self, share: float, _: str) -> None:
            shares.append(share)

        def clear(self) -> None:
            pass

    monkeypatch.setattr(command, "trial_progress", lambda *, lines: Waiting())
    monkeypatch.setattr(explore, "MOST_ROWS", 4)
    assert command.test(example("drugs_distribution"), ["--seeds", "2", "--json"]) == 0
    assert len(shares) > 50
    assert shares[0] == 0
    assert 0.4 < shares[len(shares) // 2] < 0.6
    assert 0.9 < shares[-1] < 1.1
