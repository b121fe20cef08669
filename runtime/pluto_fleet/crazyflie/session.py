"""One connection to one Crazyflie, from the opening of its link to its end; not reused.

cflib calls back from threads of its own, from which everything is passed to the event loop; all else in this
module runs in the loop, except for what `Worker` calls. Acknowledgements are a Crazyflie's answers to
commands, which cflib itself ignores.

A thread cannot be stopped from outside. One that hangs is abandoned: it is a daemon, so that the process can
end, and the drone gets a new one when it is reconnected.
"""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Callable
from concurrent.futures import Future
from contextlib import suppress
from functools import partial
from math import inf
from queue import SimpleQueue
from threading import Thread
from typing import TYPE_CHECKING, Protocol, TypeVar

from ..drones.protocol import Crashed, LinkLost, Locked, NavigationError
from ..drones.timeouts import Lag
from ..shared.domain.errors import ANY_ERROR
from . import messages
from .course import Course, Setpoint
from .driver import HIGH_LEVEL, SUPERVISOR, release_link
from .state import PositionConfidence, State

if TYPE_CHECKING:
    from cflib.crazyflie import Crazyflie as Cf
    from cflib.crtp.crtpstack import CRTPPacket


T = TypeVar("T")


class Worker:
    """A daemon thread that runs one call after the other; made and used in an event loop."""

    def __init__(self, drone: str) -> None:
        self._drone = drone
        self._jobs: SimpleQueue[Callable[[], None] | None] = SimpleQueue()
        self.stuck = False
        """Whether a call has not returned in time: further ones are refused."""
        self._thread = Thread(target=self._work, name=f"cflib for {drone}", daemon=True)
        self._thread.start()

    async def call(self, call: Callable[[], T], limit: float) -> T:
        """Run a call, and return its result; raise `LinkLost` after the time-out."""
        if self.stuck:
            raise LinkLost(messages.stuck(self._drone, limit))
        job: Future[T] = Future()
        self._jobs.put(partial(_run, job, call))
        answer = asyncio.wrap_future(job)
        try:
            await asyncio.wait({answer}, timeout=limit)
            if answer.done():
                return answer.result()
        finally:  # cancelled, too: it need not begin
            job.cancel()
            answer.cancel()
        self.stuck = True
        raise LinkLost(messages.stuck(self._drone, limit))

    def post(self, call: Callable[[], object]) -> None:
        def run() -> None:
            with suppress(Exception):
                call()

        self._jobs.put(run)

    def end(self) -> None:
        self._jobs.put(None)

    def _work(self) -> None:
        while (job := self._jobs.get()) is not None:
            job()


def _run(job: Future[T], call: Callable[[], T]) -> None:
    """Call what its caller still waits for."""
    if job.set_running_or_notify_cancel():
        try:
            job.set_result(call())
        except ANY_ERROR as error:
            job.set_exception(error)


_ANSWER = 0x80
"""The supervisor sets this bit in its answers."""
_COMMANDS = 1
"""The channel on which it takes commands."""

Key = tuple[int, int]
"""The port, and the number of the command."""


_LOOK = 0.1
"""Seconds between two checks for silence; as often a state is expected."""

FRESH = 0.5
"""The time-out of waiting for a new state, in seconds."""


class SessionObserver(Protocol):
    """Callbacks of a connection."""

    def told(self, state: State) -> None:
        """Called with a new state."""

    def doubted(self, variance: float) -> None:
        """Called with the variance of its position, in square metres."""

    def gone(self, why: str) -> None:
        """Called when the link is lost."""

    def releasing(self, gone: asyncio.Future[None]) -> None:
        """Called when the link is being closed, with a future of its end."""


