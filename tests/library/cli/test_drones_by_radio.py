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

from pluto_fleet.crtp.drone import Build
from pluto_fleet.crtp.flight_log import MemoryLog
from pluto_fleet.crtp.server import Server
from pluto_fleet.files.fleet import load_fleet
from tests.kill.lives import eventually
from tests.library.cli.conftest import Command
from tests.library.crtp.radio import Ether, plugged_in
from tests.library.files.an_app import APP

pytest.importorskip("cflib")

HARMLESS = {"asked", "set led.bitmask", "fault lock"}
"""What may be done to a drone that shall neither be armed nor moved."""


@dataclass(frozen=True, slots=True)
class Air:
    """Three simulated Crazyflies, in a loop of their own."""

    loop: asyncio.AbstractEventLoop
    server: Server
    record: MemoryLog

    def done(self, coroutine: Coroutine[object, object, None]) -> None:
        """Do something in their loop."""
        future: Future[None] = asyncio.run_coroutine_threadsafe(coroutine, self.loop)
        future.result(10.0)

    @property
    def uris(self) -> list[str]:
        """Where each is reached."""
        return list(self.server.uris.values())


@pytest.fixture(autouse=True)
def _own_folders(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Keep nothing in the user's own."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    monkeypatch.setenv("XDG_RUNTIME_DIR", str(tmp_path))


@pytest.fixture
def air() -> Iterator[Air]:
    """Drones that answer; asked anything, none is armed, and none moves."""
    record, loop = MemoryLog(), asyncio.new_event_loop()
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
    assert [command for command in record.commands if command.what not in HARMLESS] == []
    assert not any(drone.body.airborne for drone in server.drones.values())


@pytest.mark.long
def test_crazyflies_say_how_they_are(air: Air, command: Command) -> None:
    """Where they stand, what their batteries have, what they run; a silent one delays no other."""
    air.done(air.server.let("cf2", "lock"))
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as silence:
        silence.bind(("127.0.0.1", 0))  # takes what comes, and never answers
        silent = f"udp://127.0.0.1:{silence.getsockname()[1]}"
        code, out, err = command("drones", *air.uris, silent, "--json")
    told = json.loads(out)["drones"]
    assert (code, [drone["ready"] for drone in told]) == (1, [True, False, True, False])
    assert "lock" in " ".join(told[1]["problems"])
    assert "answer" in " ".join(told[3]["problems"])
    assert [round(along, 1) for along in told[2]["position"]] == [3.0, 1.0, 0.0]
    assert 3.0 < told[0]["voltage"] < 4.3
    assert told[0]["facts"]["firmware"]
    assert "Traceback" not in err


def test_a_fleet_file_is_made_of_crazyflies(air: Air, command: Command, tmp_path: Path) -> None:
    """With their uris, and their homes where they stand."""
    path = tmp_path / "fleet.toml"
    assert command("drones", *air.uris, "--save", path)[0] == 0
    fleet = load_fleet(path, APP)
    assert [drone.uri for drone in fleet.drones] == air.uris
    for number, drone in enumerate(fleet.drones, start=1):
        assert drone.home == pytest.approx((float(number), 1.0, 0.0), abs=0.1)


@pytest.mark.long
def test_one_blinks(air: Air, command: Command) -> None:
    """And nothing else is done to it."""
    code, out, _ = command("drones", "--identify", air.uris[1])
    assert (code, out) == (0, f"{air.uris[1]} has shown itself\n")
    assert {command.drone for command in air.record.commands} <= {"cf2"}


def test_crazyflies_are_found_by_radio(command: Command) -> None:
    """At the addresses that are named; without a dongle it is said what is missing."""
    record = MemoryLog()
    builds = [Build(id=f"cf{n}", home=(float(n), 1.0, 0.0), seed=n) for n in (1, 2)]
    ether = Ether(builds, record)
    with plugged_in(ether):
        words = ["drones", "--address", "E7E7E7E701", "--address", "E7E7E7E702"]
        code, out, err = command(*words)
        assert code == 0, out
        assert [line.split()[1] for line in out.splitlines()[1:3]] == list(ether.uris.values())
        assert eventually(lambda: not ether.is_open)  # cflib closes it in a thread of its own
        ether.unplugged = True
        code, out, err = command(*words)
        assert (code, out) == (2, "")
        assert "no Crazyradio is plugged in" in err
        assert "Traceback" not in err
    assert {command.what for command in record.commands} <= HARMLESS
