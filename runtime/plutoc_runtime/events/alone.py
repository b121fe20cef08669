"""Ideal drones that go elsewhere on their way, act on it, and see what moves."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf
from typing import Any

from ..alone.drones import Body, IdealDrones, Work
from ..hooks.plain_data import value_data
from .world import MovingWorld

TRACKED = 0.5
"""Seconds from one look at what moves in the world to the next."""


class EventDrones(IdealDrones):
    """Obeys the brain of an app with events."""

    new_world = MovingWorld
    at_once = ("read", "write", "sees", "act")
    world: MovingWorld

    def __init__(self, *given: Any) -> None:
        super().__init__(*given)
        self._seen = 0.0  # when it was looked last at what moves
        self.ways["go"] = self._go
        self.ways["redirect"] = self._redirect

    @property
    def due(self) -> float:
        """When something happens next; infinite: only an order can make it happen."""
        due = super().due
        if not self.world.movers or due == inf:
            return due
        # no look is taken while no drone does anything: the next one may be overdue
        return min(due, max(self._clock.now, self._seen + TRACKED))

    def advance(self) -> dict[str, Any]:
        """Let the next thing happen that is due, and return what there is to tell of it."""
        now = self._clock.now
        if self.world.movers and now >= self._seen + TRACKED:
            self._seen = now
            return {"tracks": self.world.tracks(now)}
        return super().advance()

    def obey(self, order: Mapping[str, Any]) -> None:
        """Begin what is ordered; a flight that is sent elsewhere keeps its number."""
        if order["do"] == "redirect":
            number, _ = self.works[order["drone"]]
            order = {**order, "id": number}
        super().obey(order)

    def arrived(self, order: Mapping[str, Any]) -> None:
        """Tell the end of the last leg of a flight, if its order says that this shall be told."""
        if order.get("company"):
            self.told.append({"arrived": order["flight"]})

    def asked(self, drone: Body, order: Mapping[str, Any]) -> Work:
        """Do what takes no time."""
        match order["do"]:
            case "sees":
                drone.check()
                seen = self.world.moving(drone.location, self._clock.now)
                return [[one.track, one.kind, [*one.at]] for one in seen]
            case "act":
                drone.check()
                return value_data(drone.act(order["action"], order["parameters"], None))
        return (yield from super().asked(drone, order))

    def _redirect(self, drone: Body, order: Mapping[str, Any]) -> Work:
        """Fly on to other stops, from wherever it is."""
        return (yield from self.through(self.way(drone, order), drone, order))

    def _go(self, drone: Body, order: Mapping[str, Any]) -> Work:
        """Fly through stops, and hover."""
        yield from self.until(drone, drone.follow(self.way(drone, order)))
