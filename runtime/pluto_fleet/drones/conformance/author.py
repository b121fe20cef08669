"""What the author of a navigation provides to the kit, and the flights that are flown with it."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Coroutine, Mapping
from typing import TYPE_CHECKING, Any
from unittest import SkipTest
from weakref import WeakKeyDictionary

from . import flights
from .probes import LoopWatch, left_since, resources
from .recording import FlightRecord, Truth

if TYPE_CHECKING:
    from ..protocol import DroneNavigation

_FLOWN: WeakKeyDictionary[type, dict[str, FlightRecord]] = WeakKeyDictionary()
"""The flights of each test class."""
_MISSING = {
    "make_unreachable": "no drone was tried that is not there",
    "silence": "no drone was tried that falls silent",
    "crash": "no drone was tried that crashes",
    "may_fall": "emergency_stop was not tried",
}


class Author:
    """The settings of `NavigationContract`, which an author may override."""

    height = 0.5
    """The height to take off to, in metres."""
    away = 1.0
    """Metres to fly, along x from where the drone stands: there must be room."""
    speed = 0.5
    """Metres per second: the limit that is given with each command."""
    rest = 0.4
    """Seconds to observe a drone after a command, while it should stay where it is."""
    tolerance = 0.1
    """The accuracy that is required of its position and of its arrival, in metres."""
    connect_limit = 15.0
    """The time-out of `connect` in seconds, as in a flight."""
    may_fall = False
    """Whether the motors may be switched off ten centimetres above the ground."""

    together = False
    """Whether the flights may run concurrently, as with simulated drones."""

    loop_factory: Callable[[], asyncio.AbstractEventLoop] | None = None
    """What makes the event loops on which to fly: one of a simulator whose time is not the clock's."""

    # Provided by the author

    def make(self) -> DroneNavigation:
        """Return a fresh navigation of a drone that stands on the ground, ready to fly."""
        raise NotImplementedError("give the kit a navigation: def make(self) -> DroneNavigation")

    def make_unreachable(self) -> DroneNavigation:
        """Return a navigation of a drone that does not exist."""
        raise NotImplementedError

    def silence(self, navigation: DroneNavigation) -> None:
        """Make its drone fall silent."""
        raise NotImplementedError

    def crash(self, navigation: DroneNavigation) -> None:
        """Make its drone crash."""
        raise NotImplementedError

    def truth(self, navigation: DroneNavigation) -> Truth | None:
        """Return the true state of its drone, if a simulator or cameras know it."""
        return None

    # The flights, each flown when the first check needs it

    def _tour(self) -> FlightRecord:
        return self._flown("tour")

    def _closed_in_the_air(self) -> FlightRecord:
        return self._flown("closed in the air")

    def _flown(self, name: str) -> FlightRecord:
        flown = _FLOWN.setdefault(type(self), {})
        if name not in flown:
            all_of_it = self._flights()
            at_once = self.together and name != "tour"
            wanted = [one for one in all_of_it if one != "tour"] if at_once else [name]
            with asyncio.Runner(loop_factory=self.loop_factory) as runner:
                flown.update(runner.run(_flying({one: all_of_it[one] for one in wanted})))
        return flown[name]

    def _flights(self) -> Mapping[str, _Flight]:
        """Return the flights that can be flown with what is provided."""
        possible: dict[str, _Flight] = {
            "tour": lambda: flights.tour(self),
            "closed in the air": lambda: flights.closed_in_the_air(self),
        }
        if self._gives("make_unreachable"):
            possible["unreachable"] = lambda: flights.unreachable(self, self.make_unreachable)
        if self._gives("silence"):
            possible["silent"] = lambda: flights.struck(self, self.silence)
        if self._gives("crash"):
            possible["crashed"] = lambda: flights.struck(self, self.crash)
        if self.may_fall:
            possible["cut"] = lambda: flights.cut(self)
        return possible

    def _gives(self, hook: str) -> bool:
        return getattr(type(self), hook) is not getattr(Author, hook)

    def _needs(self, hook: str) -> None:
        """Skip a check if the author does not provide what it needs."""
        if not self._gives(hook):
            raise SkipTest(f"{hook} is not given: {_MISSING[hook]}")


_Flight = Callable[[], Coroutine[Any, Any, FlightRecord]]


async def _flying(wanted: Mapping[str, _Flight]) -> dict[str, FlightRecord]:
    """Fly all of these concurrently, and check what they leave behind."""
    before = resources()
    with LoopWatch() as loop:
        records = await asyncio.gather(*(flight() for flight in wanted.values()))
    left = await left_since(before)
    for record in records:
        record.blocked, record.left = loop.found, left
    return dict(zip(wanted, records, strict=True))
