"""A runtime with one mistake each, of the kind that would only show when something goes wrong."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import pytest

from pluto_fleet.flight import reconcile, recovery, suspending
from pluto_fleet.flight.reconcile import Outcome, outcome_of
from pluto_fleet.flight.recorded_brain import RecordedBrain
from pluto_fleet.gateway.gateway import Gateway, Link
from pluto_fleet.gateway.jobs import AssignedJob
from pluto_fleet.jobs.reports import JobState
from pluto_fleet.journal.fold import Records
from pluto_fleet.shared.domain.status import DroneStatus
from pluto_fleet.shared.fleet.fleet import Fleet
from pluto_fleet.shared.flow import restore, standing
from pluto_fleet.shared.flow.engine import Engine
from pluto_fleet.shared.flow.promises import Promises
from pluto_fleet.shared.flow.restore import Restorer
from pluto_fleet.shared.hooks import plain_data
from pluto_fleet.trials.record import TrialRecord

Plant = Callable[[pytest.MonkeyPatch], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Mutant:
    """A mistake, and what is said of it."""

    plant: Plant
    says: str
    """What the sentence that finds it must match."""
    example: str = "drugs_distribution_retry"
    overrides: Mapping[str, Callable[..., object]] = field(default_factory=dict)
    plain: bool = False
    """Whether the example is not optimised."""


def free_in_flight(patch: pytest.MonkeyPatch) -> None:
    """A drone is free as soon as its trip is over, and flies home free."""

    def freed(really: Callable[[Fleet, Any], None]) -> Callable[[Fleet, Any], None]:
        def send(self: Fleet, drone: Any) -> None:
            really(self, drone)
            self._become(drone, DroneStatus.FREE)

        return send

    patch.setattr(Fleet, "send_home", freed(Fleet.send_home))
    patch.setattr(Fleet, "dismiss", freed(Fleet.dismiss))


def done_before_the_action(patch: pytest.MonkeyPatch) -> None:
    """The ledger says DONE when the action begins."""
    really = AssignedJob.begins

    def begins(self: AssignedJob) -> None:
        really(self)
        self.state = JobState.DONE
        self._jobs.write(self.entry)
        self.state = JobState.BEGUN

    patch.setattr(AssignedJob, "begins", begins)


def cancel_forgets_the_task(patch: pytest.MonkeyPatch) -> None:
    """A mission that is cancelled leaves its timers and its coroutine behind."""

    def leave(self: Engine, state: Any) -> None:
        if state.task is not None:
            self._begun -= 1
            state.task.over = lambda _: None

    patch.setattr(Engine, "_leave", leave)


def snapshot_forgets_delays(patch: pytest.MonkeyPatch) -> None:
    """What is read from a snapshot has waited for nothing."""
    really = Records.__init__

    def begin(self: Records, data: Any = None) -> None:
        really(self, data)
        for record in self.missions.values():
            record["delay"], record["waited"] = None, []

    patch.setattr(Records, "__init__", begin)


def priority_is_lost(patch: pytest.MonkeyPatch) -> None:
    """A trip that is taken up again has the priority of a new one."""
    really = plain_data.trip_of

    def trip_of(app: Any, data: Any, index: int = 0, **more: Any) -> Any:
        trip: Any = really(app, data, index, **more)
        if more:  # it is not a new one
            trip.priority = 0
        return trip

    patch.setattr(standing, "trip_of", trip_of)


def old_brains_are_heard(patch: pytest.MonkeyPatch) -> None:
    """Who was fenced off commands all the same."""
    patch.setattr(Gateway, "cut", lambda self: setattr(self, "_link", None))
    patch.setattr(Gateway, "is_commanded_by", lambda self, link: True)
    patch.setattr(Link, "cut", lambda self: None)


def no_drone_is_asked(patch: pytest.MonkeyPatch) -> None:
    """Every drone is taken for free before it has answered."""

    def take_up(self: Fleet, drone: Any, _: object) -> None:
        drone.status = DroneStatus.FREE
        self.queue.moved(drone)

    patch.setattr(Fleet, "take_up", take_up)


def doubt_is_flown_again(patch: pytest.MonkeyPatch) -> None:
    """What may have been done is done once more."""

    def found(*args: Any) -> Outcome:
        what = outcome_of(*args)
        return Outcome.NOT_DONE if what is Outcome.UNKNOWN else what

    patch.setattr(recovery, "outcome_of", found)
    patch.setattr(suspending, "outcome_of", found)


def stops_count(patch: pytest.MonkeyPatch) -> None:
    """A flight that was interrupted counts as an attempt."""
    really = reconcile.for_brain

    def for_brain(app: Any, record: Any) -> Any:
        todo = record["todo"]
        if record["interrupted"] and todo:
            again = {**todo[0], "attempt": todo[0].get("attempt", 1) + 1}
            record = {**record, "todo": [again, *todo[1:]]}
        return really(app, record)

    patch.setattr(recovery, "for_brain", for_brain)


def results_are_lost(patch: pytest.MonkeyPatch) -> None:
    """Who goes on knows nothing of what was found before."""
    patch.setattr(Restorer, "_restore_results", lambda *_: None)


def carriers_are_given_away(patch: pytest.MonkeyPatch) -> None:
    """A drone with an item aboard is free for all after a Stop."""
    really = reconcile.for_brain

    def for_brain(app: Any, record: Any) -> Any:
        return {**really(app, record), "carrier": None}

    patch.setattr(recovery, "for_brain", for_brain)


def flies_before_it_is_on_record(patch: pytest.MonkeyPatch) -> None:
    """A drone leaves before that could be known."""
    really = RecordedBrain._obey

    def obey(self: RecordedBrain, order: Any) -> None:
        if order["do"] == "fly":
            self._dispatcher.obey(order)
        else:
            really(self, order)

    patch.setattr(RecordedBrain, "_obey", obey)


def delays_go_on_while_stopped(patch: pytest.MonkeyPatch) -> None:
    """A Stop eats up what is left of a delay."""
    patch.setattr("pluto_fleet.journal.fold.shift_delays", lambda *_: None)


def nothing_is_waited_for(patch: pytest.MonkeyPatch) -> None:
    """A mission begins at once, whatever was promised."""

    async def at_once(self: Promises, run: Any) -> Any:
        return await self._core.app.flow(run)

    patch.setattr(Promises, "in_time", at_once)


def only_one_is_waited_for(patch: pytest.MonkeyPatch) -> None:
    """A mission begins when the first of those that it comes after has completed."""
    really = Promises.in_time

    async def in_time(self: Promises, run: Any) -> Any:
        promises = run.mission.promises
        run.mission.promises = {**promises, "after": [*promises.get("after", ())][:1]}
        return await really(self, run)

    patch.setattr(Promises, "in_time", in_time)


def the_past_is_forgiven(patch: pytest.MonkeyPatch) -> None:
    """A deadline that passed while nothing ran is forgotten."""
    really = Promises.watch

    def watch(self: Promises, mission: Any) -> None:
        deadline = mission.promises.get("deadline")
        if deadline is None or deadline >= self._core.kernel.now:
            really(self, mission)

    patch.setattr(Promises, "watch", watch)


def it_is_late_again(patch: pytest.MonkeyPatch) -> None:
    """A mission that goes on does not know that it was late."""
    really = standing.update

    def update(app: Any, mission: Any, record: Any) -> Any:
        return really(app, mission, {**record, "late": False})

    patch.setattr(restore, "update", update)


def ends_are_forgotten(patch: pytest.MonkeyPatch) -> None:
    """A trip that was completed right before the crash is to be flown again."""
    really = Records.take

    def take(self: Records, event: Any) -> None:
        if event["event"] != "trip.completed":
            really(self, event)

    def read(self: TrialRecord, *given: Any) -> Records:
        patch.setattr(Records, "take", take)
        try:
            return really_read(self, *given)
        finally:
            patch.setattr(Records, "take", really)

    really_read = TrialRecord.records
    patch.setattr(TrialRecord, "records", read)


MUTANTS: Mapping[str, Mutant] = {
    "a drone is free in flight": Mutant(plant=free_in_flight, says="is free in the air"),
    "DONE is written before the action": Mutant(
        plant=done_before_the_action, says="says that the action of .* was done: it was not"
    ),
    "a cancelled mission's timers go on": Mutant(
        plant=cancel_forgets_the_task, says="had ended before|ended 2 times|launched"
    ),
    "a snapshot forgets delays": Mutant(
        plant=snapshot_forgets_delays, says="waits until|once more"
    ),
    "priority is lost on resume": Mutant(plant=priority_is_lost, says="and went on with"),
    "an old brain still commands": Mutant(
        plant=old_brains_are_heard, says="was told to .* while told to"
    ),
    "drones count as free before they answer": Mutant(
        plant=no_drone_is_asked, says="before it was asked"
    ),
    "what may have been done is done again": Mutant(
        plant=doubt_is_flown_again, says="was done 2 times", example="alfalfa"
    ),
    "a Stop counts as an attempt": Mutant(plant=stops_count, says="calls itself attempt"),
    "results are lost on resume": Mutant(
        plant=results_are_lost, says="results were there", example="alfalfa"
    ),
    "a stopped mission's carrier is given away": Mutant(
        plant=carriers_are_given_away, says="yet serves|item|before it was free again"
    ),
    "a drone leaves before that is on record": Mutant(
        plant=flies_before_it_is_on_record, says="before that was on record"
    ),
    "a Stop eats up delays": Mutant(plant=delays_go_on_while_stopped, says="waits until"),
    "nothing that was promised is waited for": Mutant(
        plant=nothing_is_waited_for, says="begins before its window|before it is"
    ),
    "one of several is enough for a barrier": Mutant(
        plant=only_one_is_waited_for, says="before it is"
    ),
    "what passed in between is not late": Mutant(
        plant=the_past_is_forgiven, says="and is not late"
    ),
    "a mission is late again after a crash": Mutant(
        plant=it_is_late_again, says="is late once more"
    ),
    "a completed trip is flown again": Mutant(plant=ends_are_forgotten, says="."),
}
"""By what is wrong with each."""
