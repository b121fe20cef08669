"""One run of an app in real time, with its connections to the outside.

These are the journal, which a thread writes, the gateway to the drones, and commands, which may arrive
at any moment.
"""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Callable, Coroutine, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from ..files.fleet import with_joined
from ..jobs.link import UNCERTAIN
from ..jobs.reports import Down
from ..journal.copies import EVERY
from ..journal.errors import TROUBLE, JournalError
from ..journal.place import commands_note
from ..journal.writer import Writer
from ..process.hook_runner import RealHooks
from ..process.realtime import RealTime
from ..process.wall_clock import WallClock
from ..shared.domain.errors import BadInput, Cancelled
from ..shared.time.kernel import FLEET, Future
from .commands import hear_commands, joining_in, perform, stop_in
from .config import End, FlightResult
from .recorded_flight import RecordedFlight
from .waits import Waits

if TYPE_CHECKING:
    from ..jobs.link import Link
    from ..journal.standing import Standing
    from ..journal.store import Store
    from ..shared.domain.trace import Event
    from ..shared.time.kernel import Task
    from .access import GatewayAccess
    from .config import FlightSetup, Stops


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightObserver:
    """Callbacks for what happens in a flight."""

    tell: Callable[[Event], object]
    """Called with each event, once it is durable."""
    say: Callable[[str], object]
    """Called with messages that are not events, such as that a gateway has died."""
    born: Callable[[LiveFlight], object] | None = None
    """Called with each run when it begins."""
    patient: bool = False
    """Whether the flight goes on while a mission waits for the user's decision."""


LOOK_EVERY = 1.0
"""Seconds of real time between two checks that the journal is still there."""

_ENDED = "the app ended before it could say whether that was done: look, once it goes on"


