"""Events: raised once, waited for, and made missions of."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

import pytest

from pluto_fleet.shared.brain import Brain
from pluto_fleet.shared.domain.actions import Parameter
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.quantities import Type
from pluto_fleet.shared.domain.status import Status
from pluto_fleet.shared.events.declared import Creator, Event, EventType
from pluto_fleet.shared.events.interruption import anything, own
from pluto_fleet.shared.events.raising import MOST, EventsOf
from pluto_fleet.shared.flow import asking
from pluto_fleet.shared.flow.run import Run
from plutoc_blocks.event_monitor.step import watch_event
from plutoc_blocks.gate_fifo.step import pass_first
from plutoc_blocks.gate_funnel.step import wait_for_all
from plutoc_blocks.mission_modifier.step import modify_mission
from plutoc_blocks.trip_monitor.step import watch_trip
from tests.brain.hand import charged, settled, trip
from tests.kit import apps


@dataclass(frozen=True, kw_only=True)
class Intruder(Event):
    """An event of the app's own."""

    kind: str = "person"


KIND = Parameter(name="kind", type=Type.TEXT, default="person")
INTRUDER = EventType(name="intruder", type=Intruder, fields=(KIND,))


def chase(event: Intruder, context: Any) -> apps.Mission | None:
    """Fly to where it was seen."""
    if event.kind == "cat":
        return None
    return apps.mission(f"chase {event.kind}", apps.trip("picture", event.at[0]))  # type: ignore[index]


def promising(**promises: object) -> Any:
    """Return a mission that promises this."""
    mission = apps.mission("m", apps.trip("t", 3.0))
    mission.promises = promises
    return mission


def app_with(
    hook: Callable[..., object] = chase, event: str = "intruder", of_any: bool = False
) -> Any:
    """Return an app whose missions are interrupted by an event, and made by one."""

    async def monitor(run: Run[Any], status: Status) -> Status:
        return await watch_event(run, status, event=event, of=anything if of_any else own)

    async def watch(run: Run[Any], status: Status) -> Status:
        return await pass_first(run, status, watch_trip, monitor)

    made = apps.app(apps.flow(watch=watch))
    parts = (EventsOf((INTRUDER,), (Creator(event="intruder", block="pursue", hook=hook),)),)
    given: Any = made.given
    return replace(given, parts=parts, resumes=("allocate",))


def raised(brain: Brain, now: float, **facts: Any) -> None:
    """Raise an event, and let come of it what comes at that instant."""
    brain.command({"command": "raise", "event": "intruder", **facts}, now)


def kinds(brain: Brain) -> list[str]:
    """Return what has happened."""
    return [str(event["event"]) for event in brain.events()]


def test_the_trace_says_which_event_it_was_whatever_its_fields_are_called() -> None:
    brain = charged(app=app_with())
    raised(brain, 1.0, at=[4.0, 2.0], fields={"kind": "dog"})
    (said,) = [event for event in brain.events() if event["event"] == "event.raised"]
    assert (said["kind"], said["fields"]) == ("intruder", {"kind": "dog"})


def test_an_event_makes_a_mission_that_flies() -> None:
    brain = charged(app=app_with())
    raised(brain, 1.0, at=[4.0, 2.0])
    orders = settled(brain, 1.0)
    assert [(order["do"], order["flight"]) for order in orders] == [
        ("fly", "chase person/picture/0/1")
    ]
    assert brain.mission("chase person")["status"] == "RUNNING"
    assert brain.standing()["happenings"]["intruder-1"]["made"] == ["chase person"]
    brain.tell({"done": orders[0]["id"]}, 9.0)
    settled(brain, 9.0)
    assert brain.mission("chase person")["status"] == "COMPLETED"


def test_a_flight_is_broken_off_once_the_mission_of_the_event_can_have_its_drone() -> None:
    """Else another that waits takes it, while the event is written to the disk."""
    brain = charged(app=app_with(), recorded=True)
    brain.begin([{"name": "patrol", "trips": [trip()]}], 0.0)
    brain.go_on({}, {"cf1": {"reached": True, "landed": True, "problems": []}}, 0.0)
    assert [order["do"] for order in settled(brain, 0.0)] == ["fly"]
    raised(brain, 3.0, mission="patrol", at=[4.0, 2.0])
    assert settled(brain, 3.0) == []
    brain.tell({"durable": 100}, 3.1)
    assert settled(brain, 3.1)[0]["do"] == "break_off"
    assert brain.standing()["happenings"]["intruder-1"]["made"] == ["chase person"]


