"""What must hold of every drone, and of the items that drones carry."""

from __future__ import annotations

from collections.abc import Mapping

from ..shared.domain.trace import Event
from .rules import Hears, Say, at

Items = Mapping[str, Mapping[str, str]]
"""By mission: the trips that pick an item, each with the trip that releases it."""

UNWELL = ("drone.recovering", "drone.lost", "drone.charging", "drone.offline")

_GROUND = 0.05
"""The largest height of a drone on the ground, in metres."""


class ServesOneMission:
    """A drone gets another trip only after its last one ended and it was free again.

    A mission may be allocated the drone that it holds: one not launched yet, or with its item. When an
    app resumes, no drone is free before all were queried.
    """

    def __init__(self, say: Say) -> None:
        self._say = say
        self._holder: dict[object, object] = {}
        self._away: dict[object, None] = {}
        self._free_since: dict[object, None] | None = None
        """The drones that have been free in this run of an app with a journal."""
        self.hears = {
            "brain.began": self._begin,
            "drone.free": self._free,
            "drone.offered": self._free,
            "drone.returning": self._leave,
            **dict.fromkeys(UNWELL, self._leave),
            "trip.allocated": self._allocate,
            "trip.launched": self._launch,
            "trip.interrupted": self._offer,
            "trip.relieving": self._relieve,
        }

    def _begin(self, _: Event) -> None:
        self._free_since = {}

    def _offer(self, event: Event) -> None:
        """An event has broken a flight off: the next allocation decides whose its drone is."""
        for drone, holder in tuple(self._holder.items()):
            if holder == event["mission"]:
                del self._holder[drone]
                if self._free_since is not None:
                    self._free_since[drone] = None

    def _relieve(self, event: Event) -> None:
        """Another drone sets out to the mission's flight."""
        self._holder[event["drone"]] = event["mission"]
        self._away.pop(event["drone"], None)

    def _free(self, event: Event) -> None:
        self._holder.pop(event["drone"], None)
        self._away.pop(event["drone"], None)
        if self._free_since is not None:
            self._free_since[event["drone"]] = None

    def _leave(self, event: Event) -> None:
        self._holder.pop(event["drone"], None)
        self._away[event["drone"]] = None

    def _allocate(self, event: Event) -> None:
        drone = event["drone"]
        mission = event["mission"]
        holder = self._holder.get(drone)
        if drone in self._away:
            self._say(f"{at(event)}: {drone} was given to {mission} before it was free again")
        elif holder is None:
            if self._free_since is not None and drone not in self._free_since:
                self._say(f"{at(event)}: {drone} was given to {mission} before it was asked")
        elif holder != mission:
            self._say(f"{at(event)}: {drone} was given to {mission} while {holder} had it")
        self._holder[drone] = mission

    def _launch(self, event: Event) -> None:
        drone = event["drone"]
        mission = event["mission"]
        if self._holder.get(drone) != mission:
            self._say(f"{at(event)}: {drone} flew for {mission}, which did not have it")


class StaysDown:
    """No drone that recovers, charges or is lost is allocated; a lost one stays lost.

    A free drone is on the ground.
    """

    def __init__(self, say: Say) -> None:
        self._say = say
        self._state: dict[object, object] = {}
        self.hears = {
            "drone": self._become,
            "brain.began": self._begin,
            "trip.allocated": self._serve,
            "trip.launched": self._serve,
        }

    def _serve(self, event: Event) -> None:
        state = self._state.get(event["drone"])
        if state in UNWELL:
            self._say(f"{at(event)}: {event['event']} with {event['drone']} after {state}")

    def _begin(self, _: Event) -> None:
        self._state.clear()  # it may have been repaired, and is queried

    def _become(self, event: Event) -> None:
        drone = event["drone"]
        if self._state.get(drone) == "drone.lost":
            self._say(f"{at(event)}: {drone} was lost before {event['event']}")
        self._state[drone] = event["event"]
        if event["event"] == "drone.free":
            where = event.get("at")
            if isinstance(where, list) and where[2] > _GROUND:
                self._say(f"{at(event)}: {drone} is free in the air")


class ItemsStayAboard:
    """From pick to release a mission's item stays with one drone, and that drone with the mission."""

    def __init__(self, items: Mapping[str, Mapping[str, str]], say: Say) -> None:
        self._say = say
        self._items = items
        self._carrier: dict[object, tuple[object, str]] = {}
        """By mission: the drone with its item, and the trip that releases it."""
        self.hears: Mapping[str, Hears] = {
            "trip.allocated": self._serve,
            "trip.launched": self._serve,
            "trip.completed": self._complete,
            "trip.failed": self._end,
            "mission.ended": self._end,
        }
        if not items:  # many apps carry nothing: then it costs nothing
            self.hears = {}

    def _serve(self, event: Event) -> None:
        drone = event["drone"]
        mission = event["mission"]
        has = self._carrier.get(mission)
        if has is not None and has[0] != drone:
            self._say(f"{at(event)}: {mission} has its item aboard {has[0]}, yet takes {drone}")
        for other, (carries, _) in self._carrier.items():
            if carries == drone and other != mission:
                self._say(f"{at(event)}: {drone} has the item of {other}, yet serves {mission}")

    def _complete(self, event: Event) -> None:
        mission = event["mission"]
        trip = str(event["trip"])
        releases = self._items.get(str(mission), {}).get(trip)
        if releases is not None:
            self._carrier[mission] = event["drone"], releases
        elif mission in self._carrier and trip == self._carrier[mission][1]:
            del self._carrier[mission]

    def _end(self, event: Event) -> None:
        self._carrier.pop(event["mission"], None)
