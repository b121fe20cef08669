"""A runtime with one mistake each, of the kind that would only show when something goes wrong."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import pytest

from pluto_fleet.flight import recovery, suspending
from pluto_fleet.flight.reconcile import Outcome, outcome_of
from pluto_fleet.gateway.gateway import Gateway, Line
from pluto_fleet.gateway.jobs import Jobs
from pluto_fleet.jobs.reports import JobState
from pluto_fleet.journal.recorder import Recorder
from pluto_fleet.shared.domain.keeper import put
from pluto_fleet.shared.domain.status import DroneStatus
from pluto_fleet.shared.fleet.fleet import Fleet
from pluto_fleet.shared.flow import engine, record
from pluto_fleet.shared.hooks import plain_data

Plant = Callable[[pytest.MonkeyPatch], None]


@dataclass(frozen=True, slots=True, kw_only=True)
class Mutant:
    """A mistake, and what is said of it."""

    plant: Plant
    says: str
    """What the sentence that finds it must match."""
    seed: int
    """Of the case by chance that is the first to show it."""
    strikes: str
    """What has to strike a small case that shows it, if none by chance does."""
    example: str


MUTANTS: dict[str, Mutant] = {}
"""By what is wrong with each."""


def mutant(
    says: str, seed: int = 0, strikes: str = "", example: str = "drugs_distribution_retry"
) -> Callable[[Plant], Plant]:
    """Say how a mistake shows."""

    def known(plant: Plant) -> Plant:
        name = plant.__name__.replace("_", " ")
        MUTANTS[name] = Mutant(plant=plant, says=says, seed=seed, strikes=strikes, example=example)
        return plant

    return known


@mutant("is free in the air")
def a_drone_is_free_in_flight(patch: pytest.MonkeyPatch) -> None:
    def freed(really: Callable[[Fleet, Any], None]) -> Callable[[Fleet, Any], None]:
        def send(self: Fleet, drone: Any) -> None:
            really(self, drone)
            self.take_up(drone, {"landed": True})

        return send

    patch.setattr(Fleet, "send_home", freed(Fleet.send_home))
    patch.setattr(Fleet, "dismiss", freed(Fleet.dismiss))


@mutant("says that the action of .* was done: it was not", strikes="gateway@3+21.651")
def done_is_written_before_the_action(patch: pytest.MonkeyPatch) -> None:
    really = Jobs.write

    def write(self: Jobs, job: Any) -> None:
        begun = job.state is JobState.BEGUN
        really(self, replace(job, state=JobState.DONE) if begun else job)

    patch.setattr(Jobs, "write", write)


@mutant("waits until|once more", seed=3)
def delays_are_forgotten_when_it_goes_on(patch: pytest.MonkeyPatch) -> None:
    really = record.restored

    def restored(core: Any, name: str, row: Any, new_state: Any) -> Any:
        return really(core, name, {**row, "delay": None, "waited": []}, new_state)

    patch.setattr(engine, "restored", restored)


@mutant("and went on with")
def priority_is_lost_when_it_goes_on(patch: pytest.MonkeyPatch) -> None:
    really = plain_data.trip_of

    def trip_of(app: Any, data: Any, index: int = 0, **more: Any) -> Any:
        trip: Any = really(app, data, index, **more)
        if more:  # it is not a new one
            trip.priority = 0
        return trip

    patch.setattr(record, "trip_of", trip_of)


@mutant("was told to .* while told to", seed=7)
def an_old_brain_still_commands(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(Gateway, "cut", lambda self: setattr(self, "commander", None))
    patch.setattr(Gateway, "is_commanded_by", lambda self, link: True)
    patch.setattr(Line, "cut", lambda self: None)


@mutant("before it was asked")
def drones_count_as_free_before_they_answer(patch: pytest.MonkeyPatch) -> None:
    def take_up(self: Fleet, drone: Any, _: object) -> None:
        put(drone, status=DroneStatus.FREE)
        self.queue.moved(drone)

    patch.setattr(Fleet, "take_up", take_up)


@mutant("was done 2 times", seed=271, example="alfalfa")
def what_may_have_been_done_is_done_again(patch: pytest.MonkeyPatch) -> None:
    def found(*args: Any) -> Outcome:
        what = outcome_of(*args)
        return Outcome.NOT_DONE if what is Outcome.UNKNOWN else what

    patch.setattr(recovery, "outcome_of", found)
    patch.setattr(suspending, "outcome_of", found)


@mutant("results were there", seed=6, example="alfalfa")
def results_are_lost_when_it_goes_on(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(engine, "restore_results", lambda *_: None)


@mutant("yet serves|item|before it was free again", seed=6)
def a_stopped_missions_carrier_is_given_away(patch: pytest.MonkeyPatch) -> None:
    really = record.restored

    def restored(core: Any, name: str, row: Any, new_state: Any) -> Any:
        return really(core, name, {**row, "carrier": None}, new_state)

    patch.setattr(engine, "restored", restored)


@mutant("before that was on record")
def a_drone_leaves_before_that_is_on_record(patch: pytest.MonkeyPatch) -> None:
    patch.setattr(Recorder, "when_durable", lambda self, call: call())
