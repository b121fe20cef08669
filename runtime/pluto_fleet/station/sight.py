"""What there is to see of a flight that lives: rows of its missions and drones, noted in its journal."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import closing, suppress
from math import floor, isfinite
from typing import TYPE_CHECKING, Any

from ..flight.mission_status import in_order
from ..gateway.wire import STALE_AFTER
from ..journal.facts import SAID, SHOWN
from ..journal.store import Entry, Store
from ..shared.domain.errors import BadInput
from . import rows
from .shown import MOVING, Noted
from .wait_reasons import WaitReasons

if TYPE_CHECKING:
    from pathlib import Path

    from ..flight.config import FlightSetup, Stops
    from ..flight.live_flight import LiveFlight
    from ..flight.recorded_flight import RecordedFlight
    from .wire import DroneRow, LineKind, MissionRow

KEEP_EVERY = 2.0
"""Seconds after which what was noted is given to the disk, though no event has taken it along."""

LOOK_NO_SOONER = 0.25
"""Seconds between two looks at a flight of which no station shows anything, which is looked at once in a second of its time."""

SHARE = 50
"""A look is followed by a pause of as many times its length, so that large plans cost no more."""


class Sight:
    """What there is to see of one flight, run after run."""

    def __init__(self, flight: FlightSetup) -> None:
        self._app = flight.app
        self.waiting = WaitReasons(flight.app, flight.fleet, time.monotonic)
        """Why missions wait for drones."""
        self._life: RecordedFlight | None = None
        """The run of which something was noted last."""
        self._noted = Noted(MOVING)
        self._unsaid: list[Mapping[str, object]] = []
        """Lines that were said while no run could write them down."""
        self._kept_at = 0.0

    def missions(self, life: RecordedFlight) -> Iterator[MissionRow]:
        """Yield the rows of all missions."""
        self.waiting.look(life.brain, life.fleet)
        now = life.kernel.time()
        why = self.waiting.why
        missions = life.records.missions
        where = life.brain.whereabouts()
        for name, _ in in_order(life.records):
            yield rows.row_in_flight(name, missions, where, now, self._app, why)

    def drones(self, life: RecordedFlight) -> Iterator[DroneRow]:
        """Yield the rows of all drones."""
        where = life.brain.whereabouts()
        work = {one["drone"]: name for name, one in where.items() if one["drone"] is not None}
        for id, drone in life.brain.drones().items():
            low = self.waiting.why_low(drone)
            why = low or drone["unready"]
            status = "LOW" if low else ""
            silence = life.link.telemetry(id).silence
            heard = drone if isfinite(silence) else {**drone, "at": None, "battery": None}
            is_stale = isfinite(silence) and silence > STALE_AFTER
            yield rows.drone_row(
                id,
                heard,
                status=status,
                why=why,
                mission=work.get(id),
                seen=time.time() - silence if is_stale else None,
                ready_in=self.waiting.ready_in(id, drone, bool(low)),
            )

    def note(
        self,
        life: RecordedFlight,
        now: float,
        state: Mapping[str, Any],
        **shown: Iterable[Mapping[str, Any]],
    ) -> None:
        """Write down what is shown differently than before; rows must not change afterwards."""
        if life is not self._life:
            self._life = life
            self._noted = Noted(MOVING)
            for line in self._unsaid:
                life.recorder.measure(line)
            self._unsaid.clear()
        changes = self._noted.changes(state, shown)
        if changes:
            life.recorder.measure({"t": now, "event": SHOWN, **changes})
        if time.monotonic() - self._kept_at > KEEP_EVERY:
            self._kept_at = time.monotonic()
            life.recorder.finish()

    def say(self, life: RecordedFlight | None, now: float, text: str, kind: LineKind) -> None:
        """Write down a line of the console that is no event of the flight."""
        line = {"t": noted_at(now), "event": SAID, "text": text, "kind": kind}
        if life is None or life.driver.halted:
            self._unsaid.append(line)
        else:
            life.recorder.measure(line)

    def leave(
        self,
        journal: Path,
        now: float,
        state: Mapping[str, Any],
        **shown: Iterable[Mapping[str, Any]],
    ) -> None:
        """Write down how a flight is shown that has ended, and what no run has written down."""
        changes = self._noted.changes(state, shown)
        lines = [*self._unsaid, {"t": now, "event": SHOWN, **changes}]
        self._unsaid.clear()
        with suppress(BadInput), closing(Store.open(journal)) as store:
            store.append([Entry(json.dumps(lines))])


def noting(flight: FlightSetup, stops: Stops) -> Callable[[LiveFlight], None]:
    """Return what notes what there is to see of the runs of a flight which no station shows."""
    sight = Sight(flight)
    due = 0.0

    def look(one: LiveFlight) -> None:
        nonlocal due
        life = one.life
        begun = time.monotonic()
        if life is None or begun < due:
            return
        if life.is_set_out:
            how = stops.asked
            state = {
                "phase": "flying" if how is None else "stopping",
                "plan": 0,
                "map": 0,
                "fleet": len(life.fleet.drones),
                "said": "",
                "how": None if how is None else how.value,
                "busy": "",
            }
            now = noted_at(life.kernel.time())
            sight.note(life, now, state, missions=sight.missions(life), drones=sight.drones(life))
        ended = time.monotonic()
        due = ended + max(LOOK_NO_SOONER, 1.0 / flight.speed, SHARE * (ended - begun))

    return lambda one: one.on_telemetry(lambda: look(one))


def noted_at(now: float) -> float:
    """Return a time in milliseconds, no later than it is: what happens next comes after it in the journal."""
    return floor(now * 1000) / 1000