class LiveFlight:
    """Runs from the first report of the drones to the end."""

    def __init__(
        self,
        flight: FlightSetup,
        observer: FlightObserver,
        access: GatewayAccess,
        store: Store,
        records: Standing,
        begin: float,
    ) -> None:
        """`begin` is the time in the flight at which this run begins."""
        self._flight = flight
        self._observer = observer
        self._access = access
        self._store = store
        self._loop = asyncio.get_running_loop()
        self._kernel = RealTime(flight.speed, begin)
        self._clock = WallClock(self._kernel, records.clock)
        self._records = records
        self._writer = Writer(store, partial(self._post, self._durable), self._unwritable)
        self._stops: Stops | None = None
        self._link: Link | None = None
        self._watcher: Callable[[], object] | None = None
        self.life: RecordedFlight | None = None
        """The recorded flight, once the gateway is connected."""
        self._end: Future[End] = Future()
        self._failure: JournalError | None = None
        self._copied = time.monotonic()
        """When the journal was copied last."""
        self._copying: asyncio.Future[None] | None = None
        """The copy being made, by a thread of its own, since it may take long."""
        self._kept: asyncio.Future[bool] = self._loop.create_future()
        """Set at the end: whether all commands have taken effect and are durable."""

    async def live(self, stops: Stops) -> FlightResult:
        """Run until all missions have ended, it is stopped, or the gateway dies."""
        flight = self._flight
        kernel = self._kernel
        self._stops = stops
        lost = partial(self._end.set, End.LOST)
        fleet = with_joined(flight.app, flight.fleet, self._records.joined)
        self._link = link = await self._access.link(kernel, fleet, self._store.epoch, lost)
        link.seen = self._seen
        hooks = RealHooks(kernel)
        self.life = life = RecordedFlight(
            flight.app,
            fleet,
            kernel,
            link,
            self._writer,
            self._records,
            epoch=self._store.epoch,
            watcher=self._observer.tell,
            hooks=hooks,
            clock=self._clock,
            charges=flight.charges,
        )
        life.driver.drift = self._drifted
        hooks.ended, hooks.stir = life.hook_ended, life.driver.pump
        life.patient = self._observer.patient
        life.carried_home = flight.sim
        life.in_simulation = flight.in_simulation
        life.control.stopped.watch(lambda _: self._end.set(End.STOPPED))
        stops.stop_now = self._stop
        async with hear_commands(commands_note(flight.journal), self.answer):
            looks = asyncio.create_task(self._looks())
            try:
                end = await self._lived(life, stops)
            except BadInput:  # no drone is ready: end the gateway as well
                await link.goodbye()
                raise
            finally:  # answer the clients that still wait
                looks.cancel()
                self._kept.set_result(self._end.is_set and self._end.result() is End.OVER)
        if end is not End.LOST:
            await link.goodbye()
        if self._failure is not None:
            raise self._failure
        return FlightResult(
            end=end,
            missions=life.missions,
            drones=life.drones,
            records=self._records,
        )

    async def _lived(self, life: RecordedFlight, stops: Stops) -> End:
        """Run to some end, and make everything durable."""
        over = life.go_on(self._flight.missions)
        over.watch(self._over)
        self._copy()
        self._kernel.spawn(Waits(life).watch(), FLEET, "what waits")
        if stops.asked is not None:
            stops.stop(stops.asked)
        end = await self._kernel.run(self._end)
        if end is End.OVER:
            over.result()  # raises its error
        if self._failure is None:
            life.recorder.finish()
            try:
                self._writer.flush()
            except JournalError as failure:
                self._failure = failure
            self._kernel.post(self._durable, self._store.seq)
        return end

    def on_telemetry(self, watcher: Callable[[], object]) -> None:
        """Call this at each update of the telemetry."""
        self._watcher = watcher

    def _seen(self) -> None:
        """Called at each update of the telemetry."""
        if self.life is not None:
            self.life.driver.look()
        if self._watcher is not None:
            self._watcher()

    async def close(self) -> None:
        """End this run; the drones hover, or continue their jobs."""
        if self.life is not None:
            self.life.halt()
        self._kernel.close()
        self._writer.close()
        if self._link is not None:
            await self._link.close()
        if self._copying is not None:
            await self._copying

    def _stop(self, how: Down) -> None:
        """Stop, unless everything has ended."""
        if self.life is not None and not self._end.is_set:
            self._kernel.post(self.life.control.stop, how)

    def _over(self, over: Task[float]) -> None:
        if not isinstance(over.error, Cancelled):  # as it is by a stop
            self._end.set(End.OVER)

    # Events, to the journal and back

    def _durable(self, number: int) -> None:
        if self.life is not None:
            self.life.recorder.durable(number)

    def _post(self, call: Callable[..., object], *args: object) -> None:
        """Call this within the kernel; used by other threads."""
        with suppress(RuntimeError):  # the loop is closed: the run has ended
            self._loop.call_soon_threadsafe(self._kernel.post, call, *args)

    async def _looks(self) -> None:
        """Check now and then that the journal is still there, even if nothing is written."""
        while self._failure is None:
            await asyncio.sleep(LOOK_EVERY)
            try:
                self._store.look()
            except JournalError as failure:
                self._unwritable(failure)
            if time.monotonic() - self._copied > EVERY:
                self._copy()
            if self.life is not None and self._clock.moved():
                self._kernel.post(self.life.driver.ask_for_the_hour)

    def _copy(self) -> None:
        self._copied = time.monotonic()
        self._copying = self._loop.run_in_executor(None, self._copy_now)

    def _copy_now(self) -> None:
        with suppress(OSError, *TROUBLE):  # a full disk: the journal itself is what counts
            self._store.copy()

    def _drifted(self) -> float | None:
        """Return how far the clock of the hours has drifted, and record it, if that is news."""
        self._clock.moved()
        life = self.life
        drift = self._clock.drift
        if life is None or not life.is_set_out or life.records.clock["drift"] == drift:
            return None
        by = drift - life.records.clock["drift"]
        life.recorder.fact("clock", {**life.records.clock, "drift": drift})
        life.note("clock.moved", by=by, drift=drift)
        return drift

    def _unwritable(self, failure: JournalError) -> None:
        """Bring everything down, and say why: the journal cannot be written any more."""
        if self._failure is None:
            self._failure = failure
            self._post(self._stop_unrecorded)

    def _stop_unrecorded(self) -> None:
        if self.life is None:
            self._end.set(End.STOPPED)
        elif not self._end.is_set:
            self.life.control.stop(Down.LAND)
            why = f"{self._failure}; all drones land"
            last = {"t": round(self._kernel.now, 6), "event": "log", "mission": None, "text": why}
            self._store.last_words(json.dumps([last]))

    # Requests from outside

    async def answer(self, request: Mapping[str, object]) -> str:
        """Carry out a request at once; answer when its effect is durable.

        Raises `BadInput` if it cannot be done.
        """
        await self.prepare(request)
        return await self.carry_out(lambda life: perform(life.control, request), stop_in(request))

    async def prepare(self, request: Mapping[str, object]) -> None:
        """Have the gateway do its part of a command first; raise `BadInput` if it cannot.

        It takes in a drone that is to join, as a brain knows none that is not there; and a mishap
        happens to simulated drones.
        """
        life, link = self.life, self._link
        if life is None or link is None or self._end.is_set:
            return
        entry = joining_in(request)
        if entry is not None:
            joining = await self._access.joining(life.control.fleet_with(entry))
            await self._asked(link.ask("join", joining=joining), "a drone joins")
        match request:
            case {"command": "mishap"} if not self._flight.sim:
                raise BadInput("mishaps happen to drones that --sim simulates, and to no others")
            case {"command": "mishap", "drone": str(drone), "kind": str(kind)} if kind != UNCERTAIN:
                life.control.check_drone(drone)
                await self._asked(life.control.mishaps.happen(drone, kind), "a mishap")

    async def _asked(self, question: Coroutine[Any, Any, str], what: str) -> None:
        """Ask the gateway at once; raise `BadInput` with its reason why that cannot be."""
        asked: list[Task[str]] = []
        self._kernel.post(lambda: asked.append(self._kernel.spawn(question, FLEET, what)))
        why = await self._kernel.offer(asked[0])
        if why:
            raise BadInput(why)

    async def carry_out(
        self, what: Callable[[RecordedFlight], str], how: Down | None = None
    ) -> str:
        """Call this within the kernel, at once; return its answer when its effect is durable.

        `how`: it is a Stop, which is answered at once.
        """
        if how is not None and self._stops is not None:
            self._stops.asked = how  # if the gateway dies meanwhile, the next run stops, too
        if self._end.is_set:
            return self._too_late(how)
        said: list[str] = []
        refused: list[BadInput] = []
        done: list[Task[None]] = []

        def carry_out() -> None:
            assert self.life is not None
            try:
                said.append(what(self.life))
            except BadInput as error:
                refused.append(error)
            else:
                finished = self.life.control.carried_out()
                done.append(self._kernel.spawn(finished, FLEET, "an answer"))

        self._kernel.post(carry_out)
        if refused:
            raise refused[0]
        if how is None:
            await self._on_record(done)
        return said[0]

    def _too_late(self, how: Down | None) -> str:
        """Refuse a request after the end of this run, except a Stop."""
        if how is None:
            raise BadInput(_ENDED)
        if self._end.result() is End.LOST:
            return "stopping, as soon as another gateway is there"
        return "the app ends, and all drones are down"

    async def _on_record(self, done: Sequence[Task[None]]) -> None:
        """Wait until a command has taken effect and is durable; raise `BadInput` if that fails."""
        answers = [asyncio.ensure_future(self._kernel.offer(task)) for task in done]
        waits: list[asyncio.Future[Any]] = [*answers, self._kept]
        await asyncio.wait(waits, return_when=asyncio.FIRST_COMPLETED)
        for one in answers:
            one.cancel()
        is_known = self._kept.result() if self._kept.done() else all(task.is_set for task in done)
        if self._failure is not None or not is_known:
            raise BadInput(_ENDED)
