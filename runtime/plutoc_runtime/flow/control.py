"""What people, or what was found out, want of a running app, as far as its missions and drones are concerned."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields as dataclass_fields
from typing import TYPE_CHECKING, Any

from ..domain.errors import BadInput
from ..domain.fields import Entity
from ..domain.keeper import put, trips_of
from ..domain.status import DroneStatus, Status
from ..fleet.orders import failure_of
from ..hooks.plain_data import fields_of, point_of, trip_of, value_of
from ..time.kernel import mission_key

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
    """Carries out commands; each returns what it did, or raises `BadInput`."""

    def __init__(self, engine: Engine) -> None:
        self._core = engine.core
        self._engine = engine

    def perform(self, request: Request) -> str:
        """Carry out a command."""
        do = _COMMANDS.get(str(request.get("command")))
        if do is None:
            raise BadInput(f"there is no command {request.get('command')!r}")
        return do(self, _Request(request))

    # Out of the graph, and back

    def _leave(self, request: Request) -> str:
        state = self._state(request)
        self._engine.suspend(state)
        return f"{state.mission.name} has left its graph"

    def _pause(self, request: Request) -> str:
        """Note that a mission which has left its graph waits until a person lets it go on."""
        state = self._state(request)
        if state.paused is None:
            state.paused = self._core.kernel.now
        self._core.transitions.note("mission.paused", state.mission)
        return f"{state.mission.name} is paused"

    def _doubt(self, request: Request) -> str:
        """Note that only a person can say whether the action of its flight was done."""
        state, flight = self._flight(request)
        state.question = str(request["reason"])
        state.held = state.answer = None
        facts = {"trip": flight.trip.name, "drone": flight.drone, "reason": state.question}
        self._core.transitions.note("mission.uncertain", state.mission, **facts)
        return f"{state.mission.name} is uncertain"

    def _hold(self, request: Request) -> str:
        """Note why a mission cannot go on in the app as it is now."""
        state = self._state(request)
        state.held = str(request["reason"])
        self._core.transitions.note("mission.held", state.mission, reason=state.held)
        return f"{state.mission.name} is held"

    def _decide(self, request: Request) -> str:
        """Note what a person has answered."""
        state = self._state(request)
        state.answer = str(request["answer"])
        if state.answer == "go-on":
            state.accepted = state.at
        self._core.transitions.note("mission.decided", state.mission, answer=state.answer)
        return f"{state.mission.name}: {state.answer}"

    def _resume(self, request: Request) -> str:
        """Note that a mission goes on: nothing keeps it out of its graph any more."""
        state = self._state(request)
        mission = state.mission
        if state.paused is not None and state.delay is not None:
            place, over, begins = state.delay
            state.delay = (place, over + self._core.kernel.now - state.paused, begins)
        state.paused = state.held = state.question = state.answer = None
        begun = mission.attempts or state.interrupted
        status = Status.STANDBY if begun else Status.UNEXECUTED
        flight = state.flight
        if flight is not None and flight.is_set and not flight.heard:
            status = flight.result()
        put(mission, status=status)
        self._core.transitions.note("mission.resumed", mission, status=status.value)
        return f"{mission.name} goes on"

    def _settle(self, request: Request) -> str:
        """Take over what came of the flight of a mission that has left its graph."""
        state, flight = self._flight(request)
        if "failure" in request:
            state.settle(flight, failure_of(request))
        elif request.get("done"):
            state.settle(flight, value_of(request.get("value")))
        else:
            state.interrupt(flight)
        return f"{flight.id} is settled"

    def _cancel(self, request: Request) -> str:
        state = self._state(request)
        status = Status(request.get("status", Status.CANCELLED.value))
        self._engine.cancel(state, status, str(request.get("reason", "")))
        return f"{state.mission.name} has ended"

    def _probe(self, request: Request) -> str:
        """Ask the app's own hook whether the action of a mission's last flight was done."""
        state, flight = self._flight(request)

        async def ask() -> None:
            known = await flight.action.was_done(state, flight)
            self._core.orders.probed(flight.drone, flight.id, known)

        key = mission_key(state.mission.index)
        self._core.kernel.spawn(ask(), key, f"{flight.id} is probed")
        return f"{flight.id} is probed"

    # Its trips

    def _skip(self, request: Request) -> str:
        state, trip = self._trip(request)
        trips = trips_of(state.mission)
        if trip is trips[0] and state.task is not None:
            raise BadInput(f"trip {trip.name} may be flying: pause its mission first")
        self._forget_the_end(state, other_first=trip is trips[0])
        self._core.transitions.skip(state.mission, trip)
        return f"trip {trip.name} is skipped"

    def _change_trips(self, request: Request) -> str:
        """Replace what a mission has to do; while it is in its graph, all behind its first trip."""
        state = self._state(request)
        mission, old = state.mission, trips_of(state.mission)
        if not old:
            raise BadInput(f"mission {mission.name} has no trip left to change")
        named = {trip.name: trip for trip in old}
        first = old[:1] if state.task is not None else []
        given: Sequence[Request] = request["trips"]
        before = old[0].name, fields_of(self._core.app, Entity.TRIP, old[0])
        new = [*first, *(self._edited(named, one, place) for place, one in enumerate(given, 1))]
        self._engine.keep(mission, new)
        if not first:
            self._forget_the_end(state, other_first=before[0] != new[0].name)
            if before != (new[0].name, fields_of(self._core.app, Entity.TRIP, new[0])):
                state.delay = None  # it was the delay of another trip, or another delay
        state.replanned = True
        self._core.transitions.replan(mission, new)
        return f"mission {mission.name} has {len(new)} trips to do"

    def _edited(self, named: Mapping[str, Trip], data: Request, place: int) -> Trip:
        """Return a new trip, or one of these as it shall be now."""
        new = trip_of(self._core.app, data, place)
        trip = named.get(new.name)
        if trip is None:
            return new
        facts = {one.name: getattr(new, one.name) for one in dataclass_fields(new)}
        put(trip, **{name: facts[name] for name in facts if name not in ("number", "rank")})
        return trip

    def _forget_the_end(self, state: MissionState, *, other_first: bool) -> None:
        """With another trip next, the end of the last flight is not where its graph goes on."""
        if other_first and state.flight is not None and state.flight.is_set:
            self._core.changes.moved_on(state.mission)

    def _prioritise(self, request: Request) -> str:
        state, trip = self._trip(request)
        if not any(field.name == PRIORITY for field in self._core.app.fields):
            raise BadInput("the trips of this app have no priority")
        self._core.transitions.prioritise(state.mission, trip, request["priority"])
        self._core.queue.prioritise(trip, request["priority"])
        return f"trip {trip.name} has priority {request['priority']}"

    def _acts_beside(self, request: Request) -> str:
        """Note where an action is done that is not done at its trip's target."""
        for state in self._engine.states.values():
            flight = state.in_flight
            if flight is None or flight.id != request["flight"]:
                continue
            if flight.beside is None:
                flight.beside = point_of(request["at"])
                facts = {
                    "trip": flight.trip.name,
                    "drone": flight.drone,
                    "round": flight.round,
                    "attempt": flight.attempt,
                    "target": request["target"],
                    "at": request["at"],
                }
                self._core.transitions.note("trip.beside", state.mission, **facts)
            return f"{flight.id} is done beside its target"
        return f"{request['flight']} is no mission's any more"

    # Drones

    def _retire(self, request: Request) -> str:
        drone = self._drone(request)
        self._core.fleet.retire(drone)
        return f"{drone.id} is retired"

    def _bring_back(self, request: Request) -> str:
        drone = self._drone(request)
        self._core.fleet.bring_back(drone)
        return f"{drone.id} is back"

    def _join(self, request: Request) -> str:
        core, data = self._core, {"id": request["drone"], **request}
        offline = DroneStatus.OFFLINE  # until it is said how it is
        drone = core.orders.drone_of(core.app, data, offline, len(core.fleet.drones))
        core.fleet.join(drone)
        return f"{drone.id} has joined"

    # Which mission, trip or drone

    def _state(self, request: Request) -> MissionState:
        state = self._engine.states.get(request["mission"])
        if state is None or state.ended:
            raise BadInput(f"mission {request['mission']} is not under way")
        return state

    def _flight(self, request: Request) -> tuple[MissionState, Flight]:
        state = self._state(request)
        if state.unsettled is None:
            raise BadInput(f"mission {request['mission']} has no flight to ask about")
        return state, state.unsettled

    def _trip(self, request: Request) -> tuple[MissionState, Trip]:
        state = self._state(request)
        for trip in trips_of(state.mission):
            if trip.name == request["trip"]:
                return state, trip
        raise BadInput(f"mission {request['mission']} has no trip {request['trip']} to do")

    def _drone(self, request: Request) -> Drone:
        drone = self._core.fleet.named(request["drone"])
        if drone is None:
            raise BadInput(f"no drone {request['drone']} is in the fleet")
        return drone


_COMMANDS: Mapping[str, Callable[[Control, Request], str]] = {
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
