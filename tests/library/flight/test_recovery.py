"""What is left of missions when the app stops or dies, and how they go on."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from typing import Any

import pytest

from pluto_fleet.jobs.reports import Down
from pluto_fleet.shared.domain.model import Drone, Results, Trip
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.flow.run import Run
from pluto_fleet.shared.hooks.context import Context, Verdict
from plutoc_blocks.mission_creator.step import create_mission
from tests.kit import apps
from tests.kit.living import Living, enterable, names
from tests.library.flight.test_kept_events import app as app_of_events

HOMES = ((0.5, 0.5, 0.0), (1.5, 0.5, 0.0))


def deliveries() -> list[apps.Mission]:
    return [
        apps.mission(
            "a",
            apps.trip("1", 3, delay=5.0),
            apps.pick("p", 4),
            apps.release("r", 6),
            apps.trip("4", 2),
        ),
        apps.mission("b", apps.trip("1", 5), apps.pick("p", 2), apps.release("r", 3)),
        apps.mission("c", apps.trip("1", 5, delay=20.0, priority=2), apps.trip("2", 5, delay=3.0)),
    ]


def delivering() -> Living:
    return Living(enterable(clock=True, attempts=3), *deliveries(), on=apps.fleet(*HOMES))


MOMENTS = [moment / 2 for moment in range(1, 180, 9)]


@pytest.mark.parametrize(
    ("moment", "how"),
    [
        *((moment, None) for moment in MOMENTS),
        *((moment, how) for moment in MOMENTS[::3] for how in Down),
    ],
)
def test_the_app_may_die_and_everything_may_be_stopped_at_any_moment(
    moment: float, how: Down | None
) -> None:
    living = delivering()
    if how is None:
        living.crash(moment)
    else:
        living.stop(moment, how, rest=1000.0)
    assert set(living.run()) == {"COMPLETED"}
    done = [act for act in living.done_by_drones if act[1]]
    assert sorted(done) == [("pick_item", "pills")] * 2 + [("release_item", "pills")] * 2
    assert set(names(living.named("trip.launched"), "attempt")) == {1}


def test_a_delay_keeps_its_rest_through_a_stop_and_passes_through_a_crash() -> None:
    mission = apps.mission("a", apps.trip("1", 3, delay=60.0))
    stopped = Living(enterable(clock=True), mission)
    stopped.stop(20.0, rest=100.0)
    stopped.run()
    assert stopped.times("trip.launched") == [pytest.approx(160.0)]
    died = Living(enterable(clock=True), apps.mission("a", apps.trip("1", 3, delay=60.0)))
    died.crash(20.0, down=10.0)
    died.run()
    assert died.times("trip.launched") == [60.0]


async def _slow_judge(mission: apps.Mission, results: Results[apps.Mission, Trip]) -> Verdict:
    return Verdict(log=(f"{len(results.new)} new of {len(results.all)}",))


def test_results_and_what_was_judged_of_them_survive() -> None:
    app = enterable(evaluator=_slow_judge, repeater=True)
    mission = apps.mission("a", apps.trip("1", 3), apps.trip("2", 4), repeat=1)
    living = Living(app, mission)
    living.crash(48.0)
    assert living.run() == ["COMPLETED"]
    assert names(living.named("log"), "text") == ["2 new of 2", "2 new of 4"]


def test_what_a_hook_did_to_its_mission_is_remembered() -> None:
    def shorten(mission: apps.Mission, context: Context) -> None:
        if len(mission.trips) == 3:
            del mission.trips[1]

    mission = apps.mission("a", apps.trip("1", 3), apps.trip("2", 4), apps.trip("3", 5))
    living = Living(enterable(prepare=shorten), mission)
    living.crash(3.0)
    assert living.run() == ["COMPLETED"]
    assert names(living.named("trip.completed"), "trip") == ["1", "3"]


def test_a_brain_that_dies_while_a_hook_runs_leaves_nothing_that_it_has_half_written() -> None:
    """A target without a height gets one once the hook has ended: as it is written, no journal has it."""

    async def lead_on(mission: apps.Mission, context: Context) -> None:
        target: Any = (3.0, 3.0)
        mission.trips[0].target = target
        await context.sleep(5.0)

    living = Living(enterable(prepare=lead_on), apps.mission("a", apps.trip("1", 9)))
    living.crash(2.0)
    living.run(2.5)
    assert living.memory.standing().missions["a"]["todo"][0]["target"] == [9.0, 0.5, 1.2]
    assert living.run() == ["COMPLETED"]


def test_a_mission_of_an_event_goes_on_that_has_met_no_allocator_yet() -> None:
    made = app_of_events()
    flow = made.flow

    async def after_a_while(run: Run[Any]) -> Status:
        if run.at == "pursue":
            create_mission(run, run.status)
            await run.core.kernel.sleep(5.0, key=run.key)
        return await flow(run)

    slow = apps.changed(made, flow=after_a_while)
    living = Living(slow, apps.mission("a", apps.trip("1", 9)), on=apps.fleet(*HOMES))
    living.at(1.0, lambda: living.life.control.raise_event("intruder", {"at": [4.0, 2.0]}))
    living.at(2.0, lambda: None)  # by then it is written down
    living.crash(3.0)
    assert living.run() == ["COMPLETED", "COMPLETED"]


def test_a_mission_whose_block_is_gone_is_held_and_goes_on_when_told() -> None:
    living = delivering()
    changed = replace(living.app, resumes=("allocate",))
    living.crash(10.0, app=changed)
    living.run(20.0)
    held = {m.name: m.reason for m in living.life.missions if m.status is Status.HELD}
    assert held == {"c": "it stopped at block wait, which the app has no more as a place to go on"}
    living.at(21.0, lambda: living.life.control.decide("c", "go-on"))
    assert set(living.run()) == {"COMPLETED"}


def test_a_mission_whose_action_is_gone_is_held_and_can_only_be_cancelled() -> None:
    async def spray(drone: Drone, trip: Trip, context: Context) -> None:
        await context.sleep(1.0)

    app = enterable(actions=(OwnAction(name="spray", hook=spray),))
    living = Living(app, apps.mission("a", apps.trip("1", 3), apps.trip("2", 3, action="spray")))
    living.crash(3.0, app=enterable())
    assert living.run() == ["HELD"]
    (mission,) = living.life.missions
    assert "needs the action spray, which the app has no more" in mission.reason
    living.decide_at_rest("a", "go-on")
    assert living.run() == ["HELD"]
    living.decide_at_rest("a", "cancel")
    assert living.run() == ["CANCELLED"]


def test_the_rows_of_a_journal_are_what_its_brain_says() -> None:
    living = delivering()
    living.crash(30.0)
    living.run()
    written = living.memory.standing().data
    assert written == json.loads(json.dumps(living.life.recorder.standing.data))
    brain = json.loads(json.dumps(living.life.brain.standing()))
    assert written["missions"] == brain["missions"]
    assert written["results"] == brain["results"]


@pytest.mark.parametrize(
    ("seen", "end", "flights"),
    [
        (True, "COMPLETED", 1),
        (False, "COMPLETED", 2),
        (None, "UNCERTAIN", 1),
        ("x", "UNCERTAIN", 1),
    ],
)
def test_the_apps_own_probe_may_know_what_nothing_else_does(
    seen: object, end: str, flights: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    spray = OwnAction(name="spray", hook=_spray)
    monkeypatch.setattr(
        sys.modules[__name__], "spray_done", lambda drone, trip: seen, raising=False
    )
    app = enterable(actions=(spray,))
    living = Living(app, apps.mission("a", apps.trip("1", 3, action="spray")))
    living.crash(10.0)
    assert living.run() == [end]
    assert len(living.named("trip.launched")) == flights


async def _spray(drone: Drone, trip: Trip, context: Context) -> None:
    await context.sleep(10.0)


@pytest.mark.parametrize(("answer", "then"), [("done", "COMPLETED"), ("cancel", "FAILED")])
def test_a_mission_that_comes_after_an_uncertain_one_does_not_keep_the_run_alive(
    answer: str, then: str
) -> None:
    """Nothing can happen until a person has decided, so it ends, and goes on with that."""
    app = enterable(clock=True, actions=(OwnAction(name="spray", hook=_spray),))
    a = apps.mission("a", apps.trip("1", 3, action="spray", delay=1.0))
    b = apps.mission("b", apps.trip("1", 3), promises={"after": ["a"]})
    c = apps.mission("c", apps.trip("1", 3), promises={"after": ["a", "b"]})
    living = Living(app, a, b, c)
    living.crash(12.0)
    assert living.run() == ["UNCERTAIN", "UNEXECUTED", "UNEXECUTED"]
    living.decide_at_rest("a", answer)
    assert living.run()[1:] == [then, then]


def test_a_probe_that_fails_leaves_it_to_a_person(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(drone: Drone, trip: Trip) -> bool:
        raise OSError("no camera")

    monkeypatch.setattr(sys.modules[__name__], "spray_done", broken, raising=False)
    app = enterable(actions=(OwnAction(name="spray", hook=_spray),))
    living = Living(app, apps.mission("a", apps.trip("1", 3, action="spray")))
    living.crash(10.0)
    assert living.run() == ["UNCERTAIN"]
    assert "OSError: no camera" in str(living.named("log")[-1]["text"])


def test_a_flight_goes_on_though_its_mission_can_only_go_on_at_its_clock() -> None:
    """What it waited for is over, and its trip is in the air."""
    app = apps.changed(enterable(clock=True), resumes=("wait",))
    living = Living(app, apps.mission("a", apps.trip("1", 9, delay=2.0)))
    living.crash(8.0)
    assert living.run() == ["COMPLETED"]
    assert living.times("trip.launched") == [2.0]