def test_a_slow_disk_or_creator_keeps_no_flight_for_long() -> None:
    brain = charged(app=app_with(), recorded=True)
    brain.begin([{"name": "patrol", "trips": [trip()]}], 0.0)
    brain.go_on({}, {"cf1": {"reached": True, "landed": True, "problems": []}}, 0.0)
    settled(brain, 0.0)
    raised(brain, 3.0, mission="patrol", at=[4.0, 2.0])
    assert settled(brain, 10.0)[0]["do"] == "break_off"


def test_an_id_happens_once() -> None:
    brain = charged(drones=2, app=app_with())
    raised(brain, 1.0, id="door", at=[4.0, 2.0])
    raised(brain, 1.5, id="door", at=[4.0, 2.0])
    settled(brain, 2.0)
    assert len(brain.standing()["missions"]) == 1
    raised(brain, 3.0, id="window", at=[5.0, 2.0])
    settled(brain, 3.0)
    assert [*brain.standing()["missions"]] == ["chase person", "chase person 2"]


def test_a_creator_may_make_none() -> None:
    brain = charged(app=app_with())
    raised(brain, 1.0, at=[4.0, 2.0], fields={"kind": "cat"})
    settled(brain, 1.0)
    row = brain.standing()["happenings"]["intruder-1"]
    assert not brain.standing()["missions"]
    assert row["why"] == "pursue made no mission of it"
    assert brain.over == 1.0


def test_a_wrong_event_is_refused_with_what_is_wrong() -> None:
    brain = charged(app=app_with())
    for request, message in (
        ({"event": "fire"}, 'there is no event "fire"; there are: intruder, late, lost'),
        ({"fields": {"colour": "red"}}, 'event intruder: unknown key "colour"'),
        ({"at": [99.0, 2.0]}, "event intruder: at [99.0, 2.0] is outside"),
        ({"colour": "red"}, 'event intruder: unknown key "colour"'),
        ({"fields": {"kind": 3}}, "event intruder: kind 3 is not a text"),
        ({"mission": "another"}, 'event intruder: there is no mission "another"'),
        ({"drone": "cf9"}, 'event intruder: there is no drone "cf9"'),
        ({"event": "late"}, "late is raised by the app itself"),
    ):
        with pytest.raises(BadInput, match=f"^{re.escape(message)}"):
            brain.command({"command": "raise", "event": "intruder", **request}, 1.0)
    assert not brain.standing()["happenings"]


@pytest.mark.parametrize(
    ("made", "wrong"),
    [
        (lambda *_: 3, "it must be a Mission of this app or None, not int"),
        (lambda *_: apps.mission("m"), "mission m has no trips"),
        (
            lambda *_: apps.mission("m", apps.trip("far", 99.0)),
            "trip far: (99, 0.5) is outside the map",
        ),
        (lambda *_: apps.mission("m", apps.trip("t", 3.0, action="dance")), "trip t: there is no"),
        (lambda *_: apps.mission(" ", apps.trip("t", 3.0)), "its name must be a text"),
        (lambda *_: promising(deadline="5 s"), "its promise deadline must be seconds from now"),
        (lambda *_: promising(deadline=-1.0), "its promise deadline must be seconds from now"),
        (lambda *_: promising(deadlin=5.0), 'its promises have "deadlin"; there may be: deadline,'),
        (
            lambda *_: promising(after="patrol"),
            "its promise after must be a list of missions' names",
        ),
        (lambda *_: 1 / 0, "ZeroDivisionError"),
    ],
)
def test_what_a_creator_makes_is_checked(made: Callable[..., object], wrong: str) -> None:
    brain = charged(app=app_with(made))
    raised(brain, 1.0, at=[4.0, 2.0])
    settled(brain, 1.0)
    why = brain.standing()["happenings"]["intruder-1"]["why"]
    assert wrong in why, why
    assert not brain.standing()["missions"]


def test_what_is_the_runtimes_is_new_of_each_mission_that_a_creator_makes() -> None:
    """A hook may write all of one that is not the app's yet: a count that is none would end the app."""

    def two_alike(*_: object) -> Any:
        made: Any = apps.mission("m", apps.trip("t", 3.0), apps.trip("t", 4.0))
        made.attempts = "many"
        made.completed_trips = (made.trips[0],)
        made.trips[0].attempt = made.trips[0].number = 7
        return made

    brain = charged(app=app_with(two_alike))
    raised(brain, 1.0, at=[4.0, 2.0])
    (fly,) = settled(brain, 1.0)
    assert fly["flight"] == "m/t/0/1"
    row = brain.mission("m")
    assert (row["attempts"], row["done"]) == (1, [])
    assert [one["name"] for one in row["todo"]] == ["t", "t 2"]


