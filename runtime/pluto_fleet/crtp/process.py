"""Simulated drones in a process of their own, which outlives the program that flies them, as real ones would.

It ends when all are on the ground and without a packet for a while. When it is started again, the drones are
where they were, at the same ports if those are still free.
"""

from __future__ import annotations

import asyncio
import fcntl
import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import msgspec

from ..process import locks, respawn
from ..process.forked import deaf, in_children, not_for_children
from ..process.ipc import NotRunning, answering, ask, listening
from ..process.whole_file import write_whole
from ..shared.domain.airspace import Airspace
from ..shared.domain.errors import BadInput
from ..shared.domain.fleet_data import WorldData
from ..shared.events.world import MovingWorld
from .battery import CHARGE, FLIGHT
from .drone import Build, SimulatedCrazyflie
from .equipment import camera, port_of, tracker
from .flight_log import FileLog, Point
from .server import HOST, Server

NOTE = "crtp"
DRONES = "crtp.json"
WORLD = "crtp-world.json"
LOCK = "crtp.lock"
LOG = "crtp.log"
"""The files in its folder; NOTE has the address for `ask`."""
COMMAND = "crtp"

GATEWAY_LOCK = "lock"
"""The lock file of the flight's gateway in this folder."""
_IDLE = 60.0
"""Seconds without a drone in the air and without a packet, after which it ends."""
_PATIENCE = 10.0
"""The time-out of a start or an answer, in seconds."""
_LOOK = 1.0

Battery = tuple[float, float]
"""The seconds from full to empty in the air, and from empty to full on the pad."""
USUAL: Battery = FLIGHT, CHARGE


@dataclass(frozen=True, slots=True, kw_only=True)
class Surroundings:
    """What there is to measure around simulated drones."""

    seed: int = 0
    data: WorldData = field(default_factory=WorldData)

    @property
    def world(self) -> MovingWorld:
        """The same as simulated drones of a gateway are in."""
        return MovingWorld(self.seed, Airspace(), self.data)


NOTHING = Surroundings()

_STARTED: dict[Path, subprocess.Popen[bytes]] = {}
"""The processes started by this one, by folder; reaped by `end`."""

_FOR_APPS = "crtp: an app starts this by itself when it flies; there is nothing to do by hand"


def start(
    folder: Path,
    homes: Mapping[str, Point],
    command: Sequence[str] | None = None,
    batteries: Mapping[str, Battery] | None = None,
    world: Surroundings = NOTHING,
) -> dict[str, str]:
    """Start the simulated drones of a folder, unless they run; return their URIs.

    To those that run further ones are added. `batteries`: those that last and charge otherwise than usually. Raises `BadInput` if they cannot be started. `command` starts them, with the folder appended;
    default: the library's own program.
    """
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    with suppress(BadInput):
        uris = uris_in(folder)
        if list(uris) == list(homes)[: len(uris)]:
            for id in list(homes)[len(uris) :]:
                battery = (batteries or {}).get(id, USUAL)
                told(folder, "join", drone=id, home=homes[id], battery=battery)
            return uris_in(folder)
        end(folder)  # it has other drones
    kept = _kept(folder)
    drones = {
        id: {**kept.get(id, {}), "home": home, "battery": (batteries or {}).get(id, USUAL)}
        for id, home in homes.items()
    }
    _write(folder, drones)
    (folder / WORLD).write_bytes(msgspec.json.encode(world))
    words = [*(command or respawn.library(COMMAND)), str(folder)]
    process = respawn.start(words, folder / LOG)
    _STARTED[folder] = process
    until = time.monotonic() + _PATIENCE
    while time.monotonic() < until and process.poll() is None:
        with suppress(NotRunning):
            return uris_in(folder)
        time.sleep(0.01)
    raise BadInput(f"the simulated drones did not start; what they said is in {folder / LOG}")


def uris_in(folder: Path) -> dict[str, str]:
    """Return the drones' URIs; raise `BadInput` if none run for this folder."""
    uris: dict[str, str] = json.loads(told(folder, "uris"))
    return uris


def told(folder: Path, do: str, **more: object) -> str:
    """Send a request to the simulated drones of a folder; raise `BadInput` if it is refused.

    `join` with `drone`, `home` and `battery`, `fault` with `drone`, `name` and `value`, `state`, `uris`,
    `camera`, `tracker`, `end`.
    """
    return ask(folder / NOTE, {"do": do, **more}, _PATIENCE)


def end(folder: Path) -> None:
    """End the simulated drones of a folder, if there are any."""
    until = time.monotonic() + _PATIENCE
    with suppress(BadInput):
        while time.monotonic() < until:
            told(folder, "end")
            time.sleep(0.02)
    process = _STARTED.pop(folder, None)
    if process is not None:
        process.wait(_PATIENCE)


