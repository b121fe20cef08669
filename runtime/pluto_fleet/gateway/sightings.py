"""The last known state of each drone, on the disk, for when no brain is in command.

While a brain runs it knows where its drones are. After a Stop, a crash or a kill the gateway is the last
to know, so it stores that, also while there is no brain.
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

from ..jobs.telemetry import Subscription
from ..shared.domain.errors import Failure
from ..shared.hooks.plain_data import point_of

if TYPE_CHECKING:
    from ..jobs.telemetry import Telemetry
    from ..shared.domain.errors import FlightFailed
    from ..shared.domain.model import Point

SEEN = "seen.json"
"""The file, in the gateway's folder."""
EACH, SHORTEST = 1.0, 0.1
"""Seconds between two updates, in the drones' time; and at least in real time."""
ANEW = 5
"""After this many updates without any change the file is written again."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sighting:
    """A drone's last known state."""

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
        """Whether it has fallen, and needs a person."""
        return self.crashed and self.landed


def _well(drone: str) -> None:
    """Always None: no drone is known to be down."""


class Sightings:
    """Stores the states of all drones, as long as one of them has telemetry."""

    def __init__(
        self,
        path: Path,
        drones: Mapping[str, Telemetry],
        *,
        down: Callable[[str], FlightFailed | None] = _well,
        clock: Callable[[], float] = time.time,
    ) -> None:
        """`down` returns why a drone takes no commands, if it takes none."""
        self._path, self._drones, self._down, self._clock = path, drones, down, clock
        self._before = _told(path)
        self._leaving: set[str] = set()
        """The drones that are taking off: their earlier telemetry is outdated."""

    @contextmanager
    def leaving(self, drone: str) -> Iterator[None]:
        """Store that a drone is in the air before it takes off, in case the process is killed next."""
        self._leaving.add(drone)
        self.keep()
        try:
            yield
        finally:
            self._leaving.discard(drone)

    def subscribe(self, speed: float) -> Subscription[object]:
        """Store changes from now on, and now and then even without any."""
        every = max(SHORTEST, EACH / speed)
        return Subscription(
            self._drones,
            lambda *_: self.keep(),
            every=every,
            view=self._state,
            unchanged=ANEW * every,
        )

    def keep(self) -> None:
        """Store the states of all drones; for one without telemetry, its last known state."""
        clock, drones = self._clock(), dict(self._before)
        for drone, known in self._drones.items():
            state = self._state(drone, known)
            if state is not None:
                *how, down = state
                drones[drone] = [*how, round(clock - known.silence, 1), *down]
        part = self._path.with_name(f".{self._path.name}.part")
        with suppress(OSError):  # on a full disk drones fly on; retried at the next update
            part.write_text(json.dumps(drones), encoding="utf-8")
            part.replace(self._path)

    def _state(self, drone: str, known: Telemetry) -> list[Any] | None:
        """Return a drone's state without its time; None: it has no telemetry yet."""
        if not isfinite(known.silence):
            return None
        place = [round(metres, 3) for metres in known.location]
        landed = known.landed and drone not in self._leaving
        down = self._down(drone)
        why = [] if down is None else [down.failure.value, str(down)]
        return [place, round(known.battery_level, 3), landed, why]


def sightings_in(folder: Path) -> dict[str, Sighting]:
    """Return the last known states of the drones of a gateway's folder."""
    with suppress(ValueError, TypeError):  # not one of our files: nothing is known
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
    """Store the initial places of simulated drones that have no state yet."""
    known = {drone: [home, 1.0, True, time.time()] for drone, home in homes.items()}
    (folder / SEEN).write_text(json.dumps(known | _told(folder / SEEN)), encoding="utf-8")


def _told(path: Path) -> dict[str, list[Any]]:
    with suppress(OSError, ValueError):
        told = json.loads(path.read_text(encoding="utf-8"))
        if isinstance(told, dict):
            return told
    return {}
