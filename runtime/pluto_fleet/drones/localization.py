"""Positions that are measured from outside: what measures them, and how they are fed to the drones.

A drone that estimates its own position (by a Lighthouse deck, Loco anchors, a flow deck, GPS) needs
nothing of this: that is the localization `own`. Any other is a class of a user's, named in the fleet
file. A source may stop, fail, name unknown drones or talk nonsense, and a drone may take long to hear:
none of that holds up the others, nor ends the feed.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import AsyncIterator, Callable, Mapping
from math import isfinite
from typing import TYPE_CHECKING, Protocol

from plutoc_runtime.domain.text import quoted

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point

    from .protocol import Locatable


OWN = "own"
"""The name of the localization that feeds nothing."""


class Localization(Protocol):
    """A system that measures where drones are; the class is called with the table `[localization]`."""

    def positions(self) -> AsyncIterator[tuple[str, Point]]:
        """Yield positions for as long as they are wanted: the drone's id, and where it is.

        Metres, in the map's frame: positions in another frame are converted here. At least ten times a
        second for each drone; one that has had none for a second may not take off, and its flight
        fails. A drone that cannot be seen is left out, never given its last place again.

        Most simply an async generator: what it has opened it closes in its `finally`. If it ends or
        raises, it is called again a second later. Nothing in it may hold up the event loop.
        """
        ...


SILENCE = 1.0
"""Seconds without a position, after which a drone does not know any more where it is."""
PAUSE = 1.0
"""Seconds until a source that ended is asked again."""
_MISTAKES: tuple[type[Exception], ...] = (Exception,)
"""What a class of a user's raises is put into the log, and nothing else stops."""
_MOST_SENTENCES = 20
"""How many unknown drones are named: a source may make up ever new ones."""


class LocalizationFeed:
    """One localization and the drones that go by it; lives in a running event loop."""

    def __init__(
        self,
        name: str,
        source: Localization,
        drones: Mapping[str, Locatable],
        log: Callable[[str], object],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self.name = name
        """As the fleet file has it."""
        self._source, self._drones, self._log, self._clock = source, drones, log, clock
        self._heard = dict.fromkeys(drones, clock())
        """When each was told where it is: what is only on its way helps no drone."""
        self._latest: dict[str, Point] = {}
        """What a drone is still to be told; older positions are not worth it."""
        self._telling: dict[str, asyncio.Task[None]] = {}
        self._said: set[str] = set()
        self._listening: asyncio.Task[None] | None = None

    def start(self) -> None:
        """Begin to listen, and to feed."""
        if self._listening is None:
            self._listening = asyncio.create_task(self._listen(), name=f"positions of {self.name}")

    def silent(self, drone: str) -> str | None:
        """Return why a drone does not know where it is, or None: a position came within a second."""
        heard = self._heard.get(drone)
        if heard is None or (since := self._clock() - heard) <= SILENCE:
            return None
        return f"no position from {self.name} for {since:.1f} s"

    async def close(self) -> None:
        """Stop; nothing is left of it."""
        tasks = [*self._telling.values()]
        if self._listening is not None:
            tasks.append(self._listening)
        for task in tasks:
            task.cancel()
        await asyncio.gather(*tasks, return_exceptions=True)

    async def _listen(self) -> None:
        while True:
            positions = None
            try:
                positions = self._source.positions()
                async for one in positions:
                    self._hear(one)
                    await asyncio.sleep(0)  # or one that is never out of news would hold up all
                why = "it ended"
            except _MISTAKES as error:
                why = f"{type(error).__name__}: {error}"
            finally:
                close = getattr(positions, "aclose", None)
                if close is not None:
                    await close()
            self._say(f"the localization {self.name} gives no positions any more ({why})")
            await asyncio.sleep(PAUSE)

    def _hear(self, one: object) -> None:
        match one:
            case (str(drone), (float() | int() as x, float() | int() as y, float() | int() as z)):
                position = float(x), float(y), float(z)
            case _:
                self._say(f"the localization {self.name} gave what is no drone and position")
                return
        if drone not in self._drones:
            name = quoted(drone)
            self._say(f"the localization {self.name} sees {name}, which is not in the fleet")
        elif not all(isfinite(value) for value in position):
            self._say(f"the localization {self.name} gave {drone} a position that is no number")
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
        except _MISTAKES as error:
            self._say(f"{drone} could not be told where it is: {type(error).__name__}: {error}")
        finally:
            del self._telling[drone]

    def _say(self, sentence: str) -> None:
        """Log something once: a source that is wrong is wrong many times a second."""
        if sentence not in self._said and len(self._said) < _MOST_SENTENCES:
            self._said.add(sentence)
            self._log(sentence)
