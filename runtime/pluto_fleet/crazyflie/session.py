"""One connection to one Crazyflie, from the opening of its link to its end; never used again.

cflib calls back from threads of its own. What it says there is only carried over to the event loop;
everything in this module happens in the loop, but for what `Worker` calls. Acknowledgements are what a
Crazyflie answers to commands: cflib takes them from the radio and drops them.
"""

from __future__ import annotations

import asyncio
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from math import inf
from typing import TYPE_CHECKING, Protocol

from ..drones.errors import Crashed, LinkLost, Locked, NavigationError
from . import messages
from .driver import HIGH_LEVEL, SUPERVISOR, release_link
from .state import PositionConfidence, State
from .worker import Worker

if TYPE_CHECKING:
    from cflib.crazyflie import Crazyflie as Cf
    from cflib.crtp.crtpstack import CRTPPacket


_ANSWER = 0x80
"""The supervisor sets this bit in its answers."""
_COMMANDS = 1
"""The channel on which it takes commands."""

Key = tuple[int, int]
"""The port, and the number of the command."""


class Acknowledgements:
    """Answers that are waited for."""

    def __init__(self) -> None:
        self._waiting: dict[Key, asyncio.Future[bytes]] = {}

    def listen(self, cf: Cf, tell: Callable[..., None]) -> None:
        """Hear all answers; called in the worker, as they come in a thread of cflib's."""

        def hear(packet: CRTPPacket) -> None:
            tell(self._hear, packet.port, packet.channel, bytes(packet.data))

        cf.add_port_callback(HIGH_LEVEL, hear)
        cf.add_port_callback(SUPERVISOR, hear)

    def expect(self, key: Key) -> asyncio.Future[bytes]:
        """Begin to listen for the next answer to a command: before the command is sent."""
        answer: asyncio.Future[bytes] = asyncio.get_running_loop().create_future()
        self._waiting[key] = answer
        return answer

    async def heard(self, answer: asyncio.Future[bytes], limit: float) -> bytes | None:
        """Return the answer, or None if it does not come in time."""
        await asyncio.wait({answer}, timeout=limit)
        return answer.result() if answer.done() else None

    def drop(self, key: Key, answer: asyncio.Future[bytes]) -> None:
        """Listen no longer."""
        answer.cancel()
        if self._waiting.get(key) is answer:
            del self._waiting[key]

    def _hear(self, port: int, channel: int, data: bytes) -> None:
        if not data or (port == SUPERVISOR and channel != _COMMANDS):
            return
        number = data[0] & ~_ANSWER if port == SUPERVISOR else data[0]
        answer = self._waiting.get((port, number))
        if answer is not None and not answer.done():
            answer.set_result(data)


SILENCE = 1.0
"""Seconds without a word, after which a link counts as lost; a word is expected ten times a second."""

FRESH = 0.5
"""Seconds for which a new word is waited for before something is decided by it."""


class SessionObserver(Protocol):
    """Told what happens to a connection."""

    def told(self, state: State) -> None:
        """The drone told how it is."""
        ...

    def doubted(self, variance: float) -> None:
        """The drone told how sure it is of its place: the variance, in square metres."""
        ...

    def gone(self, why: str) -> None:
        """It tells nothing any more."""
        ...

    def releasing(self, gone: asyncio.Future[None]) -> None:
        """The link is being put away, until this is done."""
        ...


