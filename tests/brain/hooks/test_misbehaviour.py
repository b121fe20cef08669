"""Hooks that misbehave in every way: their mission fails with a reason, and nothing else stops."""

from __future__ import annotations

import asyncio
import signal
from collections.abc import Callable
from contextlib import suppress
from math import inf, nan
from typing import Any

import pytest

from pluto_fleet.process.signal_guard import Interrupted, interrupted_by_a_person
from pluto_fleet.shared.domain.errors import ActionFailed, Cancelled
from pluto_fleet.shared.domain.model import Mission
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.hooks.context import Context
from tests.kit import apps

Hook = Callable[..., object]


def reason_of(hook: Hook, *, watch: apps.Way | None = None) -> str:
    """Why the mission with this modifier fails; another mission must not notice."""

    def prepare(mission: Mission[apps.Trip], context: Context) -> object:
        return hook(mission, context) if mission.name == "bad" else None

    outcome = apps.fly(
        apps.app(apps.flow(watch=watch) if watch else apps.flow(prepare=prepare)),
        apps.mission("bad", apps.trip("A", 3.0)),
        apps.mission("good", apps.trip("A", 9.0)),
        on=apps.TWO,
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


class Unreadable(list[int]):
    """A list that does not say how long it is."""

    def __len__(self) -> int:
        raise ValueError("no")


@pytest.mark.parametrize(
    ("hook", "says"),
    [
        (lambda mission, _: mission.trips.clear(), "no trip is left to fly"),
        (
            lambda mission, _: setattr(mission, "trips", None),
            "mission.trips must be a list of trips, not NoneType",
        ),
        (lambda mission, _: mission.trips.append("B"), "it must be a Trip of this app, not str"),
        (lambda mission, _: mission.trips.extend([*mission.trips]), "it is in the list twice"),
        (lambda mission, _: setattr(mission.current, "action", "dance"), "no action 'dance'"),
        (lambda mission, _: setattr(mission.current, "target", (99.0, 1.0)), "is outside the map"),
        (
            lambda mission, _: setattr(mission.current, "target", (nan, 1.0)),
            "its target must be (x, y) or (x, y, z) in metres",
        ),
        (lambda mission, _: setattr(mission, "name", "x"), "mission.name is set by the app alone"),
        (lambda mission, _: setattr(mission, "index", 7), "mission.index is set by the app alone"),
        (
            lambda mission, _: setattr(mission.current, "target", Unreadable([1, 2])),
            "cannot be read",
        ),
        (lambda mission, _: Status.FAILED, "declares no `emits` and so must return nothing"),
        (lambda _, context: context.sleep(inf), "inf seconds is no time to wait for"),
        (lambda _, context: context.sleep(nan), "nan seconds is no time to wait for"),
    ],
)
def test_a_modifier_that_leaves_nonsense_is_told_so(hook: Hook, says: str) -> None:
    assert says in reason_of(hook)


def test_a_modifier_that_takes_away_the_trip_in_flight_fails_its_mission() -> None:
    async def at_once(mission: Any, context: Context) -> None:
        if mission.name == "good":
            await context.sleep(1000)
        mission.trips.clear()

    says = "took trip A, which is flying, from its place"
    assert says in reason_of(at_once, watch=apps.modified(at_once))


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


@pytest.mark.parametrize("fact", ["name", "action", "item", "index", "attempt", "status"])
def test_an_action_that_changes_what_its_trip_is_known_by_fails_its_mission(fact: str) -> None:
    act = OwnAction(name="act", hook=lambda drone, trip, context: setattr(trip, fact, "x"))
    outcome = apps.flown(apps.mission("m", apps.trip("A", 2.0, action="act")), actions=[act])
    (mission,) = outcome.missions
    assert mission.reason.startswith(f"hook <lambda> raised AttributeError: trip.{fact} ")
    assert mission.trips[0].name == "A"


def test_an_error_is_logged_with_its_place_whatever_it_was_made_of() -> None:
    def fails(mission: Any, context: Context) -> None:
        raise ValueError([1])

    outcome = apps.flown(apps.mission("m", apps.trip("A", 2.0)), prepare=fails)
    assert outcome.missions[0].reason == "hook fails raised ValueError: [1]"
    assert outcome.log[0].startswith("Traceback") and "ValueError: [1]" in outcome.log[0]
    assert "raise ValueError([1])" in outcome.log[0]


def test_a_hook_sees_what_all_actions_gave_and_that_a_trip_has_ended() -> None:
    seen: list[object] = []

    async def looks(mission: Any, context: Context) -> None:
        ended = [await context.trip_ended(trip) for trip in mission.completed_trips]
        seen.append((len(context.results), ended, await context.trip_ended(mission.current)))

    mission = apps.mission("m", apps.trip("A", 2.0), apps.trip("B", 3.0))
    assert apps.flown(mission, prepare=looks).completed
    assert seen == [(0, [], False), (1, [True], False)]


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
