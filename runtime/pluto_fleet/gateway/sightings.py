"""Where each drone was heard of last: kept on the disk, for who looks when nobody commands them.

A brain knows where its drones are while it lives. After a Stop, a crash or a kill the gateway is the
last that hears of them: so it is the gateway that writes it down, also while no brain is there.
"""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
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
    """Writes down how all drones are, as long as somebody hears of them."""

    def __init__(
        self,
        path: Path,
        drones: Sequence[str],
        telemetry: Callable[[str], Telemetry],
        *,
        down: Callable[[str], FlightFailed | None] = _well,
        speed: float = 1.0,
        clock: Callable[[], float] = time.time,
    ) -> None:
        """Begin; `down` says why a drone takes no commands, if it takes none."""
        self._path, self._drones, self._telemetry = path, tuple(drones), telemetry
        self._down = down
        self._clock, self._quiet, self._kept = clock, 0, dict[str, list[Any]]()
        self._before, self._each = _told(path), max(SHORTEST, EACH / speed)
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

    async def watch(self) -> None:
        """Look again and again, until nobody wants that any longer."""
        while True:
            self.look()
            await asyncio.sleep(self._each)

    def look(self) -> None:
        """Write down what has changed, if anything has."""
        self._quiet += 1
        if self._quiet >= ANEW or self._now() != self._kept:
            self.keep()

    def keep(self) -> None:
        """Write down how all drones are; of one that is not heard of, what was known before."""
        now, clock = self._now(), self._clock()
        drones = self._before | {
            drone: [*how, round(clock - self._telemetry(drone).silence, 1), *down]
            for drone, (*how, down) in now.items()
        }
        part = self._path.with_name(f".{self._path.name}.part")
        with suppress(OSError):  # on a full disk drones fly on; the next look is another chance
            part.write_text(json.dumps(drones), encoding="utf-8")
            part.replace(self._path)
            self._kept, self._quiet = now, 0

    def _now(self) -> dict[str, list[Any]]:
        found: dict[str, list[Any]] = {}
        for drone in self._drones:
            one = self._telemetry(drone)
            if isfinite(one.silence):
                place = [round(metres, 3) for metres in one.location]
                landed = one.landed and drone not in self._leaving
                down = self._down(drone)
                why = [] if down is None else [down.failure.value, str(down)]
                found[drone] = [place, round(one.battery_level, 3), landed, why]
        return found


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
