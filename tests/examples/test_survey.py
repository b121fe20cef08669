"""aerial_mapping at each place and on the way: the table of its page, judged by the app's own evaluator."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, fields, replace
from functools import partial
from statistics import mean, median
from typing import Any

import pytest

from pluto_fleet.cli import main as fleet_main
from pluto_fleet.files.missions import load_missions
from pluto_fleet.flight.simulate import simulate
from pluto_fleet.shared.domain.model import Photo
from pluto_fleet.shared.domain.text import duration
from tests.kit.apps import EXAMPLES, NO_FAULTS, Example, events, example
from tests.kit.command import run

SEEDS = range(20)
WAYS = {"at each place": "missions.toml", "on the way": "on_the_way.toml"}
README = EXAMPLES / "aerial_mapping" / "README.md"
BEGIN = "<!-- survey: begin -->\n"
END = "<!-- survey: end -->"


@dataclass(frozen=True, slots=True, kw_only=True)
class Survey:
    """What came of one run."""

    complete: bool
    seconds: float
    """Until the last mission has ended."""
    flights: int
    photos: int
    batteries: float
    """What all flights have taken, the ways home included."""
    ahead: Sequence[float]
    """What photos have in common with the next one of their strip."""
    aside: Sequence[float]
    """The same with the next strip."""


def surveyed(one: Example, file: str, seed: int) -> Survey:
    """Fly the missions of a file, by drones that are not charged meanwhile, so that their batteries tell it all."""
    fleet = replace(one.fleet, charges_at_home=False)
    missions = load_missions(EXAMPLES / one.name / file, one.app, fleet.airspace)
    outcome = simulate(
        one.app, missions, fleet, seed=seed, faults=NO_FAULTS, until=None, on_event=None
    )
    hooks: Any = sys.modules[f"{one.name}.hooks"]
    results = [one._replace(value=_own(hooks, one.value)) for one in outcome.results]
    photos = hooks.photos_of(hooks.Results(new=(), all=results))
    shots = hooks.best(photos)
    common: dict[float, list[float]] = {hooks.AHEAD: [], hooks.ASIDE: []}
    for place, other, least in hooks.neighbours(photos):
        common[least].append(hooks.overlap(shots[place], shots[other]))
    return Survey(
        complete=outcome.completed,
        seconds=max(float(str(event["t"])) for event in events(outcome, "mission.ended")),
        flights=len(events(outcome, "trip.launched")),
        photos=len(results),
        batteries=sum(1.0 - drone.battery_level for drone in outcome.drones),
        ahead=common[hooks.AHEAD],
        aside=common[hooks.ASIDE],
    )


def _own(hooks: Any, photo: object) -> object:
    """Return a photo of the package's own class."""
    return hooks.Photo(**{one.name: getattr(photo, one.name) for one in fields(_photo(photo))})


def _photo(value: object) -> Photo:
    assert isinstance(value, Photo)
    return value


def table(surveys: Mapping[str, Sequence[Survey]]) -> str:
    """Return what the page says of the two ways."""

    def share(values: Sequence[Sequence[float]]) -> str:
        each = [value for one in values for value in one]
        return f"{mean(each):.0%}, {min(each):.0%} at the least".replace("%", " %")

    rows: dict[str, Callable[[Sequence[Survey]], str]] = {
        "until the map is complete, median": lambda runs: duration(
            round(median(one.seconds for one in runs))
        ),
        "flights": lambda runs: f"{mean(one.flights for one in runs):.1f}",
        "photos, with those that were taken again": lambda runs: (
            f"{mean(one.photos for one in runs):.1f}"
        ),
        "batteries that it takes": lambda runs: f"{mean(one.batteries for one in runs):.2f}",
        "in common with the next photo of the strip": lambda runs: share(
            [one.ahead for one in runs]
        ),
        "in common with the next strip": lambda runs: share([one.aside for one in runs]),
        "runs in which every mission was completed": lambda runs: f"{sum(one.complete for one in runs)} of {len(runs)}",
    }
    lines = [f"| | {' | '.join(surveys)} |", f"| --- |{' ---: |' * len(surveys)}"]
    for called, said in rows.items():
        lines.append(f"| {called} | {' | '.join(said(runs) for runs in surveys.values())} |")
    return "\n".join(lines) + "\n"


def test_the_table_of_the_page_is_what_is_flown(update: bool) -> None:
    """On the way makes the same map by the same judge, in less time, and for less of the batteries."""
    one = example("aerial_mapping")
    surveys = {way: [surveyed(one, file, seed) for seed in SEEDS] for way, file in WAYS.items()}
    stops, goes_on = surveys.values()
    assert all(run.complete for run in (*stops, *goes_on))
    assert median(run.seconds for run in goes_on) < median(run.seconds for run in stops)
    assert mean(run.batteries for run in goes_on) < mean(run.batteries for run in stops)
    text = README.read_text(encoding="utf-8")
    before, _, rest = text.partition(BEGIN)
    shown, _, after = rest.partition(END)
    if update:
        README.write_text(f"{before}{BEGIN}{table(surveys)}{END}{after}", encoding="utf-8")
        shown = table(surveys)
    assert shown == table(surveys)


def test_a_line_takes_each_of_its_photos_once_however_others_are_in_its_way() -> None:
    """Drones cross above and below each other, and so fly their lines at other heights."""
    one = example("aerial_mapping")
    fleet = replace(one.fleet, charges_at_home=False)
    missions = load_missions(EXAMPLES / one.name / "on_the_way.toml", one.app, fleet.airspace)
    outcome = simulate(
        one.app, missions, fleet, seed=0, faults=NO_FAULTS, until=None, on_event=None
    )
    taken = [result for result in outcome.results if result.trip.along]
    heights = {round(_photo(result.value).position[2], 1) for result in taken}
    assert len(taken) == 24
    assert len(heights) > 1


def test_a_dry_run_has_each_photo_on_the_way(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is a command, though its drone stops for none."""
    monkeypatch.chdir(EXAMPLES / "aerial_mapping")
    files = ("on_the_way.toml", "--fleet", "fleet.toml")
    ran = run(
        partial(fleet_main, example("aerial_mapping").app), "fly", *files, "--sim", "--dry-run"
    )
    assert ran.code == 0, ran.out + ran.err
    assert ran.out.count("take_photo on the way") == 20