def test_a_creator_cannot_give_away_the_trip_of_another_mission() -> None:
    def thief(_: Event, context: Any) -> Any:
        return apps.Mission(name="m", trips=[context.missions[0].trips[0]])

    brain = charged(app=app_with(thief))
    brain.begin([{"name": "patrol", "trips": [trip()]}], 0.0)
    settled(brain, 0.0)
    raised(brain, 1.0, at=[4.0, 2.0])
    settled(brain, 1.0)
    assert "has been used already" in brain.standing()["happenings"]["intruder-1"]["why"]


def test_an_own_event_breaks_a_flight_off_and_charges_no_attempt() -> None:
    brain = charged(app=app_with(lambda *_: None))
    brain.begin([{"name": "patrol", "trips": [trip()]}], 0.0)
    settled(brain, 0.0)
    raised(brain, 2.0)
    assert settled(brain, 2.0) == []
    raised(brain, 3.0, mission="patrol")
    orders = settled(brain, 3.0)
    assert [order["do"] for order in orders] == ["break_off", "forget", "fly"]
    row = brain.mission("patrol")
    assert row["status"] == "RUNNING" and row["attempts"] == 1
    assert row["todo"][0].get("attempt", 1) == 1
    [off] = [event for event in brain.events() if event["event"] == "trip.interrupted"]
    assert off["by"] == "intruder-2"
    brain.tell({"done": orders[-1]["id"]}, 9.0)
    settled(brain, 9.0)
    assert brain.mission("patrol")["status"] == "COMPLETED"


def test_a_trip_that_ends_at_that_instant_has_ended_first() -> None:
    brain = charged(app=app_with(lambda *_: None, of_any=True))
    brain.begin([{"name": "patrol", "trips": [trip()]}], 0.0)
    (fly,) = settled(brain, 0.0)
    raised(brain, 3.0)
    brain.tell({"done": fly["id"]}, 3.0)
    settled(brain, 3.0)
    assert brain.mission("patrol")["status"] == "COMPLETED"


def test_events_that_raise_themselves_come_to_an_end() -> None:
    def again(event: Event, context: Any) -> None:
        context.emit("intruder", at=event.at)

    brain = charged(app=app_with(again))
    raised(brain, 1.0, at=[4.0, 2.0])
    settled(brain, 1.0)
    happened = brain.standing()["happenings"]
    assert len(happened) == MOST + 1
    assert "without an end" in [*happened.values()][-1]["why"]
    assert brain.over == 1.0


def test_what_happens_in_a_world_does_so_at_its_time_and_once_over_restarts() -> None:
    happens = [{"id": "world/1", "name": "intruder", "after": 5.0, "at": (4.0, 2.0)}]
    brain = charged(app=app_with(), recorded=True)
    brain.go_on({}, {"cf1": {"reached": True, "landed": True}}, 0.0)
    brain.tell({"happens": happens}, 0.0)
    settled(brain, 4.9)
    assert not brain.standing()["happenings"]
    assert brain.over is None  # something will happen yet
    settled(brain, 5.0)
    assert [*brain.standing()["happenings"]] == ["world/1"]
    later = charged(app=app_with(), recorded=True)
    later.restore(brain.standing(), 9.0)
    later.go_on({}, {"cf1": {"reached": True, "landed": True}}, 9.0)
    later.tell({"happens": happens}, 9.0)
    assert "event.raised" not in kinds(later)


def test_a_creator_cancels_a_mission() -> None:
    def stop(event: Event, context: Any) -> None:
        for mission in context.missions:
            context.cancel(mission, f"because of {event.id}")

    brain = charged(app=app_with(stop))
    brain.begin([{"name": "patrol", "trips": [trip()]}], 0.0)
    settled(brain, 0.0)
    raised(brain, 3.0)
    settled(brain, 3.0)
    row = brain.mission("patrol")
    assert (row["status"], row["reason"]) == ("CANCELLED", "because of intruder-1")


async def beside(run: Run[Any], status: Status, *, look: Callable[..., object]) -> Status:
    """TripMonitor ∥ EventMonitor ∥ a hook and a TripMonitor behind it → GateFunnel."""

    async def monitor(run: Run[Any], status: Status) -> Status:
        return await watch_event(run, status, event="intruder", of=own)

    async def later(run: Run[Any], status: Status) -> Status:
        return await watch_trip(run, await modify_mission(run, status, hook=look))

    return await wait_for_all(run, status, watch_trip, monitor, later)


def app_beside(look: Callable[..., object]) -> Any:
    """Return an app whose flights a hook stands beside."""
    watch = partial(beside, look=look)
    return replace(app_with(lambda *_: None), flow=apps.flow(watch=watch))