class CrazyflieSession:
    """What is known of a drone while it is connected, and the one way to call cflib for it."""

    def __init__(self, drone: str, uri: str, observer: SessionObserver) -> None:
        self.drone, self.uri = drone, uri
        self.loop = asyncio.get_running_loop()
        self.worker = Worker(drone)
        self.established = asyncio.Event()
        """Set when the tables of contents are there, or when the link is lost."""
        self.answered = False
        """Whether anything has come at all."""
        self.complete = asyncio.Event()
        """Set when all parameters have been read."""
        self.asking = asyncio.Lock()
        """Held while a parameter is asked for."""
        self.acknowledged = Acknowledgements()
        self.confidence = PositionConfidence()
        self.lost_beyond = inf
        """Metres to which it must know where it is in the air."""
        self.state: State | None = None
        self.recent: deque[State] = deque(maxlen=10)
        """What it told lately, the last at the end: about a second."""
        self.took_off_at = -inf
        """When it was told to take off."""
        self.commanded = False
        """Whether it flies because of what was said through this."""
        self.located = False
        """Whether it is told its position from outside."""
        self.lost = ""
        """Why the link has ended, once it has."""
        self.lacks: tuple[str, ...] = ()
        """Log variables that its firmware should have."""
        self._observer = observer
        self._since = time.monotonic()
        self._silent = False
        self._next = asyncio.Event()
        self._cf: Cf | None = None
        self._looking = self.loop.call_later(SILENCE, self._look)

    # What cflib says

    def tell(self, call: Callable[..., None], *args: object) -> None:
        """Carry something over to the event loop, from any thread."""
        with suppress(RuntimeError):  # the loop is closed
            self.loop.call_soon_threadsafe(call, *args)

    def listen(self, cf: Cf) -> None:
        """Hear what happens to the link; called in the worker, before it is opened."""
        self._cf = cf
        loses = self.uri.startswith("udp://")
        cf.connected.add_callback(lambda _: self.tell(self.established.set))
        cf.fully_connected.add_callback(lambda _: self.tell(self.complete.set))
        cf.connection_failed.add_callback(lambda _, why: self.tell(self.fail, why))
        cf.connection_lost.add_callback(lambda _, why: self.tell(self.fail, why))
        cf.disconnected.add_callback(lambda _: self.tell(self._disconnected))
        cf.link_established.add_callback(lambda _: self._established(cf, resend=loses))
        self.acknowledged.listen(cf, self.tell)

    def _established(self, cf: Cf, *, resend: bool) -> None:
        """The very first packet came: before any other is sent, make cflib repeat what gets lost."""
        if resend and cf.link is not None:
            cf.link.needs_resending = True
        self.tell(self._answered)

    def _answered(self) -> None:
        self.answered = True

    def _disconnected(self) -> None:
        self.loop.call_later(0.1, self.fail, "it was closed")  # why it was comes right after

    def fail(self, why: str) -> None:
        """The link is gone, for good."""
        self.established.set()
        if not self.lost:
            self.lost = messages.cause(why)
            if self.state is not None and not self._silent:  # else it never came to be
                self._observer.gone(self.lost)
        self._wake()

    def hear(self, state: State) -> None:
        """It told how it is."""
        if not self.lost:
            self.state, self._silent = state, False
            self.recent.append(state)
            self._observer.told(state)
            self._wake()

    def hear_variances(self, variances: tuple[float, ...], at: float) -> None:
        """It told how sure it is of its place."""
        if not self.lost and variances:
            self.confidence.hear(variances, at)
            self._observer.doubted(max(variances))
            self._wake()

    def _look(self) -> None:
        """See whether it has become silent."""
        if not self.lost:
            if self.state is not None and not self._silent and self.silent_for > SILENCE:
                self._silent = True
                self._observer.gone(f"it has told nothing for {self.silent_for:.1f} s")
                self._wake()
            self._looking = self.loop.call_later(SILENCE / 10, self._look)

    # What others ask

    @property
    def cf(self) -> Cf:
        """What cflib has of it; for calls in the worker."""
        if self._cf is None:
            raise LinkLost(messages.not_connected(self.drone))
        return self._cf

    @property
    def silent_for(self) -> float:
        """Seconds since it told anything."""
        return time.monotonic() - (self._since if self.state is None else self.state.time)

    @property
    def alive(self) -> bool:
        """Whether it can be commanded through this."""
        return (
            not self.lost
            and not self.worker.stuck
            and self.state is not None
            and self.silent_for <= SILENCE
        )

    @property
    def before(self) -> State | None:
        """What it told before the last that it told."""
        return self.recent[-2] if len(self.recent) > 1 else None

    @property
    def adrift(self) -> bool:
        """Whether it flies, and has not known for long enough where it is."""
        flies = self.state is not None and self.state.flies
        return flies and self.confidence.lost(self.lost_beyond)

    @property
    def doubts(self) -> bool:
        """Whether it does not know where it is at this moment: what it says of that counts nothing."""
        return self.confidence.doubts(self.lost_beyond)

    def now(self) -> State:
        """Return how it is; raise why nothing can be commanded."""
        if self.lost:
            raise LinkLost(messages.ended(self.drone, self.lost))
        if self.state is None or self.silent_for > SILENCE:
            raise LinkLost(f"{self.drone} stopped answering {self.silent_for:.1f} s ago")
        return self.state

    def well(self) -> State:
        """Return how it is; raise why it cannot fly on."""
        state = self.now()
        if state.locked:
            raise Locked(messages.locked(self.drone, state.deck_failed))
        if state.crashed:
            raise Crashed(f"{self.drone} has tumbled or crashed")
        return state

    async def fresh(self) -> State:
        """Return how it is by what it tells from now on; raise why it cannot fly on.

        One that has become silent is taken at its last word, for as long as that counts.
        """
        last, end = self.state, self.loop.time() + FRESH
        while self.state is last and (left := end - self.loop.time()) > 0.0:
            self.well()
            await self.heard(left)
        return self.well()

    async def call(self, call: Callable[[Cf], object], limit: float = 2.5) -> None:
        """Call something of cflib in the drone's own thread."""
        cf = self.cf
        try:
            await self.worker.call(lambda: call(cf), limit)
        except NavigationError:
            raise
        except Exception as error:
            # a link that is lost while something is sent is None in cflib, and falls over that
            if cf.link is not None and not self.lost:
                raise
            raise LinkLost(
                messages.ended(self.drone, self.lost or messages.WHILE_SENDING)
            ) from error

    async def until(
        self, ready: Callable[[State], bool], limit: float, *, well: bool = True
    ) -> State | None:
        """Return the first state from now on that is so, or None when the limit is over.

        Raises what `well` raises as soon as it would.
        """
        end = self.loop.time() + limit
        look = self.well if well else self.now
        while not ready(state := look()):
            left = end - self.loop.time()
            if left <= 0.0:
                return None
            await self.heard(min(left, 0.2))
        return state

    async def until_told(self, limit: float) -> State | None:
        """Return the first thing that it tells of itself, or None."""
        end = self.loop.time() + limit
        while self.state is None and not self.lost and self.loop.time() < end:
            await self.heard(0.2)
        return self.state

    async def heard(self, limit: float) -> None:
        """Wait until it tells something, or for so long."""
        with suppress(TimeoutError):
            async with asyncio.timeout(limit):
                await self._next.wait()

    def _wake(self) -> None:
        self._next.set()
        self._next = asyncio.Event()

    # Its end

    def release(self) -> None:
        """End it in a thread of its own: never by a command to the drone."""
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
