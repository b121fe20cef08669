"""Simulated drones behind UDP ports, in this loop and as a process."""

from __future__ import annotations

import asyncio
import json
import socket
from collections.abc import Iterator
from pathlib import Path

import pytest

from pluto_fleet.crtp import process
from pluto_fleet.crtp.body import AxisState, profile
from pluto_fleet.crtp.drone import Build
from pluto_fleet.crtp.equipment import HEIGHT, WIDTH, frames
from pluto_fleet.crtp.flight_log import MemoryLog
from pluto_fleet.crtp.packets import NULL
from pluto_fleet.crtp.server import HOST, Server
from pluto_fleet.shared.domain.errors import BadInput
from tests.library.crtp.starting import COMMAND

ECHO = b"\xfcare you there"
HOMES = {"cf1": (1.0, 2.0, 0.0), "cf2": (3.0, 2.0, 0.0)}


class Talk(asyncio.DatagramProtocol):
    """A client that talks to one drone."""

    def __init__(self) -> None:
        self.heard: asyncio.Queue[bytes] = asyncio.Queue()

    def datagram_received(self, data: bytes, addr: tuple[str, int]) -> None:
        self.heard.put_nowait(data)

    def error_received(self, exc: Exception) -> None:
        self.heard.put_nowait(b"refused")


async def answered(uri: str, said: bytes = ECHO) -> bytes | None:
    """Return what a drone answers; None: nothing for a while."""
    loop = asyncio.get_running_loop()
    address = (HOST, int(uri.rpartition(":")[2]))
    transport, talk = await loop.create_datagram_endpoint(Talk, remote_addr=address)
    try:
        transport.sendto(said)
        async with asyncio.timeout(0.3):
            return await talk.heard.get()
    except TimeoutError:
        return None
    finally:
        transport.close()


async def faults_of(server: Server) -> None:
    uri, other = server.uris.values()
    assert await answered(uri) == ECHO
    assert await answered(uri, NULL) == NULL
    await server.let("cf1", "silent", True)
    assert await answered(uri) is None
    assert await answered(other) == ECHO
    await server.let("cf1", "silent", False)
    await server.let("cf1", "latency", 0.02)
    assert await answered(uri) == ECHO
    await server.let("cf1", "gone", True)
    assert await answered(uri) in (b"refused", None)
    await server.let("cf1", "gone", False)
    assert await answered(uri) == ECHO
    await server.let("cf1", "loss", 1.0)
    assert await answered(uri) is None


def test_each_drone_has_a_port_and_its_own_faults() -> None:
    async def whole() -> None:
        server = Server([Build(id=id, home=home) for id, home in HOMES.items()], MemoryLog())
        await server.start()
        try:
            await faults_of(server)
        finally:
            await server.close()

    asyncio.run(whole())


@pytest.fixture
def folder(tmp_path: Path) -> Iterator[Path]:
    """A folder behind which drones may live; none is left."""
    yield tmp_path / "flight.gateway"
    process.end(tmp_path / "flight.gateway")


def test_drones_in_a_process_are_found_again_and_stay_where_they_were(folder: Path) -> None:
    uris = process.start(folder, HOMES, COMMAND)
    assert list(uris) == list(HOMES)
    assert process.start(folder, HOMES, COMMAND) == uris
    process.told(folder, "fault", drone="cf1", name="place", value=[5.0, 4.0, 0.0])
    process.told(folder, "fault", drone="cf2", name="level", value=0.5)
    process.end(folder)
    with pytest.raises(BadInput):
        process.uris_in(folder)
    assert process.start(folder, HOMES, COMMAND) == uris
    state = json.loads(process.told(folder, "state"))
    assert state["cf1"]["at"] == [5.0, 4.0, 0.0]
    assert state["cf2"]["level"] == pytest.approx(0.5, abs=0.01)


def test_a_process_refuses_what_cannot_be_asked(folder: Path) -> None:
    process.start(folder, HOMES, COMMAND)
    with pytest.raises(BadInput, match="there is no drone cf9"):
        process.told(folder, "fault", drone="cf9", name="silent", value=True)
    with pytest.raises(BadInput, match="no such fault"):
        process.told(folder, "fault", drone="cf1", name="rain", value=True)
    with pytest.raises(BadInput, match="cannot be asked"):
        process.told(folder, "dance")


def test_a_process_streams_pictures_to_a_client_that_asks_for_a_camera(folder: Path) -> None:
    process.start(folder, HOMES, COMMAND)
    host, _, port = process.told(folder, "camera").rpartition(":")
    with socket.create_connection((host, int(port)), timeout=5) as line:
        told, first = b"", frames(0)
        while len(told) < len(first):
            told += line.recv(len(first) - len(told))
    assert told == first
    assert len(told) > WIDTH * HEIGHT


def test_a_way_from_rest_to_rest_peaks_at_2_19_times_its_mean_speed() -> None:
    way = profile(AxisState(0.0), 3.0, 2.0)
    assert way.at(0.0) == AxisState(0.0)
    assert way.at(2.0) == AxisState(3.0)
    assert way.at(1.0).position == pytest.approx(1.5)
    assert way.at(1.0).velocity == pytest.approx(2.1875 * 1.5)


def test_a_way_begins_as_the_last_one_was_left() -> None:
    left = profile(AxisState(0.0), 3.0, 2.0).at(0.8)
    begun = profile(left, 1.0, 1.5)
    for one, other in zip(begun.at(0.0), left, strict=True):
        assert one == pytest.approx(other)
    assert begun.at(1.5).position == pytest.approx(1.0)
