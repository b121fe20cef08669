"""Feeds what a localization sees to the drones, and says so when it is silent.

A source may stop, fail, speak of strangers or talk nonsense, and a drone may take long to hear: none
of that holds up the others, nor ends the feeding.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Mapping
from math import isfinite
from typing import TYPE_CHECKING

from plutoc_runtime.domain.text import quoted

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point

    from .localization import Localization
    from .protocol import Locatable

SILENCE = 1.0
"""Seconds without a position, after which a drone does not know any more where it is."""
PAUSE = 1.0
"""Seconds until a source that ended is asked again."""
_MISTAKES: tuple[type[Exception], ...] = (Exception,)
"""Whatever a class of somebody else's raises: it is put into the log, and nothing else stops."""
_SAID = 20
"""How many strangers are named: a source may make up ever new ones."""


class Feeding:
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
        if sentence not in self._said and len(self._said) < _SAID:
            self._said.add(sentence)
            self._log(sentence)
