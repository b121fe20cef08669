"""Updates for pages: the station is sampled ten times a second, once for all pages.

A page sends the version that it has, and gets the changes since, as soon as there are any. So a page that does
not read costs nothing, and gets the newest state when it does.
"""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Iterable
from typing import TYPE_CHECKING, Protocol

from .feed import VersionedRows
from .session import phase_of

if TYPE_CHECKING:
    from .between_flights import FleetHistory
    from .map.drawn import DrawnMap
    from .plan.plan import MissionPlan
    from .session import FlightSession

LOOK_EVERY = 0.12
"""The sampling interval in seconds, unless a change is announced."""

LOOK_NO_SOONER = 0.08
"""The shortest sampling interval in seconds, however much changes."""

ANSWER_WITHIN = 1.0
"""Seconds after which a page is answered even without changes."""


class StationState(Protocol):
    """The data of a station that pages show."""

    described: dict[str, object]
    session: FlightSession | None
    plan: MissionPlan
    map: DrawnMap
    history: FleetHistory


class Updates:
    """The newest state of a station, with the versions of its parts."""

    def __init__(self, station: StationState) -> None:
        self._station = station
        self._number, self._state = 0, ""
        self.drones = VersionedRows()
        """The drones' rows while there is no flight."""
        self._tick: asyncio.Future[None] | None = None
        self._timer: asyncio.Handle | None = None
        self._ticked_at = 0.0

    async def newer(self, flight: str, seen: int, log: int, results: int) -> str:
        """Return what has changed since a page looked, as soon as anything has, or in a second."""
        loop = asyncio.get_running_loop()
        until = loop.time() + ANSWER_WITHIN
        while True:
            await self._next_tick()
            session = self._station.session
            if (session.id if session is not None else "") != flight:
                return self._told(session, 0, 0, 0)
            new = seen < self._number
            if session is not None:
                new |= log < session.feed.log.last or results < session.feed.results.last
            if new or loop.time() >= until:
                return self._told(session, seen, log, results)

    async def _next_tick(self) -> None:
        """Wait for the next sample, which all pages share."""
        loop = asyncio.get_running_loop()
        if self._tick is None:
            self._tick = loop.create_future()
            self._timer = loop.call_at(self._ticked_at + LOOK_EVERY, self._look)
        await asyncio.shield(self._tick)

    def hurry(self) -> None:
        """Sample soon: there is new telemetry.

        Not within this call, so that errors of the display cannot affect the flight.
        """
        loop = asyncio.get_running_loop()
        if self._timer is not None and loop.time() - self._ticked_at >= LOOK_NO_SOONER:
            self._timer.cancel()
            self._timer = loop.call_soon(self._look)

    def _look(self) -> None:
        tick, self._tick = self._tick, None
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None
        self._ticked_at = asyncio.get_running_loop().time()
        try:
            self._note_what_is_new()
        finally:  # pages are answered even if a sample has failed
            if tick is not None:
                tick.set_result(None)

    def _note_what_is_new(self) -> None:
        number = self._number + 1
        session, state = self._station.session, self._state_now()
        changed = state != self._state
        self._state = state
        if session is not None:
            changed |= session.look(number)
        else:
            for row in self._station.history.rows():
                changed |= self.drones.put(str(row["id"]), row, number)
        if changed:
            self._number = number

    def _state_now(self) -> str:
        session = self._station.session
        how = session.stops.asked if session is not None and session.lives else None
        return json.dumps(
            {
                "phase": phase_of(session).value,
                "journal": str(session.journal) if session is not None else None,
                "plan": self._station.plan.revision,
                "map": self._station.map.revision,
                "said": (session.trouble if session is not None else "")
                or self._station.plan.trouble,
                "how": how.value if how is not None else None,
                "busy": _busy(session),
            }
        )

    def _told(self, session: FlightSession | None, seen: int, log: int, results: int) -> str:
        parts = {
            "server": json.dumps(self._station.described["server"]),
            "n": str(self._number),
            "made": str(round(time.time() * 1000)),
            "flight": json.dumps(session.id if session is not None else ""),
            "state": f'{{"time": {session.now if session else 0.0:.3f}, {self._state[1:]}',
            "missions": _listed(session.missions.since(seen) if session else ()),
            "drones": _listed((session or self).drones.since(seen)),
            "log": _listed(session.feed.log.since(log) if session else ()),
            "results": _listed(session.feed.results.since(results) if session else ()),
        }
        return "{" + ", ".join(f'"{name}": {text}' for name, text in parts.items()) + "}"


def _busy(session: FlightSession | None) -> str:
    """Return what all missions wait for."""
    if session is None or not session.lives:
        return ""
    if session.life is None:
        return "looking for the drones"
    return "" if session.life.is_set_out else "asking the drones where they are"


def _listed(texts: Iterable[str]) -> str:
    return f"[{', '.join(texts)}]"
