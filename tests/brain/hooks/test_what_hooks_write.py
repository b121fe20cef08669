"""What hooks write is taken over whole or not at all, and what is the runtime's they cannot write."""

from __future__ import annotations

import asyncio
import json
import threading
from collections.abc import Callable
from contextvars import copy_context
from threading import Timer
from typing import Any

import pytest

from pluto_fleet.shared.domain.airspace import Airspace
from pluto_fleet.shared.domain.model import AfterTrip, Category, Item
from pluto_fleet.shared.domain.status import Status, TripStatus
from pluto_fleet.shared.fleet.own_policy import own_policy
from pluto_fleet.shared.flow.own_action import OwnAction
from pluto_fleet.shared.hooks.context import Verdict
from pluto_fleet.shared.hooks.soundness import MOST_TRIPS
from tests.kit import apps, in_real_time
from tests.kit.living import Living, enterable

Write = Callable[[Any], object]


def setting(of: str, fact: str, value: object) -> Write:
    """Return what writes an attribute of a mission, or of its trip or drone."""

    def write(mission: Any) -> None:
        here = {
            "mission": mission,
            "trip": mission.current,
            "done": (*mission.completed_trips, 0)[0],
        }
        setattr(here[of], fact, value)

    return write


def deleting(of: str, fact: str) -> Write:
    """Return what deletes one."""
    return lambda mission: delattr(mission if of == "mission" else mission.current, fact)


WRITES: dict[str, Write] = {
    "mission.name": setting("mission", "name", "zzz"),
    "mission.promises": setting("mission", "promises", 3),
    "mission.completed_trips": setting("mission", "completed_trips", []),
    "mission.status": setting("mission", "status", Status.COMPLETED),
    "trip.name": setting("trip", "name", "zzz"),
    "trip.attempt": setting("trip", "attempt", -5),
    "trip.status": setting("trip", "status", TripStatus.WAITING),
    "mission.trips cannot be deleted": deleting("mission", "trips"),
    "mission.completed_trips cannot be deleted": deleting("mission", "completed_trips"),
    "trip.status cannot be deleted": deleting("trip", "status"),
}


def ends(write: Write, who: str) -> str:
    """Fly a mission in which a hook of this kind writes, and go on after a crash; return its reason."""
    asked: list[Any] = []

    def bad(of: Any) -> None:
        if of.name.startswith("bad"):
            write(asked[-1])

    def modifier(mission: Any, context: Any) -> None:
        if mission.name == "bad":
            asked.append(mission)
        if who == "modifier":
            bad(mission)

    def evaluator(mission: Any, results: Any) -> Verdict:
        if who == "evaluator":
            bad(mission)
        return Verdict()

    def policy(trip: Any, candidates: Any) -> Any:
        if who == "policy":
            bad(trip)
        return candidates[0]

    def act(drone: Any, trip: Any, context: Any) -> None:
        if who == "action":
            bad(trip)

    tested = enterable(
        prepare=modifier,
        evaluator=evaluator,
        policy=own_policy(policy),
        actions=[OwnAction(name="act", hook=act)],
    )
    bad_one = apps.mission("bad", apps.trip("bad", 3.0, action="act"))
    living = Living(tested, bad_one, apps.mission("good", apps.trip("A", 15.0)), on=apps.TWO)
    living.crash(20.0)
    living.run()
    failed, good = living.life.missions
    assert (failed.status, good.status) == (Status.FAILED, Status.COMPLETED)
    return failed.reason


@pytest.mark.parametrize("who", ["modifier", "evaluator", "policy", "action"])
@pytest.mark.parametrize("what", WRITES)
def test_what_the_runtime_keeps_no_hook_can_write(what: str, who: str) -> None:
    """It raises there, and says what it is; the mission fails, and another brain goes on as well."""
    reason = ends(WRITES[what], who)
    assert f"raised AttributeError: {what} " in f"{reason} "


@pytest.mark.parametrize("who", ["evaluator", "policy", "action"])
@pytest.mark.parametrize(
    ("what", "write"),
    [
        ("trip.action", setting("trip", "action", "look")),
        ("trip.target", setting("trip", "target", None)),
        ("trip.item", setting("trip", "item", 3)),
        ("mission.trips", lambda mission: mission.trips.clear()),
        ("mission.trips", lambda mission: mission.trips.append(mission.current)),
        ("trip.reset()", lambda mission: mission.current.reset()),
    ],
)
def test_trips_are_for_modifiers_alone(what: str, write: Write, who: str) -> None:
    reason = ends(write, who)
    assert f": {what} can" in reason or "cannot be reset" in reason


def test_what_an_evaluator_writes_into_a_completed_trip_is_refused() -> None:
    reason = ends(
        lambda mission: setattr(mission.completed_trips[0], "action", "look"), "evaluator"
    )
    assert reason.startswith("hook evaluator raised AttributeError: trip.action cannot be set here")


