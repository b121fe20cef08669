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
from .sight import noted_at

if TYPE_CHECKING:
    from ..files.fleet import FleetFile
    from .attention import Attention
    from .between_flights import FleetHistory
    from .map.drawn import DrawnMap
    from .plan.plan import MissionPlan
    from .session import FlightSession
    from .wire import Busy, DroneRow, State
    from .wire_app import AppData

LOOK_EVERY = 0.12
"""The sampling interval in seconds, unless a change is announced."""

LOOK_NO_SOONER = 0.08
"""The shortest sampling interval in seconds, however much changes."""

LOOK_UNSEEN = 1.0
"""The sampling interval in seconds while no page looks, so that alerts arise all the same."""

ANSWER_WITHIN = 1.0
"""Seconds after which a page is answered even without changes."""


RECORD_EVERY = 0.25
"""The sampling interval in seconds of a flight at which no page looks."""


class StationState(Protocol):
    """The data of a station that pages show."""

    described: AppData
    fleet: FleetFile
    session: FlightSession | None
    plan: MissionPlan
    map: DrawnMap
    history: FleetHistory
    attention: Attention


class Updates:
    """The newest state of a station, with the versions of its parts."""

    def __init__(self, station: StationState) -> None:
        self._station = station
        self._version = 0
        self._state: State | None = None
        self._now = 0.0
        """The flight's time at the last sample, which is when all of it was so."""
        self.drones: VersionedRows[DroneRow] = VersionedRows()
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
            new = seen < self._version
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

    async def watch(self, session: FlightSession) -> None:
        """Sample a flight until it ends, so that its journal says what was shown, whether or not a page looks."""
        while session.lives:
            await self._next_tick()
            await asyncio.sleep(RECORD_EVERY)

    def close(self) -> None:
        """Sample a flight once more that has just ended."""
        self._note_what_is_new()

    def hurry(self) -> None:
        """Sample soon: there is new telemetry.

        Not within this call, so that errors of the display cannot affect the flight.
        """
        loop = asyncio.get_running_loop()
        soonest = LOOK_NO_SOONER if self._timer is not None else LOOK_UNSEEN
        if loop.time() - self._ticked_at >= soonest:
            if self._timer is not None:
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
        version = self._version + 1
        session, state = self._station.session, self._state_at(0.0)  # time alone is no change
        self._now = noted_at(session.now) if session is not None else 0.0
        changed = state != self._state
        self._state = state
        if session is not None:
            changed |= session.look(version)
        else:
            for row in self._station.history.rows():
                changed |= self.drones.put(row["id"], row, version)
        causes = session.causes() if session else self._station.history.causes([*self.drones])
        flight = session.id if session is not None else ""
        changed |= self._station.attention.look(flight, causes, version)
        if changed:
            self._version = version
        if session is not None and (changed or not session.lives):
            session.note(self._now, state, self._station.attention.rows)

    def _state_at(self, now: float) -> State:
        session, plan = self._station.session, self._station.plan
        how = session.stops.asked if session is not None and session.lives else None
        return {
            "phase": phase_of(session).value,
            "time": round(now, 3),
            "plan": plan.revision,
            "map": self._station.map.revision,
            "fleet": len(self._station.fleet.drones),
            "said": (session.trouble if session is not None else "") or plan.trouble,
            "how": how.value if how is not None else None,
            "busy": _busy(session),
        }

    def _told(self, session: FlightSession | None, seen: int, log: int, results: int) -> str:
        """Return a `LiveMessage`, whose rows have been serialised once for all pages."""
        parts = {
            "server": json.dumps(self._station.described["server"]),
            "flight": json.dumps(session.id if session is not None else ""),
            "version": str(self._version),
            "made_at": str(round(time.time() * 1000)),
            "state": json.dumps(self._state_at(self._now)),
            "missions": _listed(session.missions.since(seen) if session else ()),
            "drones": _listed((session or self).drones.since(seen)),
            "log": _listed(session.feed.log.since(log) if session else ()),
            "results": _listed(session.feed.results.since(results) if session else ()),
            "amended": _listed(session.feed.amended_since(seen) if session else ()),
            "alerts": _listed(self._station.attention.rows.since(seen)),
            "events": _listed(session.feed.events.since(seen) if session else ()),
        }
        if session is not None and session.tracks[0] > seen:
            parts["tracks"] = session.tracks[1]
        return "{" + ", ".join(f'"{name}": {text}' for name, text in parts.items()) + "}"


def _busy(session: FlightSession | None) -> Busy:
    """Return what all missions wait for."""
    if session is None or not session.lives:
        return ""
    if session.life is None:
        return "connecting"
    return "" if session.life.is_set_out else "asking"


def _listed(texts: Iterable[str]) -> str:
    return f"[{', '.join(texts)}]"
