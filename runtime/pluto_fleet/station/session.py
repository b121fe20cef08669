"""The current flight of a station."""

from __future__ import annotations

import asyncio
import json
import traceback
from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import closing, suppress
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..flight.config import End, FlightSetup, Stops
from ..flight.live_flight import FlightObserver
from ..flight.lives import run_flight
from ..flight.mission_status import records_in
from ..journal.errors import JournalError
from ..journal.lock import holder
from ..journal.place import written
from ..journal.reader import Reader
from ..journal.standing import Standing
from ..shared import output
from ..shared.domain.errors import ANY_ERROR, BadInput
from . import rows
from .attention import (
    Cause,
    Waits,
    of_batteries,
    of_drones,
    of_missions,
    of_reserves,
    of_results,
    of_waiting,
)
from .between_flights import IdleDrones
from .feed import Feed, VersionedRows
from .plan.in_flight import settled
from .plan.shape import BROKEN_OFF
from .results.meaning import SIMULATED_UNITS
from .results.rows import NameOf, nowhere
from .sight import Sight

if TYPE_CHECKING:
    from ..flight.live_flight import LiveFlight
    from ..flight.recorded_flight import RecordedFlight
    from ..journal.store import Store
    from ..shared.domain.trace import Event
    from .wire import Alert, DroneRow, LineKind, MissionRow, State


class Phase(Enum):
    """The phase of a station: whether anything flies, and what can be done next."""

    IDLE = "idle"
    FLYING = "flying"
    STOPPING = "stopping"
    """All drones are coming down."""
    STOPPED = "stopped"
    """It was stopped: it can be resumed, or discarded."""
    INTERRUPTED = "interrupted"
    """It has ended unexpectedly: it can be resumed, or discarded."""
    OVER = "over"


def phase_of(session: FlightSession | None) -> Phase:
    """Return the phase of a flight."""
    if session is None:
        return Phase.IDLE
    if session.lives:
        return Phase.STOPPING if session.stops.asked is not None else Phase.FLYING
    if session.trouble:
        return Phase.INTERRUPTED
    match session.end:
        case End.OVER:
            return Phase.OVER
        case End.STOPPED:
            return Phase.STOPPED
    was_stopped = session.records is not None and session.records.stopped
    return Phase.STOPPED if was_stopped else Phase.INTERRUPTED


