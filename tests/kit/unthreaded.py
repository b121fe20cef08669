"""The unmodified cflib in one thread, on a loop whose clock jumps: a flight of a minute takes a moment.

What its threads do is done in turns: where one would wait, its turn is over. Its timers are the loop's, and
packets go through the air of this process and not through a socket, so that each arrives at its instant.
"""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import Callable, Coroutine, Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from queue import Empty
from threading import Thread
from types import ModuleType
from typing import Any, TypeVar

import pytest

from tests.kit.drones import JumpingLoop

T = TypeVar("T")


class Waits(BaseException):
    """A thread would wait now; not even cflib, which catches every error, keeps this."""


class Requests:
    """A queue of a thread's that raises where the thread would wait."""

    def __init__(self) -> None:
        self._waiting: deque[object] = deque()
        self._taken: object = None

    def put(self, request: object) -> None:
        """Add a request, which is taken in the next turn."""
        self._waiting.append(request)
        the_air().soon()

    def get(self, block: bool = True) -> object:
        """Return the next request."""
        if not self._waiting:
            raise Waits if block else Empty
        self._taken = self._waiting.popleft()
        return self._taken

    def back(self) -> None:
        """Take a request back that could not be sent yet."""
        self._waiting.appendleft(self._taken)


class Held(BaseException):
    """A thread would wait for a lock now."""


class Turn:
    """A lock that raises where a thread would wait."""

    def __init__(self) -> None:
        self._held = False

    def acquire(self) -> None:
        """Take it."""
        if self._held:
            raise Held
        self._held = True

    def release(self) -> None:
        """Give it back."""
        if not self._held:
            raise RuntimeError
        self._held = False


class Stop:
    """An event that ends a thread; to wait for it ends its turn."""

    def __init__(self) -> None:
        self._stopped = False

    def is_set(self) -> bool:
        """Return whether the thread is to end."""
        return self._stopped

    def set(self) -> None:
        """End the thread."""
        self._stopped = True

    def wait(self, _: float) -> None:
        """Wait for it."""
        raise Waits


class LoopTimer:
    """A `threading.Timer` on the loop's clock."""

    daemon = True

    def __init__(self, seconds: float, call: Callable[..., object], args: tuple[Any, ...] = ()):
        self._due = seconds, call, args
        self._handle: asyncio.TimerHandle | None = None

    def start(self) -> None:
        """Let it run."""
        seconds, call, args = self._due
        self._handle = asyncio.get_running_loop().call_later(seconds, call, *args)

    def cancel(self) -> None:
        """Stop it."""
        if self._handle is not None:
            self._handle.cancel()


class AtOnce:
    """A `threading.Thread` whose work is done where it is started."""

    def __init__(self, target: Callable[[], object], **_: object) -> None:
        self.start = target


class Inline:
    """A `Worker` whose calls are made where they are awaited."""

    stuck = False

    def __init__(self, drone: str) -> None:
        self.drone = drone

    async def call(self, call: Callable[[], T], limit: float) -> T:
        """Make a call."""
        return call()

    def post(self, call: Callable[[], object]) -> None:
        """Make a call whose result is not waited for."""
        with suppress(Exception):
            call()

    def end(self) -> None:
        """Do nothing: there is no thread."""


class Port(asyncio.DatagramTransport):
    """A drone's end of the air."""

    def __init__(self, air: AirLoop, number: int) -> None:
        super().__init__()
        self._air, self._number = air, number

    def get_extra_info(self, name: str, default: object = None) -> tuple[str, int]:
        """Return its address."""
        return "127.0.0.1", self._number

    def sendto(self, data: Any, addr: Any = None) -> None:
        """Send a packet to a driver."""
        if not self._air.loses(data):
            self._air.call_soon(addr.hear, bytes(data))

    def close(self) -> None:
        """Take it off the air."""
        self._air.ports.pop(self._number, None)