@pytest.mark.parametrize("fact", ["category", "status", "id", "trips", "home", "telemetry"])
def test_of_a_drone_nothing_can_be_written(fact: str) -> None:
    def policy(trip: Any, candidates: Any) -> Any:
        (delattr if fact == "category" else setattr)(
            candidates[0], fact, *["q"][fact == "category" :]
        )

    for hook in (policy, lambda trip, candidates: setattr(candidates[0], fact, None)):
        outcome = apps.flown(apps.mission("m", apps.trip("A", 3.0)), policy=own_policy(hook))
        assert f"raised AttributeError: drone.{fact} " in outcome.missions[0].reason


@pytest.mark.parametrize("parameters", ["trip", "promises"])
def test_mappings_can_only_be_read(parameters: str) -> None:
    def policy(trip: Any, candidates: Any) -> Any:
        trip.parameters["quantity"] = 3

    mission = apps.mission("m", apps.trip("A", 3.0, action="measure"))
    outcome = apps.flown(mission, policy=own_policy(policy))
    assert "raised TypeError" in outcome.missions[0].reason


# Modifiers


def modified(write: Write, *trips: apps.Trip, **more: Any) -> Any:
    """Simulate a mission before whose trips a modifier writes."""
    return apps.flown(
        apps.mission("m", *(trips or (apps.trip("A", 3.0), apps.trip("B", 4.0)))),
        prepare=lambda mission, context: write(mission),
        **more,
    )


def test_what_a_modifier_leaves_of_a_trip_is_taken_over_whole_or_not_at_all() -> None:
    def write(mission: Any) -> None:
        mission.current.target = (5, 5)
        mission.trips.insert(0, apps.trip("new", 2.0))
        mission.trips[2].action = "dance"

    mission = modified(write).missions[0]
    assert mission.reason.endswith(
        "left a trip that cannot be flown: trip B: there is no action 'dance'"
    )
    assert [(one.name, one.target[0], one.action) for one in mission.trips] == [
        ("A", 3.0, "take_photo"),
        ("B", 4.0, "take_photo"),
    ]


@pytest.mark.parametrize(
    ("write", "says"),
    [
        (setting("trip", "action", "pick_item"), "pick_item needs an item"),
        (setting("trip", "item", Item(name="x", mass=1.0)), "take_photo takes no item"),
        (setting("trip", "item", 3), "take_photo takes no item"),
        (setting("trip", "parameters", {"x": 1}), "there may be: none"),
        (lambda m: m.trips.append(apps.trip("", 2.0)), "its name must be a text of 1 to 200"),
        (lambda m: m.trips.extend(m.completed_trips), "trip A is COMPLETED"),
        (
            lambda m: m.completed_trips[0].reset() if m.completed_trips else None,
            "an evaluator can have it",
        ),
    ],
)
def test_what_cannot_be_flown_is_told(write: Write, says: str) -> None:
    assert says in modified(write).missions[0].reason


def test_a_trip_in_flight_cannot_be_changed() -> None:
    watch = apps.modified(lambda mission, context: setattr(mission.current, "target", (5, 5)))
    (mission,) = apps.flown(apps.mission("m", apps.trip("A", 3.0)), watch=watch).missions
    assert "trip.target cannot be set: trip A is in flight" in mission.reason


def test_new_trips_have_names_of_their_own_over_a_restart() -> None:
    """Even of trips that were taken away: a flight is known by the name of its trip."""

    def write(mission: Any, context: Any) -> None:
        if mission.attempts < 4:
            mission.trips[:] = [apps.trip("A", 2.0 + mission.attempts), apps.trip("A", 4.0)]

    living = Living(enterable(prepare=write), apps.mission("m", apps.trip("A", 3.0)))
    living.crash(12.0)
    assert living.run() == ["COMPLETED"]
    flights = [(one["trip"], one["attempt"]) for one in living.named("trip.launched")]
    ended = {*flights} - {(one["trip"], 1) for one in living.named("trip.interrupted")}
    assert len(ended) == len(living.named("trip.completed")) == 5
    assert all(str(name).startswith("A") for name, _ in ended)


def test_changes_are_recorded_as_changes() -> None:
    """A trace grows with them, and not with their square; and a mission's trips have a bound."""
    sizes = []
    for most in (100, 200):

        def write(mission: Any, most: int = most) -> None:
            if mission.attempts < most:
                mission.trips.insert(0, apps.trip("more", 2.0))

        outcome = modified(write, on=apps.fleet(after=AfterTrip.STAY), until=1e6)
        assert outcome.completed
        assert len(apps.events(outcome, "mission.changed")) == most
        sizes.append(len(json.dumps(apps.events(outcome, "mission.changed"))))
    assert sizes[1] < 2.2 * sizes[0]


def test_a_missions_trips_are_bounded() -> None:
    def write(mission: Any) -> None:
        mission.trips += [apps.trip("more", 2.0) for _ in range(MOST_TRIPS)]

    reason = modified(write).missions[0].reason
    assert reason.endswith(
        "the mission has had 10,000 trips in this round, and no hook may add more"
    )


