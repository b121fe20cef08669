"""Where each drone was heard of last: kept on the disk, for a look when no brain commands them.

A brain knows where its drones are while it lives. After a Stop, a crash or a kill the gateway is the
last that hears of them, so it writes that down, also while no brain is there.
"""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.errors import Failure

from ..journal.values import point_of

if TYPE_CHECKING:
    from plutoc_runtime.domain.errors import FlightFailed
    from plutoc_runtime.domain.model import Point, Telemetry

    from ..jobs.telemetry import Publisher, Subscription

SEEN = "seen.json"
"""The file, in the gateway's folder."""
EACH, SHORTEST = 1.0, 0.1
"""Seconds between two looks, as the drones' time passes; and on the wall, however fast that is."""
ANEW = 5
"""After so many looks without any change the file says once more that nothing has changed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sighting:
    """How a drone was when it was last heard of."""

    at: Point
    battery: float
    landed: bool
    when: float
    """Seconds since 1970."""
    why: str = ""
    """Why it took no commands; empty: it did."""
    crashed: bool = False

    @property
    def has_fallen(self) -> bool:
        """Whether it lies where only a person can help it."""
        return self.crashed and self.landed


def _well(drone: str) -> None:
    """It takes commands, for all that anybody says."""


class Sightings:
    """Writes down how all drones are, as long as one of them is heard of."""

    def __init__(
        self,
        path: Path,
        drones: Mapping[str, Telemetry],
        *,
        down: Callable[[str], FlightFailed | None] = _well,
        clock: Callable[[], float] = time.time,
    ) -> None:
        """Begin; `down` says why a drone takes no commands, if it takes none."""
        self._path, self._drones, self._down, self._clock = path, drones, down, clock
        self._before = _told(path)
        self._leaving: set[str] = set()
        """The drones that take off: what they said of themselves before is not so any more."""

    @contextmanager
    def leaving(self, drone: str) -> Iterator[None]:
        """Write down that a drone is in the air before it leaves the ground, in case we are killed next."""
        self._leaving.add(drone)
        self.keep()
        try:
            yield
        finally:
            self._leaving.discard(drone)

    def subscribe(self, publisher: Publisher, speed: float) -> Subscription[object]:
        """Write down what changes, from now on, and now and then that nothing has."""
        every = max(SHORTEST, EACH / speed)
        return publisher.subscribe(
            lambda *_: self.keep(), every=every, view=self._state, unchanged=ANEW * every
        )

    def keep(self) -> None:
        """Write down how all drones are; of one that is not heard of, what was known before."""
        clock, drones = self._clock(), dict(self._before)
        for drone, known in self._drones.items():
            state = self._state(drone, known)
            if state is not None:
                *how, down = state
                drones[drone] = [*how, round(clock - known.silence, 1), *down]
        part = self._path.with_name(f".{self._path.name}.part")
        with suppress(OSError):  # on a full disk drones fly on; the next look is another chance
            part.write_text(json.dumps(drones), encoding="utf-8")
            part.replace(self._path)

    def _state(self, drone: str, known: Telemetry) -> list[Any] | None:
        """Return what is written down of a drone, but for when; None: it was never heard of."""
        if not isfinite(known.silence):
            return None
        place = [round(metres, 3) for metres in known.location]
        landed = known.landed and drone not in self._leaving
        down = self._down(drone)
        why = [] if down is None else [down.failure.value, str(down)]
        return [place, round(known.battery_level, 3), landed, why]


def sightings_in(folder: Path) -> dict[str, Sighting]:
    """Return how the drones of a gateway's folder were last heard of; what is unknown is not in it."""
    with suppress(ValueError, TypeError):  # then it is none of ours, and nothing is known
        return {drone: _sighting(*told) for drone, told in _told(folder / SEEN).items()}
    return {}


def _sighting(
    at: Any, battery: Any, landed: Any, when: Any, failure: str = "", why: str = ""
) -> Sighting:
    return Sighting(
        at=point_of(at),
        battery=float(battery),
        landed=bool(landed),
        when=float(when),
        why=why,
        crashed=failure == Failure.CRASH.value,
    )


def at_home(folder: Path, homes: Mapping[str, Point]) -> None:
    """Say of simulated drones that were never heard of where they begin."""
    known = {drone: [home, 1.0, True, time.time()] for drone, home in homes.items()}
    (folder / SEEN).write_text(json.dumps(known | _told(folder / SEEN)), encoding="utf-8")


def _told(path: Path) -> dict[str, list[Any]]:
    with suppress(OSError, ValueError):
        told = json.loads(path.read_text(encoding="utf-8"))
        if isinstance(told, dict):
            return told
    return {}
