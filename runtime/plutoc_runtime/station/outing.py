"""One flight of the station, from its Start to its end: lived, stopped, gone on with."""

from __future__ import annotations

import asyncio
import json
import traceback
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from contextlib import closing, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from ..cli import output
from ..cli.flights import Flight, Watcher, lives
from ..cli.flown import records_in
from ..errors import BadInput
from ..journal.reader import Reader
from ..kernel import WHATEVER
from ..setting import End, Stops
from ..status import DroneStatus
from . import rows
from .feed import Feed
from .versions import Versions

if TYPE_CHECKING:
    from ..fly import Recovered
    from ..journal.fold import Records
    from ..journal.store import Store
    from ..life import Life
    from ..one_life import OneLife
    from ..trace import Event

FLEET_EACH = 3.0
"""Seconds after which those who wait are told anew what the drones are doing."""


class Outing:
    """A journal, whoever lives it, and what everybody sees of it."""

    def __init__(
        self, flight: Flight, ended: Callable[[], object], seen: Callable[[], object]
    ) -> None:
        """Begin; `seen` is called when drones were heard of, `ended` when it lives no more."""
        self.flight = flight
        self.id = flight.journal.name
        self.feed = Feed()
        self.missions, self.drones = Versions(), Versions()
        self.stops = Stops()
        self.one: OneLife | None = None
        """What is lived now."""
        self.records: Records | None = None
        """What the journal said when it was read last."""
        self.end: End | None = None
        """How it ended the last time; None: it has not, or its process died."""
        self.trouble = ""
        """Why it could not go on."""
        self.task: asyncio.Task[None] | None = None
        self._ended, self._seen = ended, seen
        self._last_seen = self._drones_at_home(())
        self._fleet: dict[str, str] = {}
        self._fleet_at = -FLEET_EACH
        self._left_at = 0.0

    @property
    def journal(self) -> Path:
        """Where it is written down."""
        return self.flight.journal

    @property
    def lives(self) -> bool:
        """Whether it goes on now."""
        return self.task is not None and not self.task.done()

    @property
    def life(self) -> Life | None:
        """What is lived now, if the drones can be reached."""
        return self.one.life if self.one is not None else None

    @property
    def names(self) -> set[str]:
        """The missions that it has."""
        if self.life is not None and self.life.missions:
            return {mission.name for mission in self.life.missions}
        known = self.records.missions if self.records is not None else {}
        return {*known} or {mission.name for mission in self.flight.missions}

    def read(self, known: Recovered) -> None:
        """Show what a journal says that nobody lives."""
        self.records = known.records
        self._last_seen = self._drones_at_home(known.records.retired)
        with closing(Reader(self.flight.journal)) as reader:
            for row in reader.rows():
                for event in json.loads(row.text):
                    self.feed.take(event)

    def begin(self, store: Store, known: Recovered | None) -> None:
        """Let it live, from its beginning or from what is known."""
        self.end, self.trouble, self.stops = None, "", Stops()
        self.task = asyncio.create_task(self._live(store, known))
        self.task.add_done_callback(lambda _: self._ended())

    async def _live(self, store: Store, known: Recovered | None) -> None:
        watcher = Watcher(tell=self._hear, say=self._say, born=self._born, patient=True)
        try:
            lived = await lives(self.flight, store, self.stops, known, watcher)
        except BadInput as error:
            self.trouble = str(error)
        except (asyncio.CancelledError, KeyboardInterrupt, SystemExit):
            raise
        except WHATEVER as error:  # a mistake of ours: the drones land, and the page must say so
            output.tell("".join(traceback.format_exception(error)).rstrip())
            notes = " ".join(getattr(error, "__notes__", ()))
            self.trouble = f"internal error: {type(error).__name__}: {error} {notes}".strip()
        else:
            self.end, self.records = lived.end, lived.records
        finally:
            store.close()
            self._last_seen, self._left_at = self._drones_at_the_end(), self.now
            self.one = None
            if self.trouble:
                self._say(self.trouble, "bad")
                self._show_what_counts()

    def _show_what_counts(self) -> None:
        """What could not be written down has not happened: show what the journal says."""
        with suppress(BadInput, OSError):
            self.records = records_in(self.flight.app, self.flight.journal)

    def _born(self, one: OneLife) -> None:
        self.one = one
        one.when_seen(self._seen)

    def _hear(self, event: Event) -> None:
        """Tell everybody, but not within the instant that flies: it must not fall by a console."""
        asyncio.get_running_loop().call_soon(self.feed.take, event)

    def _say(self, text: str, kind: str = "bad") -> None:
        self.feed.say(self.now, text, kind)

    @property
    def now(self) -> float:
        """Seconds since it first began, in its own time."""
        if self.life is not None:
            return self.life.session.core.kernel.time()
        known = self.records.time if self.records is not None else 0.0
        return max(known, self._left_at)  # that of those who saw the drones down does not go back

    # What everybody sees

    def look(self, number: int) -> bool:
        """Note what has changed, under this number; say whether anything has."""
        return any([self._see_missions(number), self._see_drones(number)])

    def _see_missions(self, number: int) -> bool:
        life, put, changed = self.life, self.missions.put, False
        if life is not None and life.missions:
            states = {state.mission.name: state for state in life.session.engine.states}
            now, fleet, app = self.now, self._what_the_fleet_does, self.flight.app
            for mission in life.missions:
                row = rows.mission_row(app, mission, states.get(mission.name), now, fleet)
                changed |= put(mission.name, row, number)
        elif self.records is not None:
            for name, record in self.records.missions.items():
                changed |= put(name, rows.recorded_row(name, record), number)
        return changed

    def _see_drones(self, number: int) -> bool:
        put, changed = self.drones.put, False
        for row in self._last_seen if self.life is None else self._drones_now(self.life):
            changed |= put(str(row["id"]), row, number)
        return changed

    def _drones_now(self, life: Life) -> Iterator[rows.Row]:
        work = rows.mission_of_each(life.session.engine.states)
        fleet = life.session.core.fleet
        for drone in life.session.drones:
            why = fleet.unready.get(drone, "")
            yield rows.drone_row(drone, work.get(drone.id), drone in fleet.retired, why)

    def _drones_at_home(self, retired: Sequence[str]) -> list[rows.Row]:
        """Return where drones are of which nobody has heard as yet."""
        return [
            rows.drone_at(entry.id, entry.home, None, trips=0, retired=entry.id in retired)
            for entry in self.flight.fleet.drones
        ]

    def _drones_at_the_end(self) -> list[rows.Row]:
        """Return where the drones were seen last: from now on nobody hears of them."""
        if self.life is None:
            return self._last_seen
        retired = self.life.session.core.fleet.retired
        return [
            rows.drone_at(
                drone.id, drone.location, drone.battery_level, drone.trips, drone in retired
            )
            for drone in self.life.session.drones
        ]

    def _what_the_fleet_does(self, action: str) -> str:
        """Say why missions wait for drones; not anew at every look, for there may be many."""
        now = asyncio.get_running_loop().time()
        if now - self._fleet_at >= FLEET_EACH:
            self._fleet, self._fleet_at = {}, now
        if action not in self._fleet and self.life is not None:
            able = (one for one in self.life.session.drones if one.category.can(action))
            count = Counter(drone.status for drone in able)
            said = (f"{count[s]} {s.value.lower()}" for s in DroneStatus if count[s])
            self._fleet[action] = ", ".join(said)
        return self._fleet.get(action, "")
