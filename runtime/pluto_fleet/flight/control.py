"""The user's commands to a running app: stop, pause, go on, skip, cancel, decide, …

Each is called within the kernel, and returns a sentence for the user; `BadInput` says why it cannot be
done. Nothing here waits before the drones are told.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.status import DroneStatus, Status
from plutoc_runtime.domain.text import counted, quoted
from plutoc_runtime.time.future import Future
from plutoc_runtime.time.kernel import FLEET, Task, mission_key

from ..jobs.reports import Down
from ..journal.recorder import Recorder
from . import interventions
from .live_engine import live_engine
from .live_fleet import live_fleet
from .reconcile import (
    Outcome,
    doubt,
    find_outcome,
    fly_again,
    fly_on,
    resume_status,
    settle_doubt,
    was_done,
)

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Drone, Trip
    from plutoc_runtime.flow.engine import Session
    from plutoc_runtime.flow.mission import MissionState
    from plutoc_runtime.trips.flight import Flight

    from ..jobs.job import CommandLink
    from ..journal.fold import Record

    Then = Callable[[MissionState], None]

CANCELLED = "cancelled by hand"


class Control:
    """The commands of one running app."""

    def __init__(self, session: Session, link: CommandLink) -> None:
        self._link, self._core, self._engine = link, session.core, live_engine(session)
        self.stopped: Future[Down] = Future()
        """Set when everything was stopped and all drones are down."""
        self.whole: Task[float] | None = None
        """The task that starts or resumes all missions, and waits for their end."""
        self._stops: Task[None] | None = None
        self._steps_out: dict[str, Task[None]] = {}
        """The tasks of missions whose flights are being aborted."""

    def stop(self, how: Down) -> str:
        """Suspend every mission and bring all drones down; all can be resumed later."""
        core = self._core
        if self._stops is None and self.whole is not None and self.whole.is_set:
            return "all missions have ended, and all drones are down"
        if self._stops is None:
            self._engine.halt()
            live_fleet(core).halt()
            for work in self._steps_out.values():
                work.cancel()
            if self.whole is not None:
                self.whole.cancel()  # it may still be querying drones: nothing may begin after that
            core.trace.note("stopped", how=how.value)
        else:
            self._stops.cancel()
        self._stops = core.kernel.spawn(self._bring_down(how), FLEET, "everything stops")
        return "stopping: " + _HOW[how]

    async def _bring_down(self, how: Down) -> None:
        await self._link.bring_down(how)
        self.stopped.set(how)

    def pause(self, mission: str | None = None) -> str:
        """Suspend a mission, or all, until it is told to go on."""
        states = self._those(mission, lambda status: status not in _ASIDE, "can be paused")
        for state in states:
            self._step_out(state, self._paused)
        return f"{_named(states)}: paused"

    def go_on(self, mission: str | None = None) -> str:
        """Resume a paused mission, or all paused ones."""
        states = self._those(mission, lambda status: status is Status.PAUSED, "is paused")
        for state in states:
            self._refuse_while_it_steps_out(state)
        for state in states:
            self._resume(state)
        return f"{_named(states)}: going on"

    def skip(self, mission: str, trip: str | None = None) -> str:
        """Skip a trip, the next one or the one named; if it flies, its drone comes home."""
        state = self._state(mission)
        if state.mission.status in (Status.UNCERTAIN, Status.HELD):
            raise BadInput(f"mission {quoted(mission)} waits for a decision: decide that first")
        unwanted = _trip_to_skip(state, trip)
        if unwanted is state.mission.trips[0]:  # it may fly, or be waited for
            self._step_out(state, partial(self._skip, unwanted))
        else:
            interventions.skip(self._core, state.mission, unwanted)
        return f"mission {quoted(mission)}: trip {quoted(unwanted.name)} is skipped"

    def cancel(self, mission: str | None = None) -> str:
        """End a mission, or all, for good: CANCELLED."""
        states = self._those(mission, lambda _: True, "can be cancelled")
        for state in states:
            self._cancel(state)
        return f"{_named(states)}: cancelled"

    def decide(self, mission: str, answer: str) -> str:
        """Answer an open question: `done`, `not-done`, `go-on` or `cancel`."""
        state = self._state(mission)
        status = state.mission.status
        fitting = ANSWERS.get(status, ())
        if answer not in fitting:
            asked = f"fitting answers are {', '.join(fitting)}" if fitting else "it asks nothing"
            raise BadInput(f"mission {quoted(mission)} is {status.value}: {asked}")
        if answer == "go-on" and not (state.mission.trips or state.mission.completed_trips):
            raise BadInput(f"mission {quoted(mission)} cannot go on in this app: cancel it")
        interventions.decide(self._core, state.mission, answer)
        if answer == "cancel":
            self._cancel(state)
        elif answer == "go-on":
            points = self._core.app.resumes
            state.at = state.at if state.at in points else next(iter(points), None)
            self._step_out(state, self._resume)
        else:
            settle_doubt(state, self._engine, self._link, answer == "done")
        return f"mission {quoted(mission)}: {answer}"

    def prioritise(self, mission: str, trip: str, priority: int) -> str:
        """Change the priority of a trip that has not been flown."""
        state = self._state(mission)
        if not any(field.name == interventions.PRIORITY for field in self._core.app.fields):
            raise BadInput("the trips of this app have no priority")
        wanted = _trip_to_do(state, trip)
        interventions.prioritise(self._core, state.mission, wanted, priority)
        self._core.queue.prioritise(wanted, priority)
        return f"mission {quoted(mission)}: trip {quoted(trip)} has priority {priority}"

    def retire(self, drone: str) -> str:
        """Allocate a drone to no further trip, until it is brought back."""
        who = self._drone(drone)
        if who in live_fleet(self._core).retired:
            return f"{drone} is retired already"
        self._core.trace.note("drone.retired", drone=drone)
        flies = who.status is DroneStatus.BUSY
        live_fleet(self._core).retire(who)
        return f"{drone} is retired" + (", once its trip is over" if flies else "")

    def bring_back(self, drone: str) -> str:
        """Make a drone available again that was retired, or lost and repaired since."""
        who, fleet = self._drone(drone), live_fleet(self._core)
        lost = who.status is DroneStatus.LOST
        asked = lost or who in fleet.unready
        if not asked and who not in fleet.retired:
            return f"{drone} is neither retired nor lost"
        self._core.trace.note("drone.brought_back", drone=drone, lost=lost)
        fleet.bring_back(who)
        return f"{drone} is asked whether it is well" if asked else f"{drone} is back"

    def remember(self, id: str, command: str) -> None:
        """Record that a command is carried out, so that it is never carried out twice."""
        self._core.trace.note("commanded", id=id, command=command)

    async def carried_out(self) -> None:
        """Wait until a command has taken effect and is durable."""
        for work in list(self._steps_out.values()):
            await work.ended()
        recorder = self._core.recorder
        if recorder is not None:
            await recorder.on_record()

    # Suspending one mission, and resuming it

    def _step_out(self, state: MissionState, then: Then) -> None:
        """Suspend a mission; continue when the outcome of its flight is known."""
        mission, flight = state.mission, state.in_flight
        self._refuse_while_it_steps_out(state)
        if flight is None:
            flown = self._record(state)["flight"]
            state.goes_on = bool(flown and flown["outcome"] and not flown["heard"])
            self._engine.set_aside(state)
            then(state)
            return
        self._engine.set_aside(state)
        mission.status = Status.PAUSED
        state.break_off(flight)
        self._steps_out[mission.name] = self._core.kernel.spawn(
            self._broken_off(state, flight, then),
            mission_key(mission.index),
            f"{mission.name} is interrupted",
        )

    def _refuse_while_it_steps_out(self, state: MissionState) -> None:
        name = state.mission.name
        if name in self._steps_out:
            raise BadInput(
                f"mission {quoted(name)} is just being interrupted: its drone is asked what it has "
                "done; try again in a moment"
            )

    async def _broken_off(self, state: MissionState, flight: Flight, then: Then) -> None:
        """Abort a flight, and find out its outcome from the ledger and the drone."""
        fleet_report = await self._link.fleet_report()
        entry = fleet_report.jobs.get(flight.id)
        begun = bool(self._record(state)["flight"]["begun"])
        what = await find_outcome(self._core, flight, entry, begun)
        del self._steps_out[state.mission.name]
        if not self._engine.is_aside(state):
            return  # it has ended meanwhile
        if flight.is_set:
            state.goes_on = True
            then(state)
            return
        if what is Outcome.UNKNOWN:
            doubt(state, flight)
            if flight.trip.item is None:
                self._core.fleet.recover(flight.flier)
            self._engine.look_for_the_end()
            return
        if what is Outcome.FLIES_ON and entry is not None:  # it has just ended
            fly_on(state, flight, self._link, entry)
            if state.doom is not None:
                return  # for good
        else:
            if what is Outcome.DONE:
                was_done(state, flight)
            else:
                fly_again(state, flight, self._link)
            if flight.flier is state.carrier:
                state.keep_carrier(flight.flier)
            else:
                self._core.fleet.recover(flight.flier)
        then(state)

    def _paused(self, state: MissionState) -> None:
        interventions.pause(self._core, state.mission)

    def _resume(self, state: MissionState) -> None:
        flight = state.flight if state.goes_on else None
        status = resume_status(state) if flight is None else flight.result()
        interventions.resume(self._core, state.mission, status)
        delay = self._record(state)["delay"]
        if state.delay is not None and delay is not None:
            state.delay = state.delay[0], delay[1], delay[2]  # it has not waited meanwhile
        self._engine.resume(state, resume_status(state))

    def _skip(self, unwanted: Trip, state: MissionState) -> None:
        mission = state.mission
        was_paused = self._record(state)["paused"] is not None
        if unwanted in mission.trips:
            interventions.skip(self._core, mission, unwanted)
            state.goes_on = False
        if not mission.trips and not state.goes_on:
            self._engine.end(state, Status.COMPLETED, "")
        elif not was_paused:
            self._resume(state)

    def _cancel(self, state: MissionState) -> None:
        work = self._steps_out.pop(state.mission.name, None)
        if work is not None:
            work.cancel()
        self._engine.set_aside(state)
        flight = state.in_flight
        if flight is not None and state.mission.status is Status.UNCERTAIN:
            state.flight = None  # its drone may be flying for another mission by now
            if flight.trip.item is not None:
                self._core.fleet.recover(flight.flier)
                state.carrier = None
        self._engine.end(state, Status.CANCELLED, CANCELLED)

    # Which missions and drones

    def _drone(self, id: str) -> Drone:
        self._refuse_after_stop()
        for drone in self._core.fleet.drones:
            if drone.id == id:
                return drone
        names = ", ".join(quoted(drone.id) for drone in self._core.fleet.drones)
        raise BadInput(f"no drone {quoted(id)} is in the fleet; there are: {names}")

    def _record(self, state: MissionState) -> Record:
        recorder = self._core.recorder
        assert isinstance(recorder, Recorder)
        return recorder.records.missions[state.mission.name]

    def _state(self, mission: str) -> MissionState:
        self._refuse_after_stop()
        for state in self._engine.states:
            if state.mission.name == mission:
                return state
        names = ", ".join(quoted(state.mission.name) for state in self._engine.states)
        raise BadInput(f"no mission {quoted(mission)} is under way; there are: {names or 'none'}")

    def _refuse_after_stop(self) -> None:
        if self._stops is not None:
            raise BadInput("everything was stopped: resume the journal first")

    def _those(
        self, mission: str | None, fits: Callable[[Status], bool], what: str
    ) -> Sequence[MissionState]:
        self._refuse_after_stop()
        if mission is not None:
            state = self._state(mission)
            if not fits(state.mission.status):
                raise BadInput(f"mission {quoted(mission)} is {state.mission.status.value}")
            return (state,)
        states = [state for state in self._engine.states if fits(state.mission.status)]
        if not states:
            raise BadInput(f"no mission {what}")
        return states


def _trip_to_skip(state: MissionState, name: str | None) -> Trip:
    """Return the trip to skip; raise `BadInput` if it cannot be skipped."""
    mission = state.mission
    who = f"mission {quoted(mission.name)}"
    if not mission.trips:
        raise BadInput(f"{who} has no trip left to skip")
    unwanted = mission.trips[0] if name is None else _trip_to_do(state, name)
    if unwanted.item is not None:
        raise BadInput(
            f"{who}: trip {quoted(unwanted.name)} picks or releases {unwanted.item.name}, and what "
            "is picked must be released: cancel the mission instead"
        )
    return unwanted


def _trip_to_do(state: MissionState, name: str) -> Trip:
    trips: dict[str, Trip] = {trip.name: trip for trip in state.mission.trips}
    if name not in trips:
        left = ", ".join(quoted(one) for one in trips) or "none"
        raise BadInput(
            f"mission {quoted(state.mission.name)} has no trip {quoted(name)} to do; it has {left}"
        )
    return trips[name]


def _named(states: Sequence[MissionState]) -> str:
    if len(states) == 1:
        return f"mission {quoted(states[0].mission.name)}"
    return counted(len(states), "mission")


_ASIDE = (Status.PAUSED, Status.UNCERTAIN, Status.HELD)

ANSWERS = {Status.UNCERTAIN: ("done", "not-done", "cancel"), Status.HELD: ("go-on", "cancel")}
"""The possible answers, by the mission's status."""

_HOW = {
    Down.HOME: "all drones fly home and land",
    Down.LAND: "all drones land where they are",
}
