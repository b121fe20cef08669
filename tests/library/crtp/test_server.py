"""Simulated drones behind UDP ports, in this loop and as a process."""

from __future__ import annotations

import json
import socket
from collections.abc import Iterator
from pathlib import Path

import pytest

from pluto_fleet.crtp import process
from pluto_fleet.crtp.body import AxisState, profile
from pluto_fleet.crtp.drone import Build
from pluto_fleet.crtp.equipment import frames
from pluto_fleet.crtp.flight_log import FlightLog
from pluto_fleet.crtp.packets import NULL
from pluto_fleet.crtp.server import Server
from pluto_fleet.process.surroundings import Surroundings
from pluto_fleet.shared.domain.errors import BadInput
from pluto_fleet.shared.domain.fleet_data import WorldData
from pluto_fleet.shared.events.world import Mover
from tests.kit.unthreaded import in_virtual_time, passes, the_air

ECHO = b"\xfcare you there"
HOMES = {"cf1": (1.0, 2.0, 0.0), "cf2": (3.0, 2.0, 0.0)}


class Client:
    """One that talks to a drone, and hears what it answers."""

    def __init__(self) -> None:
        self.heard: list[bytes] = []
        self.hear = self.heard.append


async def answered(uri: str, said: bytes = ECHO) -> list[bytes] | None:
    """Return what a drone answers within a tenth of a second; None: its port is closed."""
    port, client = the_air().ports.get(int(uri.rpartition(":")[2])), Client()
    if port is None:
        return None
    port.datagram_received(said, client)  # type: ignore[arg-type]
    await passes(0.1)
    return client.heard


def test_each_drone_has_a_port_and_its_own_faults() -> None:
    async def whole() -> None:
        server = Server([Build(id=id, home=home) for id, home in HOMES.items()], FlightLog())
        await server.start()
        uri, other = server.uris.values()
        assert await answered(uri) == [ECHO]
        assert await answered(uri, NULL) == [NULL]
        await server.let("cf1", "silent", True)
        assert await answered(uri) == []
        assert await answered(other) == [ECHO]
        await server.let("cf1", "silent", False)
        for latency, answers in ((0.04, [ECHO]), (0.06, [])):
            await server.let("cf1", "latency", latency)
            assert await answered(uri) == answers
        await server.let("cf1", "latency", 0.0)
        await server.let("cf1", "gone", True)
        assert await answered(uri) is None
        await server.let("cf1", "gone", False)
        assert await answered(uri) == [ECHO]
        await server.let("cf1", "loss", 1.0)
        assert await answered(uri) == []
        assert server.quiet == pytest.approx(0.1)
        await server.close()

    in_virtual_time(whole())


@pytest.fixture
def folder(tmp_path: Path) -> Iterator[Path]:
    """A folder behind which drones may live; none is left."""
    yield tmp_path / "flight.gateway"
    process.end(tmp_path / "flight.gateway")


@pytest.mark.process
def test_drones_in_a_process_do_what_is_asked_and_stay_where_they_were(folder: Path) -> None:
    slow = Mover(name="t1", kind="person", path=((4.0, 3.0), (5.0, 3.0)), speed=1e-6)
    around = Surroundings(data=WorldData(movers=(slow,)))
    uris = process.start(folder, HOMES, world=around)
    assert list(uris) == list(HOMES)
    assert process.start(folder, HOMES) == uris
    for more, refusal in (
        ({"drone": "cf9", "name": "silent", "value": True}, "there is no drone cf9"),
        ({"drone": "cf1", "name": "rain", "value": True}, "no such fault"),
    ):
        with pytest.raises(BadInput, match=refusal):
            process.told(folder, "fault", **more)
    with pytest.raises(BadInput, match="cannot be asked"):
        process.told(folder, "dance")
    assert first_picture(process.told(folder, "camera")) == frames(0)
    track = first_track(process.told(folder, "tracker"))
    assert track == {"id": "t1", "kind": "person", "at": pytest.approx([4.0, 3.0, 0.0], abs=0.01)}
    process.told(folder, "fault", drone="cf1", name="place", value=[5.0, 4.0, 0.0])
    process.told(folder, "fault", drone="cf2", name="level", value=0.5)
    process.end(folder)
    with pytest.raises(BadInput):
        process.uris_in(folder)
    assert process.start(folder, HOMES) == uris
    state = json.loads(process.told(folder, "state"))
    assert state["cf1"]["at"] == [5.0, 4.0, 0.0]
    assert state["cf2"]["level"] == pytest.approx(0.5, abs=0.01)


def first_track(tracker: str) -> object:
    """Return what a client of a tracker is told first."""
    host, _, port = tracker.rpartition(":")
    with socket.create_connection((host, int(port)), 10) as connection:
        return json.loads(connection.makefile().readline())


def first_picture(camera: str) -> bytes:
    """Return the first picture that a client of a camera gets."""
    host, _, port = camera.rpartition(":")
    with (
        socket.create_connection((host, int(port)), timeout=5) as line,
        line.makefile("rb") as data,
    ):
        return data.read(len(frames(0)))


def test_a_way_begins_as_the_last_one_was_left() -> None:
    left = profile(AxisState(0.0), 3.0, 2.0).at(0.8)
    begun = profile(left, 1.0, 1.5)
    for one, other in zip(begun.at(0.0), left, strict=True):
        assert one == pytest.approx(other)
    assert begun.at(1.5).position == pytest.approx(1.0)
