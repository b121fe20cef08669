"""MissionModifier: the thesis's third exercise, and statuses that cannot be."""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import pytest

from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.model import Mission
from pluto_fleet.shared.domain.status import Status, TripStatus
from pluto_fleet.shared.flow import asking
from pluto_fleet.shared.flow.run import Run
from pluto_fleet.shared.hooks.context import Context
from pluto_fleet.trials.invariants import violations
from plutoc_blocks.mission_creator.step import create_mission
from plutoc_blocks.mission_modifier.step import modify_mission
from tests.kit import apps

ANY_END = (Status.STANDBY, Status.COMPLETED, Status.FAILED)


async def limit_trip(mission: Mission[apps.Trip], context: Context) -> Status:
    """A timer of 12 s, as an app's developer would write it."""
    trip = mission.current
    if await context.trip_ended(trip, within=12.0):
        return mission.status
    assert trip.expired(12.0)
    return Status.FAILED


def test_a_timer_written_as_a_modifier_fails_a_trip_that_takes_too_long() -> None:
    outcome = apps.flown(
        apps.mission("m", apps.trip("A", 2.0), apps.trip("B", 15.0)),
        watch=apps.modified(limit_trip, *ANY_END),
    )
    (mission,) = outcome.missions
    assert mission.status is Status.FAILED
    assert mission.reason == "modifier limit_trip failed the trip"
    (failure,) = apps.events(outcome, "trip.failed")
    assert failure["t"] == pytest.approx(apps.times(outcome, "trip.launched")[1] + 12.0)


async def says_standby(mission: Mission[apps.Trip], context: Context) -> Status:
    return Status.STANDBY


def after(
    returned: Status, *trips: apps.Trip, faults: Faults = apps.NO_FAULTS, again: bool = False
) -> str:
    """Return why a mission fails whose modifier says this when its trip has ended, or nothing."""

    async def watch(run: Run[Any], status: Status) -> Status:
        status = await apps.watched(run, status)
        said = [returned] if run.mission.attempts == 1 or again else [status]
        return await modify_mission(
            run, status, hook=lambda mission, context: said.pop(), emits=(*Status,)
        )

    (mission,) = apps.flown(apps.mission("m", *trips), watch=watch, faults=faults).missions
    return mission.reason.removeprefix(f"modifier <lambda> returned {returned.value}, but ")


@pytest.mark.parametrize(
    ("returned", "trips", "why"),
    [
        (Status.STANDBY, 2, ""),
        (Status.COMPLETED, 1, ""),
        (Status.RUNNING, 2, "no trip is in flight"),
        (Status.COMPLETED, 3, "2 trips are still to do"),
        (Status.STANDBY, 1, "no trip is left to do"),
        (Status.UNEXECUTED, 1, "no trip is left to do"),
        (Status.UNEXECUTED, 2, "the mission has flown already"),
        (Status.FAILED, 2, "modifier <lambda> failed the mission"),
    ],
)
def test_a_status_must_fit_what_the_mission_is(returned: Status, trips: int, why: str) -> None:
    assert after(returned, *(apps.trip(str(n), 2.0) for n in range(trips))) == why


def test_a_trip_that_has_failed_must_be_put_back_before_the_mission_stands_by() -> None:
    says = "trip A has failed; trip.reset() puts it back"
    assert after(Status.STANDBY, apps.trip("A", 2.0), faults=Faults(action=1.0)) == says


def test_a_mission_that_has_not_flown_may_stay_unexecuted() -> None:
    async def flow(run: Run[Any]) -> Status:
        status = create_mission(run, Status.UNEXECUTED)
        hook = lambda mission, context: Status.UNEXECUTED
        return await modify_mission(run, status, hook=hook, emits=(Status.UNEXECUTED,))

    (mission,) = apps.fly(apps.app(flow), apps.mission("m", apps.trip("A", 2.0))).missions
    assert (mission.status, mission.reason) == (Status.UNEXECUTED, "")


def test_a_status_that_cannot_be_in_flight_fails_the_mission() -> None:
    outcome = apps.flown(
        apps.mission("m", apps.trip("A", 5.0), apps.trip("B", 5.0)),
        watch=apps.modified(says_standby, *ANY_END),
    )
    (mission,) = outcome.missions
    assert mission.status is Status.FAILED
    assert mission.reason.endswith("returned STANDBY, but trip A is still flying")
    assert outcome.drones[0].status.value == "FREE", "its drone was called home"


