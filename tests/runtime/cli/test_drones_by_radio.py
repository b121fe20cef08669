"""`drones` with cflib itself, and simulated Crazyflies at the other end."""

from __future__ import annotations

import asyncio
import json
import socket
from collections.abc import Coroutine, Iterator
from concurrent.futures import Future
from dataclasses import dataclass
from pathlib import Path
from threading import Thread

import pytest

from plutoc_runtime.crtp.drone import Build
from plutoc_runtime.crtp.record import InMemory
from plutoc_runtime.crtp.server import Server
from plutoc_runtime.files.fleet import load_fleet
from tests.runtime.cli.conftest import Command
from tests.runtime.files.an_app import APP

HARMLESS = {"asked", "set led.bitmask", "fault lock"}
"""What may be done to a drone that shall neither be armed nor moved."""


@dataclass(frozen=True, slots=True)
class Air:
    """Three simulated Crazyflies, in a loop of their own."""

    loop: asyncio.AbstractEventLoop
    server: Server
    record: InMemory

    def done(self, coroutine: Coroutine[object, object, None]) -> None:
        """Do something in their loop."""
        future: Future[None] = asyncio.run_coroutine_threadsafe(coroutine, self.loop)
        future.result(10.0)

    @property
    def uris(self) -> list[str]:
        """Where each is reached."""
        return list(self.server.uris.values())


@pytest.fixture
def air(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Air]:
    """Drones that answer; whatever is asked of them, none is armed, and none moves."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))
    record, loop = InMemory(), asyncio.new_event_loop()
    builds = [Build(id=f"cf{n}", home=(float(n), 1.0, 0.0), seed=n) for n in (1, 2, 3)]
    server = Server(builds, record)
    thread = Thread(target=loop.run_forever, daemon=True)
    thread.start()
    there = Air(loop, server, record)
    there.done(server.start())
    yield there
    there.done(server.close())
    loop.call_soon_threadsafe(loop.stop)
    thread.join()
    loop.close()
    assert [deed for deed in record.deeds if deed.what not in HARMLESS] == []
    assert not any(drone.body.airborne for drone in server.drones.values())


def test_crazyflies_say_how_they_are(air: Air, command: Command) -> None:
    """Where they stand, what their batteries have, what they run; one is not well."""
    air.done(air.server.let("cf2", "lock"))
    code, out, err = command("drones", *air.uris, "--json")
    first, second, third = json.loads(out)["drones"]
    assert (code, first["ready"], third["ready"], second["ready"]) == (1, True, True, False)
    assert "lock" in " ".join(second["problems"])
    assert [round(along, 1) for along in third["position"]] == [3.0, 1.0, 0.0]
    assert 3.0 < first["voltage"] < 4.3
    assert first["facts"]["firmware"]
    assert "Traceback" not in err


def test_one_that_is_not_there_delays_nobody(air: Air, command: Command) -> None:
    """Its row says so."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as nobody:
        nobody.bind(("127.0.0.1", 0))  # takes what comes, and never answers
        silent = f"udp://127.0.0.1:{nobody.getsockname()[1]}"
        code, out, _ = command("drones", air.uris[0], silent)
    ready, lost = out.splitlines()[1:3]
    assert (code, ready.split("  ")[-1]) == (1, "ready")
    assert "answer" in lost


def test_a_fleet_file_is_made_of_crazyflies(air: Air, command: Command, tmp_path: Path) -> None:
    """With their uris, and their homes where they stand."""
    path = tmp_path / "fleet.toml"
    assert command("drones", *air.uris, "--save", path)[0] == 0
    fleet = load_fleet(path, APP)
    assert [drone.uri for drone in fleet.drones] == air.uris
    for number, drone in enumerate(fleet.drones, start=1):
        assert drone.home == pytest.approx((float(number), 1.0, 0.0), abs=0.1)
    assert command("drones", "--fleet", path)[0] == 0


def test_one_blinks(air: Air, command: Command) -> None:
    """And nothing else is done to it."""
    code, out, _ = command("drones", "--identify", air.uris[1])
    assert (code, out) == (0, f"{air.uris[1]} has shown itself\n")
    assert {deed.drone for deed in air.record.deeds} <= {"cf2"}
