"""The campaign that compares promises with flights: its plans can be flown, and its tables are right."""

from __future__ import annotations

from dataclasses import replace
from importlib import import_module
from pathlib import Path

import pytest

from pluto_fleet.app import App, described
from pluto_fleet.files.fleet import fleet_of
from pluto_fleet.files.missions import missions_of
from pluto_fleet.files.plan_check import problems
from pluto_fleet.files.reading import parsed
from tests.kit.apps import NAMES
from tests.prediction.plans import OWN, Plan, example
from tests.prediction.random_plans import random_plans
from tests.prediction.record import Flown, Promise, flown, keep, kept, promised
from tests.prediction.table import report

TOLD = "3 min 20 s (9 flights)"
PROMISE = Promise(
    plan="ward",
    drones=4,
    p5=190.0,
    median=200.0,
    p95=210.0,
    battery=0.5,
    flights=9.0,
    exact=TOLD,
    dry_run=TOLD,
)
FLOWN = Flown(
    plan="ward", code=0, makespan=208.0, began=3.3, battery=0.56, flights=9, failed=0, load=1.0
)
REPORT = """\
| ward | 4 | 3 min 20 s (3 min 10 s–3 min 30 s) | 3 min 28 s | -3.8 % | 50 % | 56 % | -6.0 | 9 | 9 | as simulated |

ward: a flight ended with exit code 1, and does not count
makespan within 5 %: 1 of 1; median error 3.8 %, largest 3.8 %
lowest battery within 5 points: 0 of 1; largest difference 6.0

| plan | flights | seen: mean ± s.d. | least–most | promised (5–95 %) | inside |
| --- | --- | --- | --- | --- | --- |
| ward | 3 | 208.7 s ± 3.1 s | 206.0–212.0 s | 190.0–210.0 s | 2 of 3 |
"""


def test_the_report_says_by_how_much_a_promise_was_wrong_and_how_much_flights_differ() -> None:
    flights = [replace(FLOWN, makespan=seconds) for seconds in (206.0, 208.0, 212.0)]
    told = report({"ward": PROMISE}, {"ward": [*flights, replace(FLOWN, code=1, makespan=9.0)]})
    assert list(told)[2:] == REPORT.splitlines()


def test_a_dry_run_that_differs_is_shown() -> None:
    other = replace(PROMISE, dry_run="3 min 21 s (9 flights)")
    _, _, row, *_ = report({"ward": other}, {"ward": [FLOWN]})
    assert f"| 3 min 21 s (9 flights), and not {TOLD} |" in row


def test_what_is_kept_is_read_again_and_a_later_promise_counts(tmp_path: Path) -> None:
    file = tmp_path / "prediction.jsonl"
    assert kept(file) == []
    later = replace(PROMISE, median=201.0)
    for line in (PROMISE, FLOWN, later, FLOWN):
        keep(file, line)
    assert promised(kept(file)) == {"ward": later}
    assert flown(kept(file)) == {"ward": [FLOWN, FLOWN]}


@pytest.fixture(scope="module")
def tours(tmp_path_factory: pytest.TempPathFactory) -> App:
    """The app of our own plans."""
    source = OWN[0].compiled(tmp_path_factory.mktemp("tours") / "app")
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(str(source))
        return described(import_module("tours.flow").APP)


@pytest.mark.parametrize("plan", [*OWN, *random_plans(5, 1)], ids=lambda plan: plan.name)
def test_a_plan_can_be_flown(plan: Plan, tours: App) -> None:
    fleet = fleet_of(parsed("fleet.toml", plan.fleet), tours)
    missions = missions_of(parsed("missions.toml", plan.missions), tours, fleet.airspace)
    assert problems(missions, tours, fleet, fleet.airspace) == []


def test_random_plans_depend_on_their_seed_alone() -> None:
    assert list(random_plans(3, 5)) == list(random_plans(3, 5)) != list(random_plans(3, 6))


@pytest.mark.parametrize("name", NAMES)
def test_an_example_is_flown_once_in_a_world_that_shows_nothing(name: str) -> None:
    plan = example(name)
    assert "repeat = " not in plan.missions
    assert "feature" not in plan.fleet and plan.fleet.endswith("[world]\n")
    assert not any("SHARP = 0.7" in text for text in plan.sources.values())
