"""The last known state of each drone, on the disk, for when no brain is in command.

While a brain runs it knows where its drones are. After a Stop, a crash or a kill the gateway is the last
to know, so it stores that, also while there is no brain.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from ..jobs.telemetry import Subscription
from ..process.whole_file import write_whole
from ..shared.domain.errors import Failure
from ..shared.domain.model import Point

if TYPE_CHECKING:
    from ..jobs.telemetry import Telemetry
    from ..shared.domain.errors import FlightFailed

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
    when: float = 0.0
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
        self._before = _kept(path)
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
                drones[drone] = replace(state, when=round(clock - known.silence, 1))
        with suppress(OSError):  # on a full disk drones fly on; retried at the next update
            _keep(self._path, drones)

    def _state(self, drone: str, known: Telemetry) -> Sighting | None:
        """Return a drone's state without its time; None: it has no telemetry yet."""
        if not isfinite(known.silence):
            return None
        x, y, z = known.location
        down = self._down(drone)
        return Sighting(
            at=(round(x, 3), round(y, 3), round(z, 3)),
            battery=round(known.battery_level, 3),
            landed=known.landed and drone not in self._leaving,
            why="" if down is None else str(down),
            crashed=down is not None and down.failure is Failure.CRASH,
        )


def sightings_in(folder: Path) -> dict[str, Sighting]:
    """Return the last known states of the drones of a gateway's folder."""
    return _kept(folder / SEEN)


def at_home(folder: Path, homes: Mapping[str, Point]) -> None:
    """Store the initial places of simulated drones that have no state yet."""
    now = time.time()
    known = {
        drone: Sighting(at=home, battery=1.0, landed=True, when=now)
        for drone, home in homes.items()
    }
    _keep(folder / SEEN, known | sightings_in(folder))


def _keep(path: Path, drones: Mapping[str, Sighting]) -> None:
    write_whole(path, msgspec.json.encode(drones))


def _kept(path: Path) -> dict[str, Sighting]:
    with suppress(OSError, ValueError):  # not one of our files: nothing is known
        return msgspec.json.decode(path.read_bytes(), type=dict[str, Sighting])
    return {}