def main(arguments: Sequence[str]) -> int:
    """Run the simulated drones of a folder until they are not needed."""
    folder = Path(*arguments[:1])
    if len(arguments) != 1 or not os.path.isfile(folder / DRONES):
        print(_FOR_APPS, file=sys.stderr)
        return 2
    with (folder / LOCK).open("a") as lock:
        not_for_children(lock.fileno())
        fcntl.flock(lock, fcntl.LOCK_EX)  # another one is ending
        asyncio.run(_run(folder))
    return 0


async def _run(folder: Path) -> None:
    kept, log = _kept(folder), FileLog(folder)
    around = msgspec.json.decode((folder / WORLD).read_bytes(), type=Surroundings)
    builds = [_build(id, number, one) for number, (id, one) in enumerate(kept.items())]
    world = around.world
    server = Server(builds, log, world)
    for id, drone in server.drones.items():
        _restore(drone, kept[id])
    over = asyncio.Event()
    for number in (signal.SIGTERM, signal.SIGINT):
        asyncio.get_running_loop().add_signal_handler(number, over.set)
    no_more = in_children(deaf)
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    await server.start({id: int(one.get("port", 0)) for id, one in kept.items()})
    desk = _Desk(server, world, over)
    try:
        async with listening(folder / NOTE, answering(desk.answer)):
            while not over.is_set():
                log.flush()
                _write(folder, _state(server))
                # while this folder's gateway runs, drones on the ground still send telemetry
                is_flown = locks.is_taken(folder / GATEWAY_LOCK)
                if server.quiet > _IDLE and not server.airborne and not is_flown:
                    break
                with suppress(TimeoutError):
                    async with asyncio.timeout(_LOOK):
                        await over.wait()
    finally:
        no_more()
        await desk.close()
        await server.close()
        log.close()
        _write(folder, _state(server))


class _Desk:
    """Serves requests of other processes."""

    def __init__(self, server: Server, world: MovingWorld, over: asyncio.Event) -> None:
        self._server = server
        self._world = world
        self._over = over
        self._began = time.monotonic()
        self._camera: asyncio.Server | None = None
        self._tracker: asyncio.Server | None = None

    async def answer(self, request: Mapping[str, object]) -> str:
        match request:
            case {"do": "uris"}:
                return json.dumps(self._server.uris)
            case {"do": "state"}:
                return json.dumps(_state(self._server))
            case {"do": "end"}:
                self._over.set()
                return "it ends"
            case {"do": "camera"}:
                self._camera = self._camera or await camera()
                return f"{HOST}:{port_of(self._camera)}"
            case {"do": "tracker"}:
                self._tracker = self._tracker or await tracker(self._tracks)
                return f"{HOST}:{port_of(self._tracker)}"
            case {"do": "join", "drone": str(id), "home": list(home), "battery": list(battery)}:
                number = len(self._server.endpoints)
                await self._server.join(_build(id, number, {"home": home, "battery": battery}))
                return f"{id} is there"
            case {"do": "fault", "drone": str(id), "name": str(name), "value": value}:
                if id not in self._server.endpoints:
                    raise BadInput(f"there is no drone {id}")
                if not isinstance(value, bool | int | float | list):
                    raise BadInput(f"{name} cannot be {value!r}")
                try:
                    await self._server.let(id, name, value)
                except ValueError as error:
                    raise BadInput(str(error)) from None
                return f"{id}: {name} is {value}"
        raise BadInput("that cannot be asked of simulated drones")

    def _tracks(self) -> Mapping[str, Any]:
        return self._world.tracks(time.monotonic() - self._began)

    async def close(self) -> None:
        for served in (self._camera, self._tracker):
            if served is not None:
                served.close()


def _build(id: str, number: int, data: Mapping[str, Any]) -> Build:
    x, y, *_ = data["home"]
    flight, charge = data.get("battery", USUAL)
    return Build(
        id=id,
        home=(x, y, 0.0),
        seed=number,
        level=data.get("level", 1.0),
        flight=flight,
        charge=charge,
    )


def _restore(drone: SimulatedCrazyflie, data: Mapping[str, Any]) -> None:
    if "at" in data:
        x, y, _ = data["at"]
        drone.body.place((x, y, 0.0))  # drones in the air have fallen meanwhile
        drone.body.yaw = data["yaw"]


def _state(server: Server) -> dict[str, dict[str, object]]:
    return {
        id: {
            "home": endpoint.drone.build.home,
            "battery": (endpoint.drone.build.flight, endpoint.drone.build.charge),
            "port": endpoint.port,
            "at": endpoint.drone.body.position,
            "yaw": endpoint.drone.body.yaw,
            "level": endpoint.drone.carried.battery_level,
            "airborne": endpoint.drone.body.airborne,
            "info": endpoint.drone.info(),
        }
        for id, endpoint in server.endpoints.items()
    }


def _kept(folder: Path) -> dict[str, dict[str, Any]]:
    with suppress(OSError, ValueError):
        kept: dict[str, dict[str, Any]] = json.loads((folder / DRONES).read_text(encoding="utf-8"))
        return kept
    return {}


def _write(folder: Path, drones: Mapping[str, Mapping[str, object]]) -> None:
    with suppress(OSError):
        write_whole(folder / DRONES, json.dumps(drones))
