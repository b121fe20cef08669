"""A Crazyradio that is not there: cflib's own radio driver talks to simulated drones through it.

Only the class of the USB dongle is replaced. `radio://0/80/2M/E7E7E7E701` reaches a drone; several
may be on one dongle, which each packet keeps busy for a while, as a real one.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib import import_module
from threading import Event, Lock, Thread

import pytest

from pluto_fleet.crtp.drone import Build, SimulatedCrazyflie
from pluto_fleet.crtp.flight_log import FlightLog

_PACKET, _NO_ANSWER = 0.0008, 0.002
"""Seconds that a packet takes: with an answer, and until the radio gives up."""
_TICK = 0.01
_SAFELINK = (0xFF, 0x05, 0x01)
_NOTHING = b"\xf3\x01\x2d"
"""What a drone answers that has nothing to say: how strong it hears the radio."""
_CHANNEL, _RATE = 80, 2

Where = tuple[int, int, tuple[int, ...]]
"""Channel, rate and address: which drone is meant."""


class Ack:
    """What the dongle says of a packet that was sent."""

    def __init__(self, ack: bool, data: bytes = b"", retry: int = 0) -> None:
        self.ack, self.data, self.retry, self.powerDet = ack, tuple(data), retry, False


class OnTheAir:
    """A drone as the radio meets it: it speaks only when it is spoken to."""

    def __init__(self, build: Build, number: int, record: FlightLog) -> None:
        self.drone = SimulatedCrazyflie(build, record, self._say)
        self.lock = Lock()
        self.where: Where = (_CHANNEL, _RATE, (0xE7, 0xE7, 0xE7, 0xE7, number))
        self._waiting: deque[bytes] = deque(maxlen=500)
        self._current = _NOTHING
        self._up = self._down = 0
        self._first = True

    @property
    def uri(self) -> str:
        channel, _, address = self.where
        return f"radio://0/{channel}/2M/{bytes(address).hex().upper()}"

    def _say(self, raw: bytes) -> None:
        self._waiting.append(raw)

    def answer(self, packet: Sequence[int]) -> bytes:
        """Take a packet, unless it came before, and return what goes back with the acknowledgement."""
        if tuple(packet) == _SAFELINK:
            self._up = self._down = 0
            self._first = True
            self._waiting.clear()
            return bytes(_SAFELINK)
        head = packet[0]
        with self.lock:
            if head >> 3 & 1 == self._up:
                self._up ^= 1
                if head & 0xF3 != 0xF3:
                    self.drone.receive(bytes(packet), time.monotonic())
            if self._first or head >> 2 & 1 != self._down:
                self._first, self._down = False, head >> 2 & 1
                self._current = self._waiting.popleft() if self._waiting else _NOTHING
        return bytes([self._current[0] & 0xF3 | self._down << 2]) + self._current[1:]


class Ether:
    """All drones in reach of the radio, and what becomes of its dongle."""

    def __init__(self, builds: Sequence[Build], record: FlightLog) -> None:
        made = (OnTheAir(build, number, record) for number, build in enumerate(builds, 1))
        self._by_id: Mapping[str, OnTheAir] = {one.drone.build.id: one for one in made}
        self._by_place = {one.where: one for one in self._by_id.values()}
        self.unplugged = False
        self._over = Event()
        self._thread = Thread(target=self._pass, name="simulated drones", daemon=True)

    @property
    def uris(self) -> dict[str, str]:
        return {id: one.uri for id, one in self._by_id.items()}

    @property
    def drones(self) -> Mapping[str, SimulatedCrazyflie]:
        return {id: one.drone for id, one in self._by_id.items()}

    def sent(self, where: Where, packet: Sequence[int], retries: int) -> Ack:
        """Let the radio send a packet; return what comes back."""
        one = self._by_place.get(where)
        if one is None or not one.drone.answers:
            time.sleep(_NO_ANSWER)
            return Ack(False, retry=retries)
        time.sleep(_PACKET)
        return Ack(True, one.answer(packet))

    def start(self) -> None:
        self._thread.start()

    def end(self) -> None:
        """Let it stand still, and the dongle be gone."""
        self.unplugged = True
        self._over.set()
        self._thread.join()

    def _pass(self) -> None:
        while not self._over.is_set():
            now = time.monotonic()
            for one in self._by_id.values():
                with one.lock:
                    one.drone.step(now)
            time.sleep(_TICK)


class Dongle:
    """The USB dongle, as cflib's driver uses it."""

    DR_250KPS, DR_1MPS, DR_2MPS = 0, 1, 2
    ethers: Sequence[Ether]

    def __init__(self, device: object = None, devid: int = 0, serial: str | None = None) -> None:
        self.ether = self.ethers[devid]
        if self.ether.unplugged:
            raise RuntimeError("Cannot find a Crazyradio Dongle")  # in cflib's own words
        self.version = 0.54
        self._retries = 3
        self._set: dict[str, object] = {}

    def _setup(self, what: str, value: object) -> None:
        """Tell the dongle something, over USB: only what it has not been told already."""
        if self._set.get(what) == value:
            return
        if self.ether.unplugged:
            raise OSError("[Errno 19] No such device (it may have been disconnected)")
        self._set[what] = value

    def set_channel(self, channel: int) -> None:
        self._setup("channel", channel)

    def set_address(self, address: Sequence[int]) -> None:
        self._setup("address", tuple(address))

    def set_data_rate(self, datarate: int) -> None:
        self._setup("rate", datarate)

    def set_arc(self, arc: int) -> None:
        self._retries = arc

    def close(self) -> None:
        """Nothing is open."""

    def send_packet(self, data: Sequence[int]) -> Ack | None:
        """Send a packet; None: there is no dongle any more."""
        if self.ether.unplugged:
            time.sleep(_TICK)
            return None
        channel, address, rate = (self._set.get(one) for one in ("channel", "address", "rate"))
        assert isinstance(channel, int) and isinstance(rate, int) and isinstance(address, tuple)
        return self.ether.sent((channel, rate, address), data, self._retries)

    def scan_channels(self, start: int, stop: int, packet: Sequence[int]) -> tuple[int, ...]:
        found = []
        for channel in range(start, stop + 1):
            self.set_channel(channel)
            ack = self.send_packet(packet)
            if ack is not None and ack.ack:
                found.append(channel)
        return tuple(found)


@contextmanager
def plugged_in(*ethers: Ether) -> Iterator[None]:
    """Give cflib a dongle for each of these, and no other; take them away again."""
    driver = import_module("cflib.crtp.radiodriver")
    usb = import_module("cflib.drivers.crazyradio")
    dongle = type("Dongle", (Dongle,), {"ethers": ethers})
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(driver, "Crazyradio", dongle)
        patch.setattr(driver.RadioManager, "_radios", [])
        patch.setattr(
            usb,
            "get_serials",
            lambda: [f"E7E7E7E7E{n}" for n, one in enumerate(ethers) if not one.unplugged],
        )
        for ether in ethers:
            ether.start()
        try:
            yield
        finally:
            for ether in ethers:
                ether.end()