class AirLoop(JumpingLoop):
    """A loop whose datagrams stay within it, and in which cflib's threads have their turns."""

    def __init__(self) -> None:
        super().__init__()
        self.ports: dict[int, asyncio.DatagramProtocol] = {}
        self.threads: list[Any] = []
        self.loses: Callable[[bytes], bool] = lambda _: False
        """Whether a drone's packet is lost."""
        self._next = 1
        self._coming = False

    async def create_datagram_endpoint(  # type: ignore[override]
        self, protocol_factory: Any, local_addr: tuple[str, int]
    ) -> Any:
        """Open a port, the one that is asked for or a free one."""
        number = local_addr[1] or self._next
        if number in self.ports:
            raise OSError("the address is in use")
        self._next += 1
        self.ports[number] = protocol_factory()
        return Port(self, number), self.ports[number]

    def soon(self) -> None:
        """Let each thread have its turn."""
        if not self._coming:
            self._coming = True
            self.call_soon(self._turns)

    def _turns(self) -> None:
        self._coming = False
        for thread in self.threads:
            try:
                thread.run()
            except Held:
                thread.request_queue.back()
            except Waits:
                continue


def the_air() -> AirLoop:
    """Return the loop that runs."""
    loop = asyncio.get_running_loop()
    assert isinstance(loop, AirLoop)
    return loop


async def passes(seconds: float) -> None:
    """Let time pass, which takes none."""
    await asyncio.sleep(seconds)


class AirDriver:
    """cflib's end of the air, in place of its driver for UDP."""

    def __init__(self) -> None:
        self.needs_resending = False
        self._heard: deque[object] = deque()
        self._open = True

    def connect(self, uri: str, statistics: object, fail: Any) -> None:
        """Open a link; `fail` is a method of the `Crazyflie` whose link it is."""
        self._port, self._fail, self._cf = int(uri.rpartition(":")[2]), fail, fail.__self__

    def send_packet(self, packet: Any) -> bool:
        """Send a packet; one to a closed port comes back as an error."""
        the_air().call_soon(self._sent, bytes([packet.header]) + bytes(packet.data))
        return True

    def _sent(self, data: bytes) -> None:
        there = the_air().ports.get(self._port)
        if there is not None:
            there.datagram_received(data, self)  # type: ignore[arg-type]
        elif self._open:
            self._fail("Error communicating with the Crazyflie\nException:[Errno 111] refused")

    def hear(self, data: bytes) -> None:
        """Take a packet, and let cflib pass it on."""
        if self._open:
            packet = import_module("cflib.crtp.crtpstack").CRTPPacket
            self._heard.append(packet(data[0], tuple(data[1:])))
            with suppress(Waits):
                self._cf.incoming.run()
            the_air().soon()

    def receive_packet(self, wait: float = 0.0) -> object:
        """Return the next packet."""
        if not self._heard:
            raise Waits
        return self._heard.popleft()

    def close(self) -> None:
        """Close the link."""
        self._open = False


def _threads(module: ModuleType) -> Iterator[type[Thread]]:
    """Yield the threads that a module of cflib has."""
    for one in vars(module).values():
        if isinstance(one, type) and issubclass(one, Thread) and one is not Thread:
            yield one


@contextmanager
def one_thread() -> Iterator[None]:
    """Let cflib, and what flies Crazyflies with it, start no thread."""
    cflib, param = import_module("cflib.crazyflie"), import_module("cflib.crazyflie.param")
    statistics = import_module("cflib.crazyflie.link_statistics")
    ours = [import_module(f"pluto_fleet.crazyflie.{name}") for name in ("session", "commander")]
    driver = import_module("pluto_fleet.crazyflie.driver")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(import_module("cflib.crtp"), "CLASSES", [AirDriver])
        for thread in _threads(cflib):
            patch.setattr(thread, "start", lambda _: None)  # each packet lets it have its turn
        for thread in _threads(param):
            patch.setattr(thread, "start", lambda one: the_air().threads.append(one))
        patch.setattr(cflib, "Timer", LoopTimer)
        patch.setattr(cflib, "Event", Stop)
        patch.setattr(param, "Queue", Requests)
        patch.setattr(param, "Lock", Turn)
        patch.setattr(statistics.Latency, "start", lambda _: None)
        patch.setattr(driver, "Timer", LoopTimer)
        patch.setattr(driver, "Thread", AtOnce)
        for module in ours:
            patch.setattr(module, "Worker", Inline)
        yield


def in_virtual_time(flight: Coroutine[Any, Any, T]) -> T:
    """Fly this to its end."""
    with one_thread(), asyncio.Runner(loop_factory=AirLoop) as runner:
        return runner.run(flight)
