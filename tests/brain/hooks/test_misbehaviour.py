"""Hooks that misbehave in every way: their mission fails with a reason, and nothing else stops."""

from __future__ import annotations

import asyncio
import signal
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import pytest

from pluto_fleet.process.signal_guard import Interrupted, interrupted_by_a_person
from pluto_fleet.shared.domain.errors import ActionFailed, Cancelled
from pluto_fleet.shared.domain.model import Mission
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.flow import asking
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.flow.run import Run
from pluto_fleet.shared.hooks.context import Context, Verdict
from plutoc_blocks.gate_funnel.step import wait_for_all
from plutoc_blocks.mission_creator.step import create_mission
from plutoc_blocks.mission_evaluator.step import evaluate_mission
from plutoc_blocks.mission_modifier.step import modify_mission
from plutoc_blocks.priority_manager.step import raise_priority
from tests.kit import apps

Hook = Callable[..., object]
ANY_END = (Status.STANDBY, Status.COMPLETED, Status.FAILED)


def reason_of(hook: Hook, *, watch: apps.Way | None = None) -> str:
    """Why the mission with this modifier fails; another mission must not notice."""

    def prepare(mission: Mission[apps.Trip], context: Context) -> object:
        return hook(mission, context) if mission.name == "bad" else None

    outcome = apps.fly(
        apps.app(apps.flow(watch=watch) if watch else apps.flow(prepare=prepare)),
        apps.mission("bad", apps.trip("A", 3.0)),
        apps.mission("good", apps.trip("A", 9.0)),
        on=apps.fleet((0.5, 0.5, 0.0), (1.5, 0.5, 0.0)),
    )
    bad, good = outcome.missions
    assert (bad.status, good.status) == (Status.FAILED, Status.COMPLETED)
    return bad.reason


class Speechless(Exception):
    """An error that cannot even say what it is."""

    def __str__(self) -> str:
        raise RuntimeError


@pytest.mark.parametrize(
    ("error", "says"),
    [
        (SystemExit(3), "raised SystemExit: 3"),
        (asyncio.CancelledError(), "raised CancelledError"),
        (Cancelled(), "may not raise Cancelled"),
        (GeneratorExit(), "may not raise GeneratorExit"),
        (StopIteration(), "raised StopIteration"),
        (ActionFailed("no grip"), "raised ActionFailed, which only an action may: no grip"),
        (Speechless(), "raised Speechless"),
    ],
)
def test_any_error_of_a_hook_is_its_missions_fault_alone(error: BaseException, says: str) -> None:
    def at_once(mission: Mission[apps.Trip], context: Context) -> None:
        raise error

    async def later(mission: Mission[apps.Trip], context: Context) -> None:
        await context.sleep(1)
        raise error

    async def never_waits(mission: Mission[apps.Trip], context: Context) -> None:
        raise error

    assert says in reason_of(at_once)
    assert says in reason_of(later)
    if not isinstance(error, StopIteration):  # of which Python itself makes a RuntimeError
        assert says in reason_of(never_waits)


def test_an_interrupt_that_a_hook_raises_is_not_a_persons() -> None:
    """Where the program itself hears Ctrl-C, it can tell one from the other."""

    def at_once(mission: Mission[apps.Trip], context: Context) -> None:
        raise KeyboardInterrupt

    async def later(mission: Mission[apps.Trip], context: Context) -> None:
        await context.sleep(1)
        raise KeyboardInterrupt

    def a_person(mission: Mission[apps.Trip], context: Context) -> None:
        signal.raise_signal(signal.SIGINT)

    with interrupted_by_a_person():
        assert "may not raise KeyboardInterrupt" in reason_of(at_once)
        assert "may not raise KeyboardInterrupt" in reason_of(later)
        with pytest.raises(Interrupted):
            reason_of(a_person)


def empties(mission: Any, context: Context) -> None:
    mission.trips.clear()