def test_a_branch_that_comes_late_to_its_monitor_finds_the_flight_broken_off() -> None:
    async def look(mission: Any, context: Any) -> None:
        await context.sleep(5.0)

    brain = charged(app=app_beside(look))
    brain.begin([{"name": "patrol", "trips": [trip()]}], 0.0)
    settled(brain, 0.0)
    raised(brain, 3.0, mission="patrol")
    assert "fly" not in [order["do"] for order in settled(brain, 3.0)]
    assert "fly" in [order["do"] for order in settled(brain, 5.0)]
    assert brain.mission("patrol")["attempts"] == 1


def test_a_hook_that_breaks_each_flight_off_goes_round_for_ever_and_is_ended(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Without any time between two launches, and without an end."""
    monkeypatch.setattr(asking, "MOST_CALLS", 20)

    def look(mission: Any, context: Any) -> None:
        context.emit("intruder")

    brain = charged(app=app_beside(look))
    brain.begin([{"name": "patrol", "trips": [trip()]}], 0.0)
    settled(brain, 0.0)
    assert "goes round in its graph for ever" in brain.mission("patrol")["reason"]


def test_a_late_mission_is_an_event() -> None:
    brain = charged(app=app_with(event="late"))
    brain.begin([{"name": "patrol", "trips": [trip()], "promises": {"deadline": 5.0}}], 0.0)
    settled(brain, 0.0)
    orders = settled(brain, 5.0)
    assert [order["do"] for order in orders][:1] == ["break_off"]
    assert brain.standing()["happenings"]["late/patrol/5.0"]["event"]["mission"] == "patrol"


def test_what_has_happened_survives_the_app() -> None:
    brain = charged(app=app_with(), recorded=True)
    raised(brain, 1.0, id="door", at=[4.0, 2.0])
    settled(brain, 1.0)  # its creator waits until that is durable, and the app is killed
    rows = {("happening", key): row for table, key, row in brain.rows() if table == "happening"}
    assert rows[("happening", ("door",))]["open"]
    later = charged(app=app_with(), recorded=True)
    later.restore(brain.standing(), 0.0)
    later.go_on({}, {"cf1": {}}, 0.0)
    settled(later, 0.0)
    later.tell({"durable": 1000}, 0.0)
    settled(later, 0.0)
    assert [*later.standing()["missions"]] == ["chase person"]
    assert not later.standing()["happenings"]["door"]["open"]
    raised(later, 1.0, id="door", at=[4.0, 2.0])
    settled(later, 1.0)
    assert [*later.standing()["missions"]] == ["chase person"]


def test_missions_that_go_on_later_do_not_have_a_creator_asked_again() -> None:
    async def slowly(event: Intruder, context: Any) -> apps.Mission | None:
        await context.sleep(5.0)
        return chase(event, context)

    brain = charged(app=app_with(slowly), recorded=True)
    raised(brain, 1.0, id="door", at=[4.0, 2.0])
    later = charged(app=app_with(slowly), recorded=True)
    later.restore(brain.standing(), 0.0)
    later.go_on({}, {"cf1": {}}, 0.0)
    later.go_on({}, {}, 1.0)
    settled(later, 9.0)
    assert [*later.standing()["missions"]] == ["chase person"]


def test_a_hook_raises_an_event_of_its_own() -> None:
    def look(mission: Any, context: Any) -> None:
        context.emit("intruder", id="seen", at=(4.0, 2.0), kind="dog")

    async def watch(run: Run[Any], status: Status) -> Status:
        status = await modify_mission(run, status, hook=look)
        return await watch_trip(run, status)

    brain = charged(app=replace(app_with(), flow=apps.flow(watch=watch)))
    brain.begin([{"name": "patrol", "trips": [trip()]}], 0.0)
    settled(brain, 0.0)
    event = brain.standing()["happenings"]["seen"]["event"]
    assert event["mission"] == "patrol" and event["drone"] == "cf1" and event["kind"] == "dog"


def test_a_mission_of_an_event_begins_again_where_it_entered() -> None:
    brain = charged(app=app_with(), recorded=True)
    raised(brain, 1.0, id="door", at=[4.0, 2.0])
    brain.tell({"durable": 1000}, 1.0)
    standing = brain.standing()
    standing["missions"]["chase person"]["at"] = "pursue"  # it has not met an allocator yet
    later = charged(app=app_with(), recorded=True)
    later.restore(standing, 0.0)
    later.go_on({"chase person": {}}, {"cf1": {}}, 0.0)
    orders = settled(later, 0.0)
    assert [order["do"] for order in orders] == ["fly"]
