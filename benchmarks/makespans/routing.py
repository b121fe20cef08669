"""A routing solver's routes for a plan: PyVRP, by the same model of motion.

Each drone is a vehicle with its dock; each trip, or chain from a pick to its release, is a client. From the end of one to
the end of the next takes landing, take-off, the way and the action. The way home after the last does not count. A battery is
a load: a client takes what its flight drains, with a mean way to it, and a dock where drones are charged reloads it, in the
time that this takes. The least shift in which all can be served is found by halving.

What the model leaves out: that drones wait for each other in the air, priorities, and how much each way itself drains. The trips
of a mission are one client (`whole`), or clients of their own whose order is not known to the solver. So the result is no
bound: it counts once it was flown.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf
from statistics import mean
from typing import TYPE_CHECKING, Any

from pyvrp import Model
from pyvrp.stop import MaxRuntime

from pluto_fleet.shared.domain.app import moving
from pluto_fleet.shared.fleet.reach import chain_of, flight_seconds, stops_of

if TYPE_CHECKING:
    from pluto_fleet.shared.domain.model import Category, Point, Trip

    from .flying import Loaded, Routes

TICKS = 100  # of the solver's clock in a second
NEVER = 10**8  # what cannot be flown takes so long
_NEAR = 5
"""To how many of the nearest others the mean way is taken."""
_KEEPS = 0.9
"""The share of a usable battery that is planned with: what ways drain is estimated."""


@dataclass(frozen=True, slots=True)
class Client:
    """Trips that one drone flies one after the other."""

    chains: Sequence[Sequence[Trip]]

    @property
    def last(self) -> Point:
        """Where the drone is at the end, in the air."""
        return self.chains[-1][-1].target

    @property
    def names(self) -> Iterator[str]:
        """The names of its trips."""
        return (trip.name for one in self.chains for trip in one)


class Routing:
    """A plan as the solver sees it."""

    def __init__(self, loaded: Loaded, *, whole: bool) -> None:
        self._loaded, self._space = loaded, loaded.fleet.airspace
        app = moving(loaded.app, loaded.fleet.motion)
        self._app, kinds = app, {kind.name: kind for kind in app.categories}
        self.drones = [(one.id, kinds[one.category], one.home) for one in loaded.fleet.drones]
        self.clients = [*self._clients(whole)]
        self._kinds = {kind.name: kind for _, kind, _ in self.drones}
        self._from = {
            name: [self._ways(kind, _under(one.last), one.last[2]) for one in self.clients]
            for name, kind in self._kinds.items()
        }
        """By category: from the end of each client to the end of each, in seconds."""

    @property
    def has_missions_of_several(self) -> bool:
        """Whether a mission has several chains, whose order the solver may not know."""
        return any(len(client.chains) > 1 for client in self.clients)

    def _clients(self, whole: bool) -> Iterator[Client]:
        for mission in self._loaded.missions:
            chains, trips = list[Sequence[Any]](), mission.trips
            while trips:
                chains.append(chain_of(trips))
                trips = trips[len(chains[-1]) :]
            yield from [Client(chains)] if whole else (Client([one]) for one in chains)

    def _ways(self, kind: Category, start: Point, height: float) -> list[float]:
        return [self._way(kind, start, height, client) for client in self.clients]

    def _way(self, kind: Category, start: Point, height: float, client: Client) -> float:
        """Return the seconds from a place in the air, or on the ground, to the end of a client."""
        seconds, speed = 0.0, kind.speed
        for trips in client.chains:
            if not all(
                kind.can(trip.action) and (trip.item is None or trip.item.mass <= kind.payload)
                for trip in trips
            ):
                return inf
            if height > 0.0:
                seconds += kind.motion.lands(height, speed)
            stops = stops_of(self._app, kind, self._space.cruise_height, trips)
            points, busy = [point for point, _ in stops], sum(one for _, one in stops)
            seconds += flight_seconds(kind, self._space, start, points, busy)
            start, height = _under(trips[-1].target), trips[-1].target[2]
        return seconds

    def routes(self, within: float, seconds: float, seed: int) -> Routes | None:
        """Return routes that end within a time; None: none was found in so many seconds."""
        model, shift = Model(), round(within * TICKS)
        end = model.add_location(0, 0)
        nowhere = model.add_depot(end)
        places = [model.add_location(n, 1) for n in range(len(self.clients))]
        found: list[tuple[Any, Any]] = []
        tight = self._charges(within)
        for place, client in zip(places, self.clients, strict=True):
            model.add_client(place, delivery=[self._drains(client)] if tight else [])
        for number, (name, kind, _) in enumerate(self.drones):
            docks = model.add_location(number, 2), model.add_location(number, 3)
            profile = model.add_profile(name=name)
            start = model.add_depot(docks[0])
            usable = (1.0 - kind.reserve) * kind.endurance * _KEEPS
            full = round(kind.charge_time * (1.0 - kind.reserve) * TICKS)
            charger = model.add_depot(docks[1], service_duration=full)
            model.add_vehicle_type(
                1,
                capacity=[round(usable)] if tight else [],
                start_depot=start,
                end_depot=nowhere,
                shift_duration=shift,
                unit_distance_cost=0,
                unit_duration_cost=1,
                profile=profile,
                reload_depots=[charger] if tight else [],
                name=name,
            )
            found.append((profile, docks))
        for (profile, docks), (_, kind, home) in zip(found, self.drones, strict=True):
            self._edges(model, profile, docks, end, places, kind, home)
        result = model.solve(MaxRuntime(seconds), seed=seed, display=False)
        if not result.is_feasible():
            return None
        routes: dict[str, list[str]] = {}
        for route in result.best.routes():
            visited = (visit.idx for visit in route if visit.is_client())
            names = [name for n in visited for name in self.clients[n].names]
            routes[self.drones[route.vehicle_type()][0]] = names
        return routes

    def _edges(
        self,
        model: Model,
        profile: Any,
        docks: tuple[Any, Any],
        end: Any,
        places: Sequence[Any],
        kind: Category,
        home: Point,
    ) -> None:
        out = self._ways(kind, (home[0], home[1], 0.0), 0.0)
        for place, seconds, client, ways in zip(
            places, out, self.clients, self._from[kind.name], strict=True
        ):
            for dock in docks:
                model.add_edge(dock, place, 0, _ticks(seconds), profile)
            height = client.last[2]
            back = kind.motion.lands(height, kind.speed) + flight_seconds(
                kind, self._space, _under(client.last), [(home[0], home[1], 0.0)], 0.0
            )
            model.add_edge(place, docks[1], 0, _ticks(back), profile)
            model.add_edge(place, end, 0, 0, profile)
            for other, way in zip(places, ways, strict=True):
                if other is not place:
                    model.add_edge(place, other, 0, _ticks(way), profile)
        for dock in docks:
            model.add_edge(dock, end, 0, 0, profile)

    def _drains(self, client: Client) -> int:
        """Return about how many seconds in the air a client takes, with a mean way to it."""
        place = self.clients.index(client)
        ways = [
            mean(sorted(column)[:_NEAR])
            for kind in self._kinds
            if (column := [row[place] for row in self._from[kind] if row[place] < inf])
        ]
        return round(min(ways))

    def _charges(self, within: float) -> bool:
        """Whether a drone may have to be charged within a time."""
        return any((1 - kind.reserve) * kind.endurance < within for _, kind, _ in self.drones)


def _under(point: Point) -> Point:
    return point[0], point[1], 0.0


def _ticks(seconds: float) -> int:
    return NEVER if seconds == inf else round(seconds * TICKS)