def takes_all(mission: Any, context: Context) -> None:
    mission.trips = None


def puts_text(mission: Any, context: Context) -> None:
    mission.trips.append("B")


def doubles(mission: Any, context: Context) -> None:
    mission.trips *= 2


def dances(mission: Any, context: Context) -> None:
    mission.current.action = "dance"


def leaves_the_map(mission: Any, context: Context) -> None:
    mission.current.target = (99.0, 1.0)


def goes_nowhere(mission: Any, context: Context) -> None:
    mission.current.target = (float("nan"), 1.0)


async def waits_for_ever(mission: Any, context: Context) -> None:
    await context.sleep(float("inf"))


async def waits_for_nothing(mission: Any, context: Context) -> None:
    await context.trip_ended(mission.current, within=float("nan"))
    await context.sleep(float("nan"))


@pytest.mark.parametrize(
    ("hook", "says"),
    [
        (empties, "no trip is left to fly"),
        (takes_all, "made mission.trips NoneType, not a list"),
        (puts_text, "it must be a Trip of this app, not str"),
        (doubles, "it is in the list twice"),
        (dances, "there is no action 'dance'"),
        (leaves_the_map, "is outside the map"),
        (goes_nowhere, "its target must be (x, y) or (x, y, z) in metres"),
        (waits_for_ever, "inf seconds is no time to wait for"),
        (waits_for_nothing, "nan seconds is no time to wait for"),
    ],
)
def test_a_modifier_that_leaves_nonsense_is_told_so(hook: Hook, says: str) -> None:
    assert says in reason_of(hook)


def test_a_modifier_may_name_a_place_without_a_height() -> None:
    def elsewhere(mission: Any, context: Context) -> None:
        mission.current.target = [4, 5]

    outcome = apps.fly(
        apps.app(apps.flow(prepare=elsewhere)), apps.mission("m", apps.trip("A", 3.0))
    )
    assert outcome.missions[0].completed_trips[0].target == (4, 5, 1.2)


def test_a_modifier_that_takes_away_the_trip_in_flight_fails_its_mission() -> None:
    async def at_once(mission: Any, context: Context) -> None:
        if mission.name == "good":
            await context.sleep(1000)
        empties(mission, context)

    async def and_waits(mission: Any, context: Context) -> None:
        if mission.name == "bad":
            empties(mission, context)
        await context.sleep(1000)

    says = "took trip A, which is flying, from its place"
    assert says in reason_of(at_once, watch=apps.modified(at_once))
    assert "a hook took it" in reason_of(and_waits, watch=apps.modified(and_waits))


def test_a_hook_that_is_called_off_cannot_hold_on_or_go_on() -> None:
    went_on: list[float] = []

    async def holds_on(mission: Any, context: Context) -> Status:
        try:
            await context.sleep(1000)
        finally:
            await context.sleep(10)
            went_on.append(context.now)
        return Status.FAILED

    async def goes_on(mission: Any, context: Context) -> Status:
        with suppress(BaseException):
            await context.sleep(1000)
        return Status.FAILED

    for hook in (holds_on, goes_on):
        tested = apps.app(apps.flow(watch=apps.modified(hook, Status.FAILED)))
        outcome = apps.fly(tested, apps.mission("m", apps.trip("A", 3.0), apps.trip("B", 9.0)))
        assert outcome.completed
        apps.fly(tested, apps.mission("m", apps.trip("A", 3.0)), until=5.0)
    assert went_on == []


def test_a_fault_in_one_branch_does_not_wait_for_the_others() -> None:
    async def faulty(mission: Any, context: Context) -> None:
        await context.sleep(1)
        raise ValueError("no")

    async def beside(run: Run[Any], status: Status) -> Status:
        return await modify_mission(run, status, hook=faulty)

    async def both(run: Run[Any], status: Status) -> Status:
        return await wait_for_all(run, status, apps.watched, beside)

    outcome = apps.fly(apps.app(apps.flow(watch=both)), apps.mission("m", apps.trip("A", 15.0)))
    assert outcome.missions[0].reason == "hook faulty raised ValueError: no"
    assert apps.times(outcome, "mission.ended") == [1.0]


