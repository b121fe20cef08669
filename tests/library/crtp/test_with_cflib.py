"""The unmodified cflib, with its own threads, meets simulated drones over UDP."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from threading import Event, Thread
from typing import Any

import pytest

from pluto_fleet.crtp.drone import Build
from pluto_fleet.crtp.flight_log import MemoryLog
from pluto_fleet.crtp.server import Server

pytest.importorskip("cflib")

PATIENCE = 10.0


@pytest.fixture
def uri() -> Iterator[str]:
    """A drone that lives in a loop of its own."""
    loop, server = asyncio.new_event_loop(), Server([Build(id="cf1", home=(3, 2, 0))], MemoryLog())
    thread = Thread(target=loop.run_forever, daemon=True)
    thread.start()
    asyncio.run_coroutine_threadsafe(server.start(), loop).result(PATIENCE)
    yield server.uris["cf1"]
    asyncio.run_coroutine_threadsafe(server.close(), loop).result(PATIENCE)
    loop.call_soon_threadsafe(loop.stop)
    thread.join()
    loop.close()


def test_cflib_connects_logs_sets_and_commands(uri: str, tmp_path: Path) -> None:
    crtp = import_module("cflib.crtp")
    connected, changed, answered = Event(), Event(), Event()
    if not crtp.CLASSES:
        crtp.init_drivers()
    cf: Any = import_module("cflib.crazyflie").Crazyflie(rw_cache=str(tmp_path))
    cf.fully_connected.add_callback(lambda _: connected.set())
    cf.open_link(uri)
    try:
        assert connected.wait(PATIENCE)
        assert cf.platform.get_protocol_version() == 12
        told = logged(cf, "stateEstimate.x", "stateEstimate.y", "pm.vbat", "supervisor.info")
        assert told["stateEstimate.x"] == 3.0 and told["pm.vbat"] == pytest.approx(4.18)
        cf.param.add_update_callback("gripper", "closed", lambda *_: changed.set())
        cf.param.set_value("gripper.closed", 1)
        assert changed.wait(PATIENCE)
        assert cf.param.get_value("gripper.closed") == "1"
        cf.add_port_callback(8, lambda _: answered.set())
        cf.high_level_commander.takeoff(0.5, 1.0, yaw=None)
        assert answered.wait(PATIENCE)
    finally:
        cf.close_link()


def logged(cf: Any, *names: str) -> dict[str, float]:
    """Return the values of some variables."""
    block = import_module("cflib.crazyflie.log").LogConfig("some", 50)
    heard, values = Event(), dict[str, float]()
    for name in names:
        block.add_variable(name)

    def hear(_: int, told: dict[str, float], __: object) -> None:
        values.update(told)
        heard.set()

    block.data_received_cb.add_callback(hear)
    cf.log.add_config(block)
    block.start()
    assert heard.wait(PATIENCE)
    return values