def test_what_a_modifier_has_changed_when_it_is_called_off_counts() -> None:
    async def write(mission: Any, context: Any) -> None:
        if len(mission.trips) == 3:
            mission.trips[1].target = (2, 2)
        else:
            mission.trips.append("B")
        await context.sleep(1_000)

    trips = [apps.trip(name, 3.0) for name in "ABC"]
    (mission,) = apps.flown(apps.mission("m", *trips), watch=apps.modified(write)).missions
    assert [one.target[:2] for one in mission.completed_trips] == [(3.0, 0.5), (2.0, 2.0)]
    assert mission.reason.endswith("it must be a Trip of this app, not str")


@pytest.mark.parametrize("changes", [True, False])
def test_an_error_of_ours_in_a_mission_that_hooks_have_changed_ends_that_mission_alone(
    changes: bool,
) -> None:
    """Who is to blame cannot be told then; in one that no hook has changed it is a bug of ours."""

    def prepare(mission: Any, context: Any) -> None:
        if changes:
            mission.current.target = (5, 5)

    async def fails(run: Any, status: Any) -> Any:
        raise KeyError(run.mission.name)

    def fly() -> list[Any]:
        missions = (apps.mission(name, apps.trip("A", 3.0)) for name in ("one", "two"))
        tested = apps.app(apps.flow(prepare=prepare, watch=fails))
        return list(apps.fly(tested, *missions, on=apps.TWO).missions)

    if not changes:
        with pytest.raises(KeyError):
            fly()
        return
    assert [mission.reason for mission in fly()] == [
        f"by a bug of Pluto, or of a hook that has changed the mission: KeyError: {name!r}"
        for name in ("one", "two")
    ]


def test_a_hook_writes_nothing_of_a_mission_whose_own_hook_waits() -> None:
    ended = apps.flown(*two_missions(), prepare=waits_and_writes()).missions
    assert [mission.status for mission in ended] == [Status.COMPLETED, Status.FAILED]
    assert "mission.trips cannot be changed here" in ended[1].reason
    assert [trip.name for trip in ended[0].completed_trips] == ["A", "B"]


def two_missions() -> list[apps.Mission]:
    """Return one whose modifier waits and writes its own, and one whose modifier writes the other's."""
    pairs = [apps.trip("A", 3.0), apps.trip("B", 3.0)], [apps.trip("A", 2.0)]
    return [apps.mission(name, *trips) for name, trips in zip(("one", "two"), pairs, strict=True)]


def waits_and_writes() -> Callable[..., Any]:
    """Return their modifier."""
    first: list[Any] = []

    async def modifier(mission: Any, context: Any) -> None:
        if mission.name == "one":
            first.append(mission)
            await context.sleep(2.0)
            mission.trips[-1].target = (2.0, 2.0)
        else:
            await context.sleep(1.0)
            first[0].trips.clear()

    return modifier


@pytest.mark.parametrize("how", ["in its task", "in a task of its own", "in a thread"])
def test_in_real_time_a_hook_writes_wherever_it_runs_and_no_more_when_it_has_ended(
    how: str,
) -> None:
    late: list[str] = []
    written = threading.Event()

    def write(mission: Any) -> None:
        mission.trips[-1].target = (1.5, 1.5, 0.003)

    def write_late(mission: Any) -> None:
        with pytest.raises(AttributeError) as refused:
            write(mission)
        late.append(str(refused.value))
        written.set()

    async def writes(mission: Any) -> None:
        await asyncio.sleep(0)
        write(mission)

    async def task(mission: Any, context: Any) -> None:
        await writes(mission)
        asyncio.get_running_loop().call_later(0.01, write_late, mission)

    async def own_task(mission: Any, context: Any) -> None:
        await asyncio.create_task(writes(mission))
        asyncio.get_running_loop().call_later(0.01, write_late, mission)

    def thread(mission: Any, context: Any) -> None:
        write(mission)
        inside = copy_context()
        Timer(0.5, inside.run, [write_late, mission]).start()  # by then it has ended for all

    async def long(drone: Any, trip: Any, context: Any) -> None:
        while not written.is_set():
            await asyncio.sleep(0.01)

    hook = {"in its task": task, "in a task of its own": own_task, "in a thread": thread}[how]
    tested = apps.app(
        apps.flow(prepare=hook),
        categories=[Category(name="scout", speed=200.0)],
        actions=[OwnAction(name="act", hook=long, takes=0.01)],
    )
    fleet = apps.fleet(airspace=Airspace(cruise_height=0.003))
    mission = apps.mission(
        "m", apps.Trip(name="A", action="act", target=(0.5, 0.5, 0.003)), index=0
    )
    in_real_time.fly(tested, [mission], fleet, id)
    assert (mission.reason, mission.completed_trips[0].target) == ("", (1.5, 1.5, 0.003))
    assert late[0].startswith("trip.target cannot be set")
