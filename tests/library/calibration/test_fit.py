"""What is fitted to journals of drones whose motion is known."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from random import Random
from typing import Any

import pytest
from msgspec import structs

from pluto_fleet.calibration.commands import Command, Flights, read_flights
from pluto_fleet.calibration.estimates import Calibration, Row, chi_square, fitted, student
from pluto_fleet.calibration.fit import calibrated
from pluto_fleet.jobs.flown import DONE, LEG
from pluto_fleet.shared.domain.model import Category, Point
from pluto_fleet.shared.domain.motion import CRAZYFLIE, STEADY, Motion, varied
from pluto_fleet.shared.time.kernel import Kernel
from pluto_fleet.simulation.radio import ANSWER, Radio
from tests.calibrating.cases import Tally
from tests.calibrating.cases import fitted as fitted_case
from tests.calibrating.flights import flown, surveyed
from tests.kit import apps

SLOW = replace(CRAZYFLIE, pace=1.1, settles=0.6, take_off=0.8, landing=1.2, drain=1.25)
EXACT = SLOW.exact


def test_journals_of_a_known_motion_are_fitted_within_their_uncertainty() -> None:
    """The first of a hundred cases, of which one in twenty may miss; `python -m tests.calibrating` fits all."""
    tally = Tally()
    for number in range(4):
        tally.add(number, *fitted_case(number))
    assert (len(tally.missed) <= 1, tally.noted) == (True, [])
    assert min(tally.told[name] for name in ("pace", "settles", "take_off", "spread")) == 4


def test_the_intervals_are_no_wider_than_they_need_be(tmp_path: Path) -> None:
    """One that always holds says nothing."""
    what = surveyed_and_fitted(tmp_path, replace(SLOW, spread=0.02), trips=90)
    wide = {name: found.high - found.low for name, found in what.found.items()}
    assert wide["pace"] < 0.02
    assert max(wide[name] for name in ("settles", "take_off", "landing")) < 0.5
    assert wide["spread"] < 0.01


def surveyed_and_fitted(
    folder: Path, motion: Motion, *, trips: int = 30, **more: object
) -> Calibration:
    path = surveyed(folder / "J", motion, said=CRAZYFLIE, trips=trips, **more)  # type: ignore[arg-type]
    return calibrated([read_flights(path)], CRAZYFLIE)


def test_what_does_not_vary_is_found_exactly(tmp_path: Path) -> None:
    what = surveyed_and_fitted(tmp_path, EXACT)
    for name in ("pace", "settles", "take_off", "landing", "drain"):
        assert what.found[name].value == pytest.approx(getattr(EXACT, name), abs=1e-3)
    assert what.found["spread"].value < 1e-3
    assert what.found["charge"].value == pytest.approx(1, abs=1e-3)
    assert (what.untold, what.notes, what.far_off) == ({}, [], 0)


def test_heights_at_which_drones_hover_do_not_count_as_the_spread_of_legs(tmp_path: Path) -> None:
    """They vary by 2.5 cm, so landings vary by three times as much as legs here."""
    truth = replace(SLOW, spread=0.005)
    spread = surveyed_and_fitted(tmp_path, truth, trips=60, seed=2).found["spread"]
    assert spread.low <= truth.spread <= spread.high


def test_an_acceleration_is_left_open_if_one_twice_as_large_explains_legs_as_well() -> None:
    """All legs of this case are long: near what explains them best, only less would do worse."""
    truth, what = fitted_case(86)
    assert "acceleration" in what.untold
    assert what.found["down"].low <= truth.down <= what.found["down"].high


def test_legs_that_lead_down_take_what_the_descent_takes() -> None:
    """As plans count with; else they would look like slow ones."""
    chance = Random(1)
    truth = replace(STEADY, pace=1.1)
    legs = []
    for at in range(40):
        start = (0.0, 0.0, 10.0 if at % 2 else 30.0)
        end = (chance.uniform(10.0, 90.0), 0.0, 40.0 - start[2])
        (_, _, seconds, settles), *_ = truth.stages([start, end], 5.0, False, False)
        legs.append(leg(start, end, seconds + settles))
    what = calibrated([of(legs)], STEADY)
    assert what.far_off == 0
    assert what.found["pace"].value == pytest.approx(1.1, abs=1e-3)


def test_an_overhead_that_is_less_than_none_is_none_and_the_rest_makes_up_for_it() -> None:
    """As with an autopilot that brakes more gently than the model: its longer legs must not be a second off."""
    truth = replace(STEADY, acceleration=1.0, settles=-1.0)
    chance = Random(1)
    metres = [chance.uniform(10.0, 90.0) for _ in range(60)]
    legs = [leg((0.0, 0.0, 9.0), (d, 0.0, 9.0), truth.flies(d, 5.0)) for d in metres]
    what = calibrated([of(legs)], STEADY)
    found: dict[str, Any] = {name: what.found[name].value for name in SHAPING if name in what.found}
    assert found["settles"] == 0.0
    motion = replace(STEADY, **found)
    for one in legs:
        assert motion.flies(one.metres, 5.0) == pytest.approx(one.seconds, abs=0.3)


SHAPING = ("pace", "settles", "acceleration", "jerk")


def leg(start: Point, end: Point, seconds: float) -> Command:
    return Command(
        drone="d",
        category="scout",
        what=LEG,
        start=start,
        end=end,
        speed=5.0,
        seconds=round(seconds, 4),
        ended_at=0.0,
        battery=(1.0, 1.0),
        ended=DONE,
    )


def test_some_commands_that_take_far_too_long_change_little(tmp_path: Path) -> None:
    """A radio that must say things again and again, for one."""
    chance = Random(1)

    def retries(kernel: Kernel, controls: object) -> Radio:
        def delay(what: str) -> float:
            return chance.uniform(3, 20) if what == ANSWER and chance.random() < 0.08 else 0.0

        return Radio(kernel, controls, delay)  # type: ignore[arg-type]

    truth = replace(SLOW, spread=0.02, action_spread=0.03)
    what = surveyed_and_fitted(tmp_path, truth, trips=60, around=retries)
    assert what.far_off > 10
    for name in ("pace", "settles", "take_off", "landing", "spread", "action_spread"):
        found = what.found[name]
        assert found.low <= getattr(varied(truth, 0), name) <= found.high, name


def test_legs_that_are_all_alike_do_not_tell_pace_from_settling(tmp_path: Path) -> None:
    app = apps.changed(apps.app(apps.flow(), categories=[SCOUT]), resumes=("allocate",))
    fleet = replace(apps.fleet((1.0, 1.0, 0.0)), motion=CRAZYFLIE)
    there = [apps.trip(str(at), 4.0, 1.0) for at in range(20)]
    path = flown(tmp_path / "J", app, fleet, apps.mission("m", *there), motion=EXACT)
    what = calibrated([read_flights(path)], CRAZYFLIE)
    assert what.untold["settles"].startswith("all legs are about as long")
    leg = EXACT.flies(3.0, SCOUT.speed)
    assert replace(CRAZYFLIE, pace=what.found["pace"].value).flies(3.0, SCOUT.speed) == (
        pytest.approx(leg, abs=1e-3)
    )


SCOUT = Category(name="scout", speed=0.5)


def test_a_category_that_moves_otherwise_is_noted(tmp_path: Path) -> None:
    """`[motion]` is for the whole fleet."""
    slow, fast = (
        flights.runs[0]
        for flights in (
            read_flights(surveyed(tmp_path / name, motion, said=CRAZYFLIE, trips=30, seed=seed))
            for name, motion, seed in (
                ("slow", replace(SLOW, spread=0.02), 1),
                ("fast", replace(SLOW, spread=0.02, pace=1.0), 2),
            )
        )
    )
    heavy = [structs.replace(one, category="heavy", drone=f"{one.drone}b") for one in slow]
    what = calibrated([of([*heavy, *fast])], CRAZYFLIE)
    first, second, *drones = what.notes
    assert first.startswith('category "heavy" takes ')
    assert "longer than the whole fleet" in first
    assert second.startswith('category "scout" takes ')
    assert "shorter than the whole fleet" in second
    assert all(one.startswith("drone ") for one in drones)


def of(commands: Sequence[Command]) -> Flights:
    return Flights(path=Path("J"), fleet=None, runs=[commands])


def test_short_legs_that_take_longer_than_a_settling_explains_are_noted(tmp_path: Path) -> None:
    """As drones do that overshoot after a hard acceleration."""
    truth = replace(EXACT, spread=0.01)
    path = surveyed(tmp_path / "J", truth, said=CRAZYFLIE, trips=60, within=4.0)
    commands = [
        structs.replace(one, seconds=one.seconds + 0.6 * (one.what == "leg" and one.metres < 1.5))
        for one in read_flights(path).commands
    ]
    what = calibrated([of(commands)], CRAZYFLIE)
    assert any(
        one.startswith("legs of less than ") and " s longer than " in one for one in what.notes
    )


def test_what_was_broken_off_or_failed_is_counted_and_not_fitted(tmp_path: Path) -> None:
    commands = list(
        read_flights(surveyed(tmp_path / "J", EXACT, said=CRAZYFLIE, trips=30)).commands
    )
    legs = [one for one in commands if one.what == "leg"]
    halved = [structs.replace(one, seconds=one.seconds / 2) for one in legs[:8]]
    bad = [structs.replace(one, ended="broken off") for one in halved[:5]]
    bad += [structs.replace(one, ended="failed") for one in halved[5:]]
    what = calibrated([of([*commands, *bad])], CRAZYFLIE)
    assert (what.broken_off, what.failed, what.far_off) == (5, 3, 0)
    assert what.found["pace"].value == pytest.approx(EXACT.pace, abs=1e-3)


@pytest.mark.parametrize(
    ("probability", "spare", "quantile"),
    [(0.975, 5, 2.571), (0.975, 30, 2.042), (0.995, 5, 4.032), (0.997, 10, 3.5)],
)
def test_students_quantiles(probability: float, spare: int, quantile: float) -> None:
    """As tables have them."""
    assert student(probability, spare) == pytest.approx(quantile, rel=0.01)


@pytest.mark.parametrize(
    ("probability", "spare", "quantile"),
    [(0.025, 10, 3.247), (0.975, 10, 20.483), (0.025, 50, 32.357), (0.995, 50, 79.490)],
)
def test_chi_square_quantiles(probability: float, spare: int, quantile: float) -> None:
    """As tables have them."""
    assert chi_square(probability, spare) == pytest.approx(quantile, rel=0.01)


def test_measurements_that_do_not_determine_the_parameters_are_not_fitted() -> None:
    alike = [Row((2.0, 1.0), 5.0 + at / 100) for at in range(20)]
    assert fitted(alike, relative=True, finest=1e-4, near=0.0) is None
    assert fitted(alike[:2], relative=True, finest=1e-4, near=0.0) is None
    assert fitted([], relative=True, finest=1e-4, near=0.0) is None


def test_each_kind_of_measurements_has_a_spread_of_its_own() -> None:
    """And those that vary less count more."""
    chance = Random(1)
    rows = [
        Row((1.0,), chance.gauss(5.0, spread), kind=kind)
        for kind, spread in (("fine", 0.01), ("coarse", 1.0))
        for _ in range(200)
    ]
    fit = fitted(rows, relative=False, finest=1e-4, near=0.0)
    assert fit is not None
    assert fit.spreads["fine"].value == pytest.approx(0.01, rel=0.15)
    assert fit.spreads["coarse"].value == pytest.approx(1.0, rel=0.15)
    assert fit.values[0].error == pytest.approx(0.01 / 200**0.5, rel=0.15)
