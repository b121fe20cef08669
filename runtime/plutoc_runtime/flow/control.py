"""What people want of a running app, as far as its missions and drones are concerned."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from ..domain.errors import BadInput
from ..domain.keeper import drop_trip, put, put_trips, trips_of
from ..domain.status import DroneStatus, Status
from ..hooks.plain_data import trip_of
from ..time.kernel import mission_key

if TYPE_CHECKING:
    from ..domain.model import Drone, Trip
    from .engine import Engine
    from .mission import MissionState
    from .restore import Restorer

PRIORITY = "priority"
"""The field of trips with the priority in the queue, in apps whose graph has one."""

Request = Mapping[str, Any]


class _Request(dict[str, Any]):
    """A request, of which a command takes what it needs."""

    def __missing__(self, key: str) -> Any:
        raise BadInput(f"the command {self['command']} needs {key!r}")


class Control:
    """Carries out commands; each returns what it did, or raises `BadInput`."""

    def __init__(self, engine: Engine, restorer: Restorer) -> None:
        self._core, self._engine, self._restorer = engine.core, engine, restorer

    def perform(self, request: Request) -> str:
        """Carry out a command."""
        do = _COMMANDS.get(str(request.get("command")))
        if do is None:
            raise BadInput(f"there is no command {request.get('command')!r}")
        return do(self, _Request(request))

    def _pause(self, request: Request) -> str:
        state = self._state(request)
        self._engine.suspend(state)
        return f"{state.mission.name} has left its graph"

    def _cancel(self, request: Request) -> str:
        state = self._state(request)
        status = Status(request.get("status", Status.CANCELLED.value))
        self._engine.cancel(state, status, str(request.get("reason", "")))
        return f"{state.mission.name} has ended"

    def _skip(self, request: Request) -> str:
        state, trip = self._trip(request)
        if trip is trips_of(state.mission)[0] and state.task is not None:
            raise BadInput(f"trip {trip.name} may be flying: pause its mission first")
        drop_trip(state.mission, trip)
        return f"trip {trip.name} is skipped"

    def _change_trips(self, request: Request) -> str:
        """Replace all that a mission has to do behind its first trip, which may be flying."""
        state = self._state(request)
        core = self._core
        trips = trips_of(state.mission)
        if state.task is None or not trips:
            raise BadInput(f"mission {request['mission']} has no trip before these in its graph")
        new = [trip_of(core.app, one, place) for place, one in enumerate(request["trips"], 1)]
        put_trips(state.mission, [trips[0], *new])
        self._engine.keep(state.mission, new)
        return f"mission {request['mission']} has {len(trips)} trips to do"

    def _prioritise(self, request: Request) -> str:
        _, trip = self._trip(request)
        if not any(field.name == PRIORITY for field in self._core.app.fields):
            raise BadInput("the trips of this app have no priority")
        put(trip, **{PRIORITY: request["priority"]})
        self._core.queue.prioritise(trip, request["priority"])
        return f"trip {trip.name} has priority {request['priority']}"

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
        core.fleet.drones.append(drone)
        self._restorer.drones[drone.id] = drone
        return f"{drone.id} has joined"

    # Whether an action was done

    def _probe(self, request: Request) -> str:
        """Ask the app's own hook whether the action of a mission's last flight was done."""
        state = self._restorer.restored(request["mission"], request["record"])
        flight = state.flight
        if flight is None:
            raise BadInput(f"mission {request['mission']} has no flight to ask about")

        async def ask() -> None:
            known = await flight.action.was_done(state, flight)
            self._core.orders.probed(flight.drone, flight.id, known)

        key = mission_key(state.mission.index)
        self._core.kernel.spawn(ask(), key, f"{flight.id} is probed")
        return f"{flight.id} is probed"

    # Which mission, trip or drone

    def _state(self, request: Request) -> MissionState:
        state = self._engine.states.get(request["mission"])
        if state is None or state.ended:
            raise BadInput(f"mission {request['mission']} is not under way")
        return state

    def _trip(self, request: Request) -> tuple[MissionState, Trip]:
        state = self._state(request)
        for trip in trips_of(state.mission):
            if trip.name == request["trip"]:
                return state, trip
        raise BadInput(f"mission {request['mission']} has no trip {request['trip']} to do")

    def _drone(self, request: Request) -> Drone:
        for drone in self._core.fleet.drones:
            if drone.id == request["drone"]:
                return drone
        raise BadInput(f"no drone {request['drone']} is in the fleet")


_COMMANDS: Mapping[str, Callable[[Control, Request], str]] = {
    "pause": Control._pause,
    "cancel": Control._cancel,
    "skip": Control._skip,
    "change-trips": Control._change_trips,
    "prioritise": Control._prioritise,
    "retire": Control._retire,
    "bring-back": Control._bring_back,
    "join": Control._join,
    "probe": Control._probe,
}