class CrazyflieSession:
    """The state of a connected drone, and the only way to call cflib for it."""

    def __init__(self, drone: str, uri: str, observer: SessionObserver, silence: float) -> None:
        """`silence`: seconds without a state after which the link counts as lost."""
        self.drone = drone
        self.uri = uri
        self.silence = silence
        self.loop = asyncio.get_running_loop()
        self.worker = Worker(drone)
        self.established = asyncio.Event()
        """Set when the tables of contents are known, or when the link is lost."""
        self.answered = False
        """Whether anything was received at all."""
        self.complete = asyncio.Event()
        """Set when all parameters have been read."""
        self.asking = asyncio.Lock()
        """Held during the exchange for a parameter."""
        self._asked: dict[Key, asyncio.Future[bytes]] = {}
        """The answers that are waited for, which cflib itself ignores."""
        self.confidence = PositionConfidence()
        self.lost_beyond = inf
        """The largest standard deviation of its position in the air, in metres."""
        self.state: State | None = None
        self.recent: deque[State] = deque(maxlen=10)
        """The states of about the last second, the newest at the end."""
        self.took_off_at = -inf
        """When a take-off was commanded."""
        self._course: Course | None = None
        """The last trajectory to a place; None: there is none since its take-off."""
        self._course_at = -inf
        """When it was commanded."""
        self.commanded = False
        """Whether it flies by a command of this session."""
        self.located = False
        """Whether it is sent its position from outside."""
        self.lost = ""
        """Why the link has ended, once it has."""
        self.lacks: tuple[str, ...] = ()
        """Missing log variables of its firmware."""
        self._observer = observer
        self._since = self.loop.time()
        self._silent = False
        self._next = asyncio.Event()
        self._cf: Cf | None = None
        self._lag = Lag()
        self._looking = self.loop.call_later(_LOOK, self._look)

    # What it was commanded

    def sets_out(self, course: Course | None) -> None:
        """Called when it is commanded a trajectory to a place; None: when it takes off."""
        self._course = course
        self._course_at = self.loop.time()

    @property
    def setpoint(self) -> Setpoint:
        """Where its trajectory has led it by now, which is not quite where it is."""
        if self._course is None:
            return Setpoint(self.now().position)
        return self._course.at(self.loop.time() - self._course_at)

    @property
    def is_under_way(self) -> bool:
        """Whether its trajectory is known; else it may have another of before this session."""
        return self._course is not None

    # Callbacks of cflib

    def tell(self, call: Callable[..., None], *args: object) -> None:
        """Call something in the event loop, from any thread."""
        with suppress(RuntimeError):  # the loop is closed
            self.loop.call_soon_threadsafe(call, *args)

    def listen(self, cf: Cf) -> None:
        """Register for the link's callbacks; called in the worker, before it is opened."""
        self._cf = cf
        loses = self.uri.startswith("udp://")
        cf.connected.add_callback(lambda _: self.tell(self.established.set))
        cf.fully_connected.add_callback(lambda _: self.tell(self.complete.set))
        cf.connection_failed.add_callback(lambda _, why: self.tell(self.fail, why))
        cf.connection_lost.add_callback(lambda _, why: self.tell(self.fail, why))
        cf.disconnected.add_callback(lambda _: self.tell(self._disconnected))
        cf.link_established.add_callback(lambda _: self._established(cf, resend=loses))
        for port in (HIGH_LEVEL, SUPERVISOR):
            cf.add_port_callback(port, self._acknowledged)

    def _acknowledged(self, packet: CRTPPacket) -> None:
        self.tell(self._answers, packet.port, packet.channel, bytes(packet.data))

    def _answers(self, port: int, channel: int, data: bytes) -> None:
        if not data or (port == SUPERVISOR and channel != _COMMANDS):
            return
        number = data[0] & ~_ANSWER if port == SUPERVISOR else data[0]
        answer = self._asked.get((port, number))
        if answer is not None and not answer.done():
            answer.set_result(data)

    def _established(self, cf: Cf, *, resend: bool) -> None:
        """At the first packet, before any other is sent, make cflib repeat lost packets."""
        if resend and cf.link is not None:
            cf.link.needs_resending = True
        self.tell(self._answered)

    def _answered(self) -> None:
        self.answered = True

    def _disconnected(self) -> None:
        self.loop.call_later(0.1, self.fail, "it was closed")  # the reason comes right after

    def fail(self, why: str) -> None:
        """End the session: the link is lost."""
        self.established.set()
        if not self.lost:
            self.lost = messages.cause(why)
            if self.state is not None and not self._silent:  # else the link was never established
                self._observer.gone(self.lost)
        self._wake()

    def hear(self, state: State) -> None:
        if not self.lost:
            self.state, self._silent = state, False
            self.recent.append(state)
            self._observer.told(state)
            self._wake()

    def hear_variances(self, variances: tuple[float, ...], at: float) -> None:
        if not self.lost and variances:
            self.confidence.hear(variances, at)
            self._observer.doubted(max(variances))
            self._wake()

    def _look(self) -> None:
        """Check whether it has become silent."""
        if not self.lost:
            now = self.loop.time()
            self._lag.called(now, now + _LOOK)
            if self.state is not None and not self._silent and self.silent_for > self.silence:
                self._silent = True
                self._observer.gone(f"it has told nothing for {self.silent_for:.1f} s")
                self._wake()
            self._looking = self.loop.call_at(self._lag.due, self._look)

    # Queries

    @property
    def cf(self) -> Cf:
        """cflib's object; for calls in the worker."""
        if self._cf is None:
            raise LinkLost(messages.not_connected(self.drone))
        return self._cf

    @property
    def silent_for(self) -> float:
        """Seconds since its last state in which this process could have heard it."""
        now = self.loop.time()
        then = self._since if self.state is None else self.state.time
        return now - then - self._lag.since(then, now)

    @property
    def alive(self) -> bool:
        """Whether it can be commanded by this session."""
        return (
            not self.lost
            and not self.worker.stuck
            and self.state is not None
            and self.silent_for <= self.silence
        )

    @property
    def before(self) -> State | None:
        return self.recent[-2] if len(self.recent) > 1 else None

    @property
    def adrift(self) -> bool:
        """Whether it flies, and has been unsure of its position for too long."""
        flies = self.state is not None and self.state.flies
        return flies and self.confidence.lost(self.lost_beyond)

    @property
    def doubts(self) -> bool:
        """Whether it is unsure of its position now, so that its position does not count."""
        return self.confidence.doubts(self.lost_beyond)

    def now(self) -> State:
        """Return its state; raise if it cannot be commanded."""
        if self.lost:
            raise LinkLost(messages.ended(self.drone, self.lost))
        if self.state is None or self.silent_for > self.silence:
            raise LinkLost(f"{self.drone} stopped answering {self.silent_for:.1f} s ago")
        return self.state

    def well(self) -> State:
        """Return its state; raise if it cannot fly on."""
        state = self.now()
        if state.locked:
            why = ", as one of its decks reports a fault" if state.deck_failed else ""
            raise Locked(f"{self.drone} has locked its motors{why}: switch it off and on")
        if state.crashed:
            raise Crashed(f"{self.drone} has tumbled or crashed")
        return state

    async def fresh(self) -> State:
        """Return a new state; raise if it cannot fly on.

        If it has just become silent, its latest state is returned, as long as that is valid.
        """
        last, end = self.state, self.loop.time() + FRESH
        while self.state is last and (left := end - self.loop.time()) > 0.0:
            self.well()
            await self.heard(left)
        return self.well()

    async def call(self, call: Callable[[Cf], object], limit: float = 2.5) -> None:
        """Call a function of cflib in the drone's own thread."""
        cf = self.cf
        try:
            await self.worker.call(lambda: call(cf), limit)
        except NavigationError:
            raise
        except Exception as error:
            # cflib's link is None if it is lost while sending, which raises AttributeError
            if cf.link is not None and not self.lost:
                raise
            raise LinkLost(
                messages.ended(self.drone, self.lost or "it was closed while something was sent")
            ) from error

    async def answer(self, key: Key, send: Callable[[Cf], object], limit: float) -> bytes | None:
        """Send a command, and return the next answer to it; None: it was not answered in time."""
        answer = self._asked[key] = self.loop.create_future()
        try:
            await self.call(send)
            await asyncio.wait({answer}, timeout=limit)
            return answer.result() if answer.done() else None
        finally:
            answer.cancel()
            if self._asked.get(key) is answer:
                del self._asked[key]

    async def until(
        self, ready: Callable[[State], bool], limit: float, *, well: bool = True
    ) -> State | None:
        """Return the first new state that fulfils a condition, or None after the time-out.

        While it is silent there is no saying: then it is waited for, until that is too long. Raises what `well` raises, as soon as it does.
        """
        end = self.loop.time() + limit
        look = self.well if well else self.now
        while not ready(state := look()):
            left = end - self.loop.time()
            if left <= 0.0 and self.silent_for < FRESH:
                return None
            await self.heard(min(max(left, _LOOK), 0.2))
        return state

    async def until_told(self, limit: float) -> State | None:
        end = self.loop.time() + limit
        while self.state is None and not self.lost and self.loop.time() < end:
            await self.heard(0.2)
        return self.state

    async def heard(self, limit: float) -> None:
        """Wait until it sends something, with a time-out."""
        with suppress(TimeoutError):
            async with asyncio.timeout(limit):
                await self._next.wait()

    def _wake(self) -> None:
        self._next.set()
        self._next = asyncio.Event()

    # Its end

    def release(self) -> None:
        """Close it in a thread of its own, without a command to the drone."""
        self.lost = self.lost or "it was closed"
        self._looking.cancel()
        self._wake()
        gone: asyncio.Future[None] = self.loop.create_future()

        def told() -> None:
            if not gone.done():
                gone.set_result(None)

        self.worker.end()
        cf, self._cf = self._cf, None
        release_link(self.drone, cf, lambda: self.tell(told))
        self._observer.releasing(gone)