def test_a_failure_before_the_launch_counts_as_no_attempt(monkeypatch: pytest.MonkeyPatch) -> None:
    """Only flights count; a modifier that fails every time is stopped by the number of its calls."""
    monkeypatch.setattr(asking, "MOST_CALLS", 10)
    asked: list[int] = []

    def never(mission: Any, context: Context) -> Status:
        asked.append(mission.current.attempt)
        return Status.FAILED

    async def flow(run: Run[Any]) -> Status:
        status = create_mission(run, Status.UNEXECUTED)
        while True:
            status = await modify_mission(run, status, hook=never, emits=(Status.FAILED,))
            status = raise_priority(run, status, max_attempts=3, priority=0)
            if status is Status.FAILED:
                return status

    (mission,) = apps.fly(apps.app(flow), apps.mission("m", apps.trip("A", 3.0))).missions
    assert mission.status is Status.FAILED
    assert "it goes round in its graph for ever" in mission.reason
    assert asked == [1] * 10


@pytest.mark.parametrize("max_attempts", [1, 3])
def test_a_failure_after_another_trips_end_is_charged_to_no_trip(max_attempts: int) -> None:
    """The hook fails the mission once, when A is over; B has not flown, and flies as attempt 1."""
    said: list[Status] = []

    def once(mission: Any, context: Context) -> Status:
        said.append(Status.FAILED if not said else mission.status)
        return said[-1]

    async def watch(run: Run[Any], status: Status) -> Status:
        status = await apps.watched(run, status)
        status = await modify_mission(run, status, hook=once, emits=ANY_END)
        if status is Status.FAILED:
            return raise_priority(run, status, max_attempts=max_attempts, priority=0)
        return status

    tested = apps.app(apps.flow(watch=watch))
    outcome = apps.fly(tested, apps.mission("m", apps.trip("A", 3.0), apps.trip("B", 5.0)))
    assert outcome.completed
    launched = apps.events(outcome, "trip.launched")
    assert [(event["trip"], event["attempt"]) for event in launched] == [("A", 1), ("B", 1)]


def test_a_trip_that_flew_and_failed_is_charged_once_though_hooks_say_otherwise_then() -> None:
    """It failed in flight, was put back, and a hook failed the mission again before it flew."""
    said: list[int] = []

    def twice(mission: Any, context: Context) -> Status:
        said.append(mission.current.attempt)
        return Status.FAILED

    async def watch(run: Run[Any], status: Status) -> Status:
        for _ in range(3):
            status = await modify_mission(run, status, hook=twice, emits=(Status.FAILED,))
            status = raise_priority(run, status, max_attempts=2, priority=0)
        return status

    tested = apps.app(apps.flow(watch=watch))
    outcome = apps.fly(tested, apps.mission("m", apps.trip("A", 3.0)))
    assert outcome.missions[0].status is Status.FAILED
    assert said == [1, 2, 2, 2, 2, 2]
    assert [event["attempt"] for event in apps.events(outcome, "trip.launched")] == [1, 2]


def test_nothing_is_put_back_where_no_trip_is_left() -> None:
    """A PriorityManager behind an evaluator's FAILED ends the mission, and says both reasons."""

    async def watch(run: Run[Any], status: Status) -> Status:
        status = await apps.watched(run, status)
        status = await evaluate_mission(
            run, status, hook=lambda mission, results: Verdict(fail="too dry"), evaluator=None
        )
        raise_priority(run, status, max_attempts=3, priority=0)
        raise AssertionError("it went on")

    outcome = apps.fly(apps.app(apps.flow(watch=watch)), apps.mission("m", apps.trip("A", 3.0)))
    (mission,) = outcome.missions
    assert mission.status is Status.FAILED
    assert mission.reason == "too dry; no trip is left to fly"


