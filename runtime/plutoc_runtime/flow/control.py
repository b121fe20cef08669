"""What people, or what was found out, want of a running app, as far as its missions and drones are concerned."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from ..domain.errors import BadInput
from ..domain.fields import Entity
from ..domain.keeper import put, trips_of
from ..domain.status import DroneStatus, Status
from ..fleet.orders import failure_of
from ..hooks.plain_data import fields_of, point_of, trip_of, value_of
from .record import copy_trip

if TYPE_CHECKING:
    from ..domain.model import Drone, Trip
    from .engine import Engine
    from .flight import Flight
    from .mission import MissionState

PRIORITY = "priority"
"""The field of trips with the priority in the queue, in apps whose graph has one."""

Request = Mapping[str, Any]


class _Request(dict[str, Any]):
    """A request, of which a command takes what it needs."""

    def __missing__(self, key: str) -> Any:
        raise BadInput(f"the command {self['command']} needs {key!r}")


class Control:
    """Carries out commands; each raises `BadInput` with the reason why it cannot be done."""

    def __init__(self, engine: Engine) -> None:
        self._core = engine.core
        self._engine = engine
        self._note = engine.core.transitions.note

    def perform(self, request: Request) -> None:
        """Carry out a command."""
        do = _COMMANDS.get(str(request.get("command")))
        if do is None:
            raise BadInput(f"there is no command {request.get('command')!r}")
        do(self, _Request(request))

    # Out of the graph, and back

    def _leave(self, request: Request) -> None:
        self._engine.suspend(self._state(request))

    def _pause(self, request: Request) -> None:
        """Note that a mission which has left its graph waits until a person lets it go on."""
        state = self._state(request)
        if state.paused is None:
            state.paused = self._core.kernel.now
        self._note("mission.paused", state.mission)

    def _doubt(self, request: Request) -> None:
        """Note that only a person can say whether the action of its flight was done."""
        state = self._state(request)
        flight = self._flight(state)
        state.question = str(request["reason"])
        state.held = None
        state.answer = None
        facts = {"trip": flight.trip.name, "drone": flight.drone, "reason": state.question}
        self._note("mission.uncertain", state.mission, **facts)

    def _hold(self, request: Request) -> None:
        """Note why a mission cannot go on in the app as it is now."""
        state = self._state(request)
        state.held = str(request["reason"])
        self._note("mission.held", state.mission, reason=state.held)

    def _decide(self, request: Request) -> None:
        """Note what a person has answered."""
        state = self._state(request)
        state.answer = str(request["answer"])
        if state.answer == "go-on":
            state.accepted = state.at
        self._note("mission.decided", state.mission, answer=state.answer)

    def _resume(self, request: Request) -> None:
        """Note that a mission goes on: nothing keeps it out of its graph any more."""
        state = self._state(request)
        mission = state.mission
        if state.paused is not None:
            state.postpone(self._core.kernel.now - state.paused)
        state.paused = None
        state.held = None
        state.question = None
        state.answer = None
        begun = mission.attempts or state.interrupted
        status = Status.STANDBY if begun else Status.UNEXECUTED
        flight = state.flight
        if flight is not None and flight.is_set and not flight.heard:
            status = flight.result()
        put(mission, status=status)
        self._note("mission.resumed", mission, status=status.value)

    def _settle(self, request: Request) -> None:
        """Take over what came of the flight of a mission that has left its graph."""
        state = self._state(request)
        flight = self._flight(state)
        if "failure" in request:
            state.settle(flight, failure_of(request))
        elif request.get("done"):
            state.settle(flight, value_of(request.get("value")))
        else:
            state.interrupt(flight)

    def _cancel(self, request: Request) -> None:
        status = Status(request.get("status", Status.CANCELLED.value))
        self._engine.cancel(self._state(request), status, str(request.get("reason", "")))

    def _probe(self, request: Request) -> None:
        """Ask the app's own hook whether the action of a mission's last flight was done."""
        state = self._state(request)
        flight = self._flight(state)

        async def ask() -> None:
            known = await flight.action.was_done(state, flight)
            order = {"do": "probed", "drone": flight.drone, "flight": flight.id, "value": known}
            self._core.orders.give(order)

        state.spawn(ask(), f"{flight.id} is probed")

    # Its trips

    def _skip(self, request: Request) -> None:
        state = self._state(request)
        trip = self._trip(state, request)
        is_first = trip is trips_of(state.mission)[0]
        if is_first and state.task is not None:
            raise BadInput(f"trip {trip.name} may be flying: pause its mission first")
        if is_first:
            self._forget_the_end(state)
        self._core.transitions.skip(state.mission, trip)

    def _change_trips(self, request: Request) -> None:
        """Replace what a mission has to do; while it is in its graph, all behind its first trip."""
        state = self._state(request)
        mission = state.mission
        old = trips_of(mission)
        if not old:
            raise BadInput(f"mission {mission.name} has no trip left to change")
        next_before = self._as_planned(old[0])
        named = {trip.name: trip for trip in old}
        new = old[:1] if state.task is not None else []
        for place, data in enumerate(request["trips"], 1):
            given = trip_of(self._core.app, data, place)
            trip = named.get(given.name, given)
            copy_trip(given, trip)
            new.append(trip)
        self._engine.keep(mission, new)
        if state.task is None and next_before != self._as_planned(new[0]):
            state.delay = None  # it was the delay of another trip, or another delay
            if next_before[0] != new[0].name:
                self._forget_the_end(state)
        state.replanned = True
        self._core.transitions.replan(mission, new)

    def _as_planned(self, trip: Trip) -> tuple[str, object]:
        return trip.name, fields_of(self._core.app, Entity.TRIP, trip)

    def _forget_the_end(self, state: MissionState) -> None:
        """With another trip next, the end of the last flight is not where its graph goes on."""
        if state.flight is not None and state.flight.is_set:
            self._core.changes.moved_on(state.mission)

    def _prioritise(self, request: Request) -> None:
        state = self._state(request)
        trip = self._trip(state, request)
        if not any(field.name == PRIORITY for field in self._core.app.fields):
            raise BadInput("the trips of this app have no priority")
        self._core.transitions.prioritise(state.mission, trip, request["priority"])
        self._core.queue.prioritise(trip, request["priority"])

    def _acts_beside(self, request: Request) -> None:
        """Note where an action is done that is not done at its trip's target."""
        for state in self._engine.states.values():
            flight = state.in_flight
            if flight is None or flight.id != request["flight"] or flight.beside is not None:
                continue
            flight.beside = point_of(request["at"])
            facts = {
                "trip": flight.trip.name,
                "drone": flight.drone,
                "round": flight.round,
                "attempt": flight.attempt,
                "target": request["target"],
                "at": request["at"],
            }
            self._note("trip.beside", state.mission, **facts)

    # Drones

    def _retire(self, request: Request) -> None:
        self._core.fleet.retire(self._drone(request))

    def _bring_back(self, request: Request) -> None:
        self._core.fleet.bring_back(self._drone(request))

    def _join(self, request: Request) -> None:
        core = self._core
        data = {"id": request["drone"], **request}
        offline = DroneStatus.OFFLINE  # until it is said how it is
        core.fleet.join(core.orders.drone_of(core.app, data, offline, len(core.fleet.drones)))

    # Which mission, flight, trip or drone

    def _state(self, request: Request) -> MissionState:
        state = self._engine.states.get(request["mission"])
        if state is None or state.ended:
            raise BadInput(f"mission {request['mission']} is not under way")
        return state

    def _flight(self, state: MissionState) -> Flight:
        if state.unsettled is None:
            raise BadInput(f"mission {state.mission.name} has no flight to ask about")
        return state.unsettled

    def _trip(self, state: MissionState, request: Request) -> Trip:
        for trip in trips_of(state.mission):
            if trip.name == request["trip"]:
                found: Trip = trip
                return found
        raise BadInput(f"mission {state.mission.name} has no trip {request['trip']} to do")

    def _drone(self, request: Request) -> Drone:
        drone = self._core.fleet.named(request["drone"])
        if drone is None:
            raise BadInput(f"no drone {request['drone']} is in the fleet")
        return drone


_COMMANDS: Mapping[str, Callable[[Control, Request], None]] = {
    "leave": Control._leave,
    "pause": Control._pause,
    "doubt": Control._doubt,
    "hold": Control._hold,
    "decide": Control._decide,
    "resume": Control._resume,
    "settle": Control._settle,
    "cancel": Control._cancel,
    "probe": Control._probe,
    "skip": Control._skip,
    "change-trips": Control._change_trips,
    "prioritise": Control._prioritise,
    "acts-beside": Control._acts_beside,
    "retire": Control._retire,
    "bring-back": Control._bring_back,
    "join": Control._join,
}
