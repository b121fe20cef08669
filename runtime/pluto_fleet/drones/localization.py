"""Positions that are measured from outside, and fed to the drones.

A drone that estimates its own position (by a Lighthouse deck, Loco anchors, a flow deck, GPS) needs
nothing of this: that is the localization `own`. Any other is a user's class, named in the fleet file. It
may name unknown drones, and a drone may be slow to receive: that does not delay the others.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import AsyncIterator, Callable, Mapping
from math import isfinite
from typing import Protocol

from ..shared.domain.model import Point
from ..shared.domain.text import quoted
from .protocol import Locatable
from .source import MISTAKES, Source


class Localization(Protocol):
    """A system that measures where drones are; the class is called with the table `[localization]`."""

    def positions(self) -> AsyncIterator[tuple[str, Point]]:
        """Yield positions until cancelled: the drone's id, and its position.

        Metres, in the map's frame: positions in another frame are converted here. At least ten times a
        second for each drone; one that has had none for a second may not take off, and its flight
        fails. A drone that cannot be seen is left out, never given its last place again.

        Most simply an async generator: what it has opened it closes in its `finally`. If it ends or
        raises, it is called again a second later. Nothing in it may hold up the event loop.
        """


SILENCE = 1.0
"""Seconds without a position after which a drone has lost its position."""


class LocalizationFeed:
    """Feeds one localization's positions to the drones, in a running event loop."""

    def __init__(
        self,
        name: str,
        source: Localization,
        drones: Mapping[str, Locatable],
        log: Callable[[str], object],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.name = name
        """Its name in the fleet file."""
        self._drones = dict(drones)
        self._log = log
        self._clock = clock
        self._source = Source(
            f"the localization {name}", "positions", source.positions, self._hear, log
        )
        self._say = self._source.say
        self._heard = dict.fromkeys(drones, clock())
        """When each drone has received its latest position."""
        self._latest: dict[str, Point] = {}
        """The latest position still to be sent to each drone; older ones are dropped."""
        self._telling: dict[str, asyncio.Task[None]] = {}

    def start(self) -> None:
        self._source.start()

    def feed(self, drone: str, navigation: Locatable) -> None:
        """Feed a drone that has joined, too."""
        self._drones[drone], self._heard[drone] = navigation, self._clock()

    def silent(self, drone: str) -> str | None:
        """Return why a drone has no current position, or None."""
        heard = self._heard.get(drone)
        if heard is None or (since := self._clock() - heard) <= SILENCE:
            return None
        return f"no position from {self.name} for {since:.1f} s"

    async def close(self) -> None:
        """Stop the feed, and wait until it has ended."""
        await self._source.close()
        tasks = [*self._telling.values()]
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)

    def _hear(self, one: object) -> None:
        match one:
            case (str(drone), (float() | int() as x, float() | int() as y, float() | int() as z)):
                position = float(x), float(y), float(z)
            case _:
                self._say(f"{self._source.name} gave what is no drone and position")
                return
        if drone not in self._drones:
            self._say(f"{self._source.name} sees {quoted(drone)}, which is not in the fleet")
        elif not all(isfinite(value) for value in position):
            self._say(f"{self._source.name} gave {drone} a position that is no number")
        else:
            self._latest[drone] = position
            if drone not in self._telling:
                telling = asyncio.create_task(self._tell(drone), name=f"position of {drone}")
                self._telling[drone] = telling

    async def _tell(self, drone: str) -> None:
        try:
            while (position := self._latest.pop(drone, None)) is not None:
                await self._drones[drone].locate(position)
                self._heard[drone] = self._clock()
        except MISTAKES as error:
            self._say(f"{drone} could not be told where it is: {type(error).__name__}: {error}")
        finally:
            del self._telling[drone]