def verdict_of(verdict: Verdict) -> Mission[Any]:
    tested = apps.app(apps.flow(evaluator=lambda mission, results: verdict))
    return apps.fly(tested, apps.mission("m", apps.trip("A", 3.0))).missions[0]


NONSENSE: Any = None
ONE_TRIP: Any = apps.trip("B", 2.0)
A_LIST: Any = ([1],)
A_NUMBER: Any = 5
LINES: Any = "all is well"


@pytest.mark.parametrize(
    ("verdict", "says"),
    [
        (Verdict(add=ONE_TRIP), "must give `add` as a list or a tuple, not as Trip"),
        (Verdict(redo=NONSENSE), "must give `redo` as a list or a tuple, not as NoneType"),
        (Verdict(log=LINES), "must give `log` as a list or a tuple, not as str"),
        (Verdict(add=A_LIST), "it must be a Trip of this app, not list"),
        (Verdict(fail=A_NUMBER), "5"),
        (Verdict(fail=" "), "did not accept it"),
        (Verdict(add=(apps.trip("B", 2.0, parameters=NONSENSE),)), "parameters must be a dict"),
    ],
)
def test_a_verdict_that_makes_no_sense_fails_the_mission(verdict: Verdict, says: str) -> None:
    mission = verdict_of(verdict)
    assert mission.status is Status.FAILED
    assert says in mission.reason


def test_an_evaluator_does_not_change_the_trips_itself() -> None:
    def adds(mission: Any, results: Any) -> Verdict:
        mission.trips.append(apps.trip("B", 2.0))
        return Verdict()

    outcome = apps.fly(apps.app(apps.flow(evaluator=adds)), apps.mission("m", apps.trip("A", 3.0)))
    assert "that is what `add` is for" in outcome.missions[0].reason


def test_an_added_place_without_a_height_gets_the_maps() -> None:
    def adds(mission: Mission[apps.Trip], results: Any) -> Verdict:
        place: Any = (2, 3)
        more = apps.Trip(name="B", action="take_photo", target=place)
        return Verdict(add=() if len(mission.completed_trips) > 1 else (more,))

    outcome = apps.fly(apps.app(apps.flow(evaluator=adds)), apps.mission("m", apps.trip("A", 3.0)))
    assert outcome.missions[0].completed_trips[1].target == (2, 3, 1.2)


def test_one_trip_cannot_be_added_to_two_missions() -> None:
    extra = apps.trip("extra", 5.0)

    def adds(mission: Mission[apps.Trip], results: Any) -> Verdict:
        return Verdict(add=() if extra in mission.completed_trips else (extra,))

    first, second = apps.fly(
        apps.app(apps.flow(evaluator=adds)),
        apps.mission("first", apps.trip("A", 3.0)),
        apps.mission("second", apps.trip("A", 9.0)),
    ).missions
    assert first.status is Status.COMPLETED
    assert "extra has been used already: make a new Trip each time" in second.reason


class Thing:
    """Something whose `repr` tells where in memory it is."""


def test_what_an_action_gives_stands_in_the_trace_the_same_in_every_run() -> None:
    values = iter((Thing(), {"b", "a"}, [Thing()]))
    tested = apps.app(
        apps.flow(),
        actions=[OwnAction(name="look", hook=lambda drone, trip, context: next(values))],
    )
    trips = [apps.trip(name, 2.0, action="look") for name in "ABC"]
    outcome = apps.fly(tested, apps.mission("m", *trips))
    name = f"{Thing.__module__}.Thing"
    shown = [event["value"] for event in apps.events(outcome, "trip.completed")]
    assert shown == [f"<{name} object>", "{'a', 'b'}", f"[<{name} object>]"]
