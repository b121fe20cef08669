"""A forecast is what many runs of the same missions say, with the drones as they are now; one is rehearsed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from pluto_fleet.flight.simulate import simulate
from pluto_fleet.report.spread import spread
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.app import moving
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.station.config import StationConfig
from pluto_fleet.station.history.past import PastFlights
from pluto_fleet.station.preflight.preflight import KEPT
from pluto_fleet.station.preflight.question import Question
from pluto_fleet.station.wire import Forecast
from pluto_fleet.trials.case import fresh
from tests.kit.apps import example
from tests.library.files.an_app import APP
from tests.library.station.history.test_past import frames_of
from tests.library.station.plan.drawing import handling, mission, trip
from tests.library.station.preflight.asking import (
    FLEET,
    SCOUTS,
    THREE,
    answer,
    of,
    photos,
    present,
    question,
    texts,
)


@pytest.mark.parametrize(("apart", "world"), [(0.5, "traffic"), (0.0, "alone")])
def test_with_full_batteries_it_is_what_simulate_says_of_as_many_runs(
    apart: float, world: str, tmp_path: Path
) -> None:
    asked = question(*THREE, fleet=replace(FLEET, apart=apart), faults=Faults(link=0.2), runs=9)
    runs = [
        simulate(
            asked.app,
            [fresh(one) for one in asked.missions],
            asked.fleet,
            seed=seed,
            faults=asked.faults,
            until=None,
            on_event=None,
        )
        for seed in range(9)
    ]
    told = spread([run.duration for run in runs if run.completed])
    forecast = answer(asked, tmp_path)
    assert told is not None
    assert (forecast["runs"], forecast["world"]) == (9, world)
    assert (forecast["median"], forecast["high"]) == (told["median"], told["p95"])
    failed = sum(run.missions[0].status.value != "COMPLETED" for run in runs)
    assert of(forecast, "mission-one")["fails"] == failed / 9
    assert 0.0 < (forecast["lowest_battery"] or 0.0) < 1.0


def in_the_hall(folder: Path, level: float, out: Sequence[str] = ()) -> Forecast:
    """Forecast the missions of an example with light drones and lifters, all batteries at one level."""
    hall = example("warehouse_item_finder")
    asked = Question(
        app=moving(hall.app, hall.fleet.motion),
        fleet=hall.fleet,
        missions=hall.missions,
        present=present(hall.fleet, level, out),
        faults=Faults(),
        runs=3,
    )
    return answer(asked, folder)


def test_low_batteries_lengthen_it_and_it_says_what_waits_for_them(tmp_path: Path) -> None:
    full, low = (in_the_hall(tmp_path, level) for level in (1.0, 0.2))
    assert full["median"] is not None and low["median"] is not None
    assert low["median"] > full["median"]
    assert all(one["ready"] for one in full["drones"])
    assert not any(one["ready"] for one in low["drones"])
    first = low["bottlenecks"][0]
    assert first["text"].startswith(
        "6 missions wait: 5 drones are below 50 %, the first is ready in"
    )
    soonest = min(one["ready_in"] or 0.0 for one in low["drones"])
    assert first["facts"]["ready_in"] == pytest.approx(soonest)
    assert texts(full["bottlenecks"]) == [
        "2 missions wait, as no more than 4 drones may fly at once"
    ]


def test_where_nothing_charges_no_drone_is_said_to_be_ready_later(tmp_path: Path) -> None:
    fleet = replace(FLEET, charges_at_home=False)
    low = answer(question(*THREE, drones=SCOUTS, level=0.25, fleet=fleet), tmp_path)
    for one in low["drones"]:
        assert (one["ready"], one["ready_in"]) == (False, None)
        assert one["why"] is not None
        assert one["why"]["text"].endswith(" %, and nothing charges it")


def test_a_drone_that_is_lost_flies_nothing_and_the_others_take_longer(tmp_path: Path) -> None:
    both = answer(question(*THREE, drones=SCOUTS), tmp_path)
    alone = answer(question(*THREE, drones=SCOUTS, out=[SCOUTS[0].id]), tmp_path)
    assert both["median"] is not None and alone["median"] is not None
    assert alone["median"] > both["median"]
    lost, other = alone["drones"]
    assert (lost["ready"], lost["ready_in"], other["ready"]) == (False, None, True)
    assert texts([lost["why"]] if lost["why"] else []) == ["lost"]
    with pytest.raises(BadInput, match="no drone may fly"):
        answer(question(*THREE, drones=SCOUTS[:1], out=[SCOUTS[0].id]), tmp_path)


def test_it_names_the_drones_that_are_too_few(tmp_path: Path) -> None:
    forecast = in_the_hall(tmp_path, 1.0, ["lifter2"])
    (few,) = [one for one in forecast["bottlenecks"] if one["key"] == "preflight.few-lift"]
    assert few["text"] == "1 of 6 missions waits for the one drone that can lift 38 g"
    assert few["facts"]["drones"] == ["lifter1"]


def test_a_drone_that_can_do_none_of_the_missions_says_why(tmp_path: Path) -> None:
    forecast = answer(question(mission("mission-one", *handling("aa"))), tmp_path)
    cannot = [one["why"]["text"] for one in forecast["drones"] if one["why"] is not None]
    assert cannot == ["scout cannot pick_item"] * 2


@pytest.mark.parametrize("is_judged", [True, False])
def test_who_can_only_do_what_an_evaluator_sends_for_is_ready_if_there_is_one(
    is_judged: bool, tmp_path: Path
) -> None:
    """It says that it can do none of the missions all the same; a low battery still counts."""
    asked = question(mission("mission-one", *handling("aa")))
    asked = replace(
        asked, app=replace(asked.app, evaluators={"find_blooms": len} if is_judged else {})
    )
    scouts = [one for one in answer(asked, tmp_path)["drones"] if one["why"] is not None]
    assert [one["ready"] for one in scouts] == [is_judged] * 2
    low = replace(asked, present=present(asked.fleet, 0.1))
    assert not any(one["ready"] for one in answer(low, tmp_path)["drones"])


def test_what_repeats_for_ever_has_no_end_and_says_so(tmp_path: Path) -> None:
    forecast = answer(question(mission("mission-one", trip(), repeat=True), runs=1), tmp_path)
    assert (forecast["median"], forecast["high"]) == (None, None)
    assert of(forecast, "mission-one")["fails"] == 0.0
    assert texts(forecast["assumed"]) == [
        "some missions repeat until they are stopped: they are flown for 2 h"
    ]


def test_without_a_number_there_are_runs_enough_for_percentiles_and_one_is_in_the_middle(
    tmp_path: Path,
) -> None:
    forecast = answer(question(photos("mission-one", 1), runs=None), tmp_path)
    assert forecast["runs"] >= 21
    assert forecast["runs"] % 2 == 1


def test_a_rehearsal_ends_at_the_median_with_every_mission_done(tmp_path: Path) -> None:
    forecast = answer(question(*THREE), tmp_path / "station")
    assert forecast["rehearsal"] is not None
    assert forecast["rehearsal"].startswith("rehearsal-")
    config = StationConfig(folder=tmp_path, fleet=FLEET, faults={})
    past = PastFlights(APP, config)
    first: Any = past.replay(forecast["rehearsal"], 0.0)
    frames, log = frames_of(past, forecast["rehearsal"]), first["log"]
    assert forecast["median"] is not None
    ends = [line["time"] for line in log if line["text"] == "COMPLETED"]
    assert len(ends) == 3
    assert max(ends) == round(forecast["median"], 6)
    assert first["seconds"] >= forecast["median"]
    missions = {row["name"]: row for frame in frames for row in frame["missions"]}
    assert {row["status"] for row in missions.values()} == {"COMPLETED"}
    rows = [row for frame in frames for row in frame["drones"]]
    assert len({(row["x"], row["y"]) for row in rows}) > len(log) + 10  # also between two events
    assert min(row["battery"] for row in rows) < 1.0


def test_only_the_newest_are_kept_and_none_of_what_was_given_up(tmp_path: Path) -> None:
    made = [
        answer(question(photos("mission-one", 1), runs=1), tmp_path)["rehearsal"]
        for _ in range(KEPT + 2)
    ]
    there = {path.stem for path in (tmp_path / "rehearsals").iterdir()}
    assert there == set(made[-KEPT:])


def test_a_rehearsal_that_cannot_be_written_takes_nothing_from_the_forecast(tmp_path: Path) -> None:
    (tmp_path / "rehearsals").write_text("no folder")
    forecast = answer(question(photos("mission-one", 1)), tmp_path)
    assert forecast["rehearsal"] is None
    assert forecast["median"] is not None
    assert [one["key"] for one in forecast["assumed"]] == ["preflight.no-rehearsal"]
