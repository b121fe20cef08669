"""Which missions, trips and drones of a recorded run have changed since their rows were taken."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, Protocol

from ..domain.keeper import put, trips_of

if TYPE_CHECKING:
    from ..domain.model import Drone, Mission, Trip
    from .flight import Flight


class Stands(Protocol):
    """What is known of a mission beside what hooks see of it."""

    mission: Mission[Any]
    flight: Flight | None
    gone: dict[Trip, int]
    numbered: int
    evaluated: int
    judged: int
    unfit: dict[str, Any] | None


class Changes:
    """What has changed; without a journal nothing is noted."""

    def __init__(self, states: Mapping[str, Stands], *, kept: bool) -> None:
        """`kept`: whether rows are kept at all."""
        self._states = states
        self.kept = kept
        self.missions: dict[str, None] = {}
        self.trips: dict[Trip, str] = {}
        """With the names of their missions."""
        self.drones: dict[Drone, None] = {}
        self.results = 0
        """How many results are known."""

    def mission(self, name: str) -> None:
        """Note that a mission has changed."""
        if self.kept:
            self.missions[name] = None

    def trip(self, mission: Mission[Any], trip: Trip) -> None:
        """Note that a trip has changed, and its mission."""
        if self.kept:
            self.missions[mission.name] = None
            self.trips[trip] = mission.name

    def drone(self, drone: Drone) -> None:
        """Note that a drone has changed."""
        if self.kept:
            self.drones[drone] = None

    def moved_on(self, mission: Mission[Any]) -> None:
        """Note that a mission's graph has gone on from the end of its last flight."""
        state = self._states.get(mission.name)
        if state is None:
            return  # it is just being created
        if state.flight is not None:
            state.flight.heard = True
        state.judged = state.evaluated
        if self.kept:
            self.missions[mission.name] = None

    def leave(self, mission: Mission[Any], trips: Iterable[Trip]) -> None:
        """Note that a mission has these trips no more; in its round their names are taken."""
        state = self._states.get(mission.name)
        if state is None:
            return
        for trip in trips:
            state.gone[trip] = mission.round
            self.trip(mission, trip)

    def arrange(self) -> None:
        """Number the new trips of what has changed, and rank all as they stand in their lists."""
        for name in self.missions:
            state = self._states[name]
            if state.unfit is not None:
                continue
            mission = state.mission
            for trips in mission.completed_trips, trips_of(mission), state.gone:
                rank = 0
                for trip in trips:
                    rank += 1
                    if trip.number and trip.rank >= rank:
                        rank = trip.rank
                        continue
                    number = trip.number
                    if not number:
                        state.numbered += 1
                        number = state.numbered
                    put(trip, rank=rank, number=number)
                    self.trips[trip] = name

    def clear(self, results: int) -> None:
        """Forget what has changed: all of it is known, and so many results."""
        self.missions.clear()
        self.trips.clear()
        self.drones.clear()
        self.results = results
