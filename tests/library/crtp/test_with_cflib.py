"""The unmodified cflib meets simulated drones: over UDP, and through a radio that is not there."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from pathlib import Path
from threading import Event, Thread
from typing import Any

import pytest

from pluto_fleet.crtp.drone import Build
from pluto_fleet.crtp.flight_log import MemoryLog
from pluto_fleet.crtp.server import Server
from tests.library.crtp.radio import Ether, plugged_in

pytest.importorskip("cflib")

BUILDS = [Build(id="cf1", home=(1.0, 2.0, 0.0)), Build(id="cf2", home=(3.0, 2.0, 0.0))]
PATIENCE = 10.0


class Client:
    """A program that uses cflib, with what it was told."""

    def __init__(self, cache: Path) -> None:
        crtp = import_module("cflib.crtp")
        if not crtp.CLASSES:
            crtp.init_drivers()
        self.cf: Any = import_module("cflib.crazyflie").Crazyflie(rw_cache=str(cache))
        self.ready, self.failed = Event(), Event()
        self.logged = Event()
        self.values: dict[str, float] = {}
        self.cf.fully_connected.add_callback(lambda _: self.ready.set())
        self.cf.connection_failed.add_callback(lambda *_: self.failed.set())

    def connect(self, uri: str) -> None:
        """Open the link, and wait until all is known of the drone."""
        self.cf.open_link(uri)
        assert self.ready.wait(PATIENCE)

    def log(self, *names: str) -> dict[str, float]:
        """Return the values of some variables."""
        block = import_module("cflib.crazyflie.log").LogConfig("some", 50)
        for name in names:
            block.add_variable(name)
        block.data_received_cb.add_callback(self._heard)
        self.cf.log.add_config(block)
        block.start()
        assert self.logged.wait(PATIENCE)
        return self.values

    def _heard(self, _: int, values: dict[str, float], __: object) -> None:
        self.values = values
        self.logged.set()


@contextmanager
def over_udp() -> Iterator[dict[str, str]]:
    """Let the drones live in a loop of their own."""
    loop, server = asyncio.new_event_loop(), Server(BUILDS, MemoryLog())
    thread = Thread(target=loop.run_forever, daemon=True)
    thread.start()
    asyncio.run_coroutine_threadsafe(server.start(), loop).result(PATIENCE)
    try:
        yield server.uris
    finally:
        asyncio.run_coroutine_threadsafe(server.close(), loop).result(PATIENCE)
        loop.call_soon_threadsafe(loop.stop)
        thread.join()
        loop.close()


@contextmanager
def over_the_air() -> Iterator[dict[str, str]]:
    """Let the drones be reached through a dongle."""
    ether = Ether(BUILDS, MemoryLog())
    with plugged_in(ether):
        yield ether.uris


@pytest.mark.parametrize("reach", [over_udp, over_the_air])
def test_cflib_connects_logs_sets_and_commands(reach: Any, tmp_path: Path) -> None:
    with reach() as uris:
        client = Client(tmp_path)
        client.connect(uris["cf2"])
        try:
            assert client.cf.platform.get_protocol_version() == 12
            told = client.log("stateEstimate.x", "stateEstimate.y", "pm.vbat", "supervisor.info")
            assert told["stateEstimate.x"] == 3.0 and told["pm.vbat"] == pytest.approx(4.18)
            set_back = Event()
            client.cf.param.add_update_callback("gripper", "closed", lambda *_: set_back.set())
            client.cf.param.set_value("gripper.closed", 1)
            assert set_back.wait(PATIENCE)
            assert client.cf.param.get_value("gripper.closed") == "1"
            answered = Event()
            client.cf.add_port_callback(8, lambda _: answered.set())
            client.cf.high_level_commander.takeoff(0.5, 1.0, yaw=None)
            assert answered.wait(PATIENCE)
        finally:
            client.cf.close_link()


def test_two_drones_share_a_dongle_and_one_out_of_reach_fails_alone(tmp_path: Path) -> None:
    ether = Ether(BUILDS, MemoryLog())
    with plugged_in(ether):
        ether.let("cf1", "silent", True)
        lost, near = Client(tmp_path), Client(tmp_path)
        lost.cf.open_link(ether.uris["cf1"])
        near.connect(ether.uris["cf2"])
        assert lost.failed.wait(PATIENCE)
        near.cf.close_link()
        lost.cf.close_link()


def test_without_a_dongle_the_connection_fails_at_once(tmp_path: Path) -> None:
    ether = Ether(BUILDS, MemoryLog())
    with plugged_in(ether):
        ether.unplugged = True
        client = Client(tmp_path)
        client.cf.open_link(ether.uris["cf1"])
        assert client.failed.wait(PATIENCE)
        client.cf.close_link()