class FlightSession:
    """A journal, the run that writes it, and its data for pages."""

    def __init__(
        self,
        flight: FlightSetup,
        ended: Callable[[], object],
        seen: Callable[[], object],
        heard: Callable[[Event], object] = lambda _: None,
        known: Standing | None = None,
        name_of: NameOf = nowhere,
    ) -> None:
        """`ended` is called when the run has ended, `seen` at each update of telemetry, `heard` with each
        event once it is durable.

        `known` has the drones' states before the first record; `name_of` says what a place is called.
        """
        self.flight = flight
        self.id = flight.journal.stem
        units = SIMULATED_UNITS if flight.sim else {}
        self.feed = Feed(flight.app, units, self.id, name_of)
        self.missions: VersionedRows[MissionRow] = VersionedRows()
        self.drones: VersionedRows[DroneRow] = VersionedRows()
        self.tracks = 0, "[]"
        """The version of the last change of what is tracked, and all of it as JSON."""
        self._seen_at: dict[str, float] = {}
        """When each of that was reported last."""
        self.stops = Stops()
        self.one: LiveFlight | None = None
        self.records: Standing | None = known
        """The journal's records when it was last read."""
        self.end: End | None = None
        """How the last run ended; None: it has not, or its process died."""
        self.trouble = ""
        """Why it could not be resumed."""
        self.task: asyncio.Task[None] | None = None
        self._ended = ended
        self._seen = seen
        self._heard = heard
        self._idle = IdleDrones(flight.fleet.drones, flight.journal)
        self._sight = Sight(flight)
        self._waits = Waits()
        self._left_at = 0.0
        self._leaves = False
        """Whether it has just ended."""
        self._read_at: int | None = None
        """The journal's modification time when it was last read."""

    @property
    def journal(self) -> Path:
        """The path of the journal."""
        return self.flight.journal

    @property
    def lives(self) -> bool:
        """Whether it is running."""
        return self.task is not None and not self.task.done()

    @property
    def life(self) -> RecordedFlight | None:
        """The recorded flight, if the gateway is connected."""
        return self.one.life if self.one is not None else None

    @property
    def known(self) -> Standing | None:
        """The present records."""
        return self.life.recorder.standing if self.life is not None else self.records

    @property
    def names(self) -> set[str]:
        """The names of its missions."""
        if self.life is not None and self.life.is_set_out:
            return {*self.life.records.missions}
        known = self.records.missions if self.records is not None else {}
        return {*known} or {mission.name for mission in self.flight.missions}

    @property
    def ends(self) -> dict[str, str]:
        """The final statuses of its missions."""
        known = self.known.missions if self.known is not None else {}
        return {
            name: str(record["status"]) if record["ended"] else BROKEN_OFF
            for name, record in known.items()
        }

    @property
    def done(self) -> dict[str, list[str]]:
        """The trips of its missions that were done, or left out by a decision."""
        known = self.known.missions if self.known is not None else {}
        return {name: settled(record) for name, record in known.items()}

    def read(self, records: Standing) -> None:
        """Show the journal of a run that has ended."""
        self.records = records
        with closing(Reader(self.flight.journal)) as reader, suppress(JournalError):
            for _, event in reader.events():
                self.feed.take(event)

    def begin(self, store: Store, records: Standing | None) -> None:
        """Run it, from its beginning or from its records."""
        self.end, self.trouble, self.stops = None, "", Stops()
        self.task = asyncio.create_task(self._live(store, records))
        self.task.add_done_callback(lambda _: self._ended())

    async def _live(self, store: Store, records: Standing | None) -> None:
        observer = FlightObserver(tell=self._hear, say=self.say, born=self._born, patient=True)
        try:
            lived = await run_flight(self.flight, store, self.stops, records, observer)
        except BadInput as error:
            self.trouble = str(error)
        except (asyncio.CancelledError, KeyboardInterrupt, SystemExit):
            raise
        except ANY_ERROR as error:  # a bug: the drones land, and the page must say so
            output.tell("".join(traceback.format_exception(error)).rstrip())
            notes = " ".join(getattr(error, "__notes__", ()))
            self.trouble = f"internal error: {type(error).__name__}: {error} {notes}".strip()
        else:
            self.end, self.records = lived.end, lived.records
        finally:
            store.close()
            self._left_at = self.now
            self._leaves = True
            self.one = None
            if self.trouble:
                self.say(self.trouble)
                self._show_what_counts()

    def _show_what_counts(self) -> None:
        """Show the journal's records only: what could not be written has not happened."""
        with suppress(BadInput, OSError):
            self.records = records_in(self.flight.app, self.flight.journal)

    def _born(self, one: LiveFlight) -> None:
        self.records = self.known  # until the drones are connected again
        self.one = one
        one.on_telemetry(self._seen)

    def _hear(self, event: Event) -> None:
        """Update the pages outside of the current instant, so that errors there cannot affect the flight."""
        loop = asyncio.get_running_loop()
        loop.call_soon(self.feed.take, event)
        loop.call_soon(self._heard, event)

    def say(self, text: str, kind: LineKind = "bad") -> None:
        """Tell users on the console what they should know of it."""
        self._sight.say(self.life, self.now, text, kind)
        self.feed.say(self.now, text, kind)

    @property
    def now(self) -> float:
        """Seconds since its beginning, in its own time."""
        if self.life is not None:
            return self.life.kernel.time()
        known = self.records.time if self.records is not None else 0.0
        return max(
            known, self._left_at
        )  # the time must not go back for pages that saw the drones landed

    # Data for pages

    def look(self, number: int) -> bool:
        """Update the rows with this version; return whether anything has changed."""
        self._look_into_the_journal()
        changed = [self._see_missions(number), self._see_drones(number), self.feed.look(number)]
        return any(changed) | self._see_tracks(number)

    def _look_into_the_journal(self) -> None:
        """Read the journal again if it has changed, as a command may have brought a drone back."""
        if self.lives:
            self._read_at = None
            return
        with suppress(OSError):
            if self._read_at not in (None, written(self.journal)):
                if holder(self.journal) is not None:  # read again when that process has ended
                    return
                self._show_what_counts()
            if self._idle.write_down(self.flight.app, self.records):
                self._show_what_counts()
            self._read_at = written(self.journal)

    def _see_missions(self, number: int) -> bool:
        life, put, changed = self.life, self.missions.put, False
        if life is not None and life.is_set_out:
            for row in self._sight.missions(life):
                changed |= put(row["name"], row, number)
        elif self.records is not None:
            for name, record in self.records.missions.items():
                changed |= put(name, rows.recorded_row(name, record), number)
        return changed

    def _see_drones(self, number: int) -> bool:
        put, changed = self.drones.put, False
        life = self.life
        for row in self._idle.rows(self.records) if life is None else self._sight.drones(life):
            changed |= put(row["id"], row, number)
        return changed

    def _see_tracks(self, number: int) -> bool:
        life = self.life
        tracked = {} if life is None else dict(life.tracked.now(self.now))
        seen_at = {id: one.seen for id, one in tracked.items()}
        if seen_at == self._seen_at:
            return False
        self._seen_at = seen_at
        self.tracks = number, json.dumps([rows.track_row(*one) for one in tracked.items()])
        return True

    def note(self, now: float, state: State, alerts: Iterable[Alert]) -> None:
        """Have the journal say what is shown."""
        rows: Any = {"missions": self.missions, "drones": self.drones, "alerts": alerts}
        if self.life is not None:
            self._sight.note(self.life, now, state, **rows)
        elif self._leaves:
            self._leaves = False
            self._sight.leave(self.journal, now, state, **rows)

    def causes(self) -> Iterator[Cause]:
        """Yield what a person must know of, as the rows are now."""
        drones = list(self.drones)
        long = self._waits.look(self.missions, self.now) if self.lives else 0
        yield from of_drones(drones, self.crashed(drones))
        yield from of_missions(self.missions)
        yield from of_results(self.feed.findings)
        yield from of_reserves(self.feed.drained)
        if self.lives:
            yield from of_batteries(drones, self._waits.any)
            cause = of_waiting(long, drones, self._sight.waiting.takes) if long else None
            if cause is not None:
                yield cause

    def crashed(self, drones: Sequence[DroneRow]) -> Collection[str]:
        """Return the lost drones of which the gateway knows that they fell."""
        lost = [row["id"] for row in drones if row["status"] == "LOST"]
        return self._idle.crashed() if lost else ()