@pytest.mark.parametrize(
    ("emits", "returned", "says"),
    [
        (ANY_END, Status.RUNNING, "must return one of STANDBY, COMPLETED, FAILED, not RUNNING"),
        (ANY_END, "done", "must return one of STANDBY, COMPLETED, FAILED, not 'done'"),
        ((), Status.FAILED, "declares no `emits` and so must return nothing, not FAILED"),
        (ANY_END, Status.FAILED, ""),
        ((), None, ""),
    ],
)
def test_what_a_modifier_returns_is_told_also_where_another_branch_was_faster(
    emits: tuple[Status, ...], returned: object, says: str
) -> None:
    """The mission goes on with the branch that won: the trip's own end, which called the hook off."""

    async def returns_when_called_off(mission: Mission[apps.Trip], context: Context) -> object:
        with suppress(BaseException):
            await context.trip_ended(mission.current, within=1e6)
        return returned

    watch = apps.modified(returns_when_called_off, *emits)
    outcome = apps.flown(apps.mission("m", apps.trip("A", 2.0)), watch=watch)
    assert outcome.completed
    assert outcome.log == ([f"modifier returns_when_called_off {says}"] if says else [])


def test_a_modifier_without_emits_changes_the_mission_and_not_its_status() -> None:
    def go_elsewhere(mission: Mission[apps.Trip], context: Context) -> None:
        mission.current.target = (7.0, 7.0, 1.2)
        context.log(f"{context.now:g} s: elsewhere")

    outcome = apps.flown(apps.mission("m", apps.trip("A", 2.0)), prepare=go_elsewhere)
    assert outcome.completed
    assert outcome.log == ["0 s: elsewhere"]
    assert outcome.flown["cf1"] > 15.0


def test_a_trip_is_reset_only_when_it_is_over() -> None:
    trip = apps.trip("A", 2.0)
    trip.status = TripStatus.EXECUTING
    with pytest.raises(ValueError, match="in flight"):
        trip.reset()
    trip.status = TripStatus.FAILED
    trip.reset()
    assert (trip.status, trip.attempt) == (TripStatus.WAITING, 2)


async def round_and_round(run: Run[Any], status: Status) -> Status:
    """A loop of one modifier, which sleeps or does not."""
    while True:
        status = await modify_mission(run, status, hook=LOOKS[run.mission.name])


def look(mission: Mission[apps.Trip], context: Context) -> None:
    """Look, and change nothing."""


async def look_later(mission: Mission[apps.Trip], context: Context) -> None:
    """Look after a while."""
    await context.sleep(0.001)


LOOKS = {"at once": look, "later": look_later}


@pytest.mark.parametrize("name", LOOKS)
def test_a_mission_that_goes_round_for_ever_fails_with_the_reason(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where its hook sleeps in between: then the clock does not stand still."""
    monkeypatch.setattr(asking, "MOST_CALLS", 5_000)
    outcome = apps.flown(apps.mission(name, apps.trip("A", 2.0)), watch=round_and_round)
    (mission,) = outcome.missions
    assert mission.status is Status.FAILED
    assert "it goes round in its graph for ever" in mission.reason
    assert outcome.drones[0].status.value == "FREE"


def test_hooks_calls_are_counted_from_launch_to_launch(monkeypatch: pytest.MonkeyPatch) -> None:
    """A mission of many trips calls its hooks often, and goes round nowhere."""
    monkeypatch.setattr(asking, "MOST_CALLS", 1)
    trips = [apps.trip(f"{number}", 1.0 + number) for number in range(4)]
    assert apps.flown(apps.mission("m", *trips), prepare=look).completed


def leave_out(mission: Mission[apps.Trip], context: Context) -> Status:
    """Do not try a trip again that failed."""
    if mission.status is Status.FAILED:
        del mission.trips[0]
        return Status.STANDBY if mission.trips else Status.COMPLETED
    return mission.status


def test_what_a_modifier_makes_of_a_mission_is_told_in_simulations_too() -> None:
    """Otherwise it looks as if trips had been flown too often, or not at all."""

    async def watch(run: Run[Any], status: Status) -> Status:
        status = await apps.watched(run, status)
        return await modify_mission(run, status, hook=leave_out, emits=ANY_END)

    for seed in range(3):
        outcome = apps.flown(
            apps.mission("m", apps.trip("A", 2.0), apps.trip("B", 2.0), repeat=2),
            faults=Faults(action=0.2),
            seed=seed,
            watch=watch,
            repeater=True,
        )
        assert violations(outcome.events, {}) == []
