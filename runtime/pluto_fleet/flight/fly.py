"""Real time: runs an app, and runs it again from its journal when its gateway dies."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..gateway.starting import speed_in
from ..journal.place import gateway_folder
from .live_flight import LiveFlight

if TYPE_CHECKING:
    from ..journal.standing import Standing
    from ..journal.store import Store
    from .config import FlightConfig, FlightResult, Stops


@dataclass(frozen=True, slots=True, kw_only=True)
class Recovered:
    """The contents of a journal."""

    records: Standing
    written: float
    """When its last entry was written, in seconds since 1970."""

    def time(self, speed: float) -> float:
        """Return the present time in a run that resumes from there; `speed`: of the time in between."""
        if not self.records.missions:
            return self.records.time
        return self.records.time + max(0.0, time.time() - self.written) * speed


def recovered(store: Store) -> Recovered:
    """Read where everything stands by a journal; raise `BadInput` if it is not as this version writes it."""
    return Recovered(records=store.standing(), written=store.written)


async def live(
    setting: FlightConfig,
    store: Store,
    stops: Stops,
    known: Recovered | None = None,
    born: Callable[[LiveFlight], object] | None = None,
) -> FlightResult:
    """Run the app until all missions have ended, it is stopped, or its gateway dies.

    `known` is the journal's content, if it has been read already; `born` is called with the run.
    """
    known = known or recovered(store)
    meanwhile = speed_in(gateway_folder(store.path)) or setting.flight.speed
    one = LiveFlight(setting, store, known.records, known.time(meanwhile))
    if born is not None:
        born(one)
    try:
        return await one.live(stops)
    finally:
        stops.stop_now = None
        await one.close()
