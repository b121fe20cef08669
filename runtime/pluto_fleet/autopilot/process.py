"""Simulated vehicles in a process of their own, which outlives the program that flies them, as real ones would.

It ends when all are on the ground and nobody speaks to them for a while. When it is started again, they stand where they
were, behind the same port if that is still free.
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
from dataclasses import dataclass
from math import inf
from pathlib import Path
from typing import Any

import msgspec

from ..geodesy import LocalPlane
from ..process import locks, respawn
from ..process.forked import deaf, in_children, not_for_children
from ..process.ipc import NotRunning, answering, ask, listening
from ..process.whole_file import write_whole
from ..shared.domain.errors import BadInput
from .server import Server, let
from .vehicle import Build, Vehicle

NOTE = "autopilot"
VEHICLES = "autopilot.json"
FLEET = "autopilot-fleet.json"
LOCK = "autopilot.lock"
LOG = "autopilot.log"
"""The files in its folder; NOTE has the address for `ask`."""
COMMAND = "autopilot"

GATEWAY_LOCK = "lock"
"""The lock file of the flight's gateway in this folder."""
_IDLE = 60.0
"""Seconds without a vehicle in the air and without a packet, after which it ends."""
_PATIENCE = 10.0
"""The time-out of a start or an answer, in seconds."""
_LOOK = 1.0

Point = tuple[float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class SimulatedFleet:
    """The vehicles that are to be simulated."""

    plane: LocalPlane
    homes: Mapping[str, Point]
    """Their homes on the map, by their names."""
    makes: Mapping[str, str]
    """`px4` or `ardupilot`."""
    flights: Mapping[str, float]
    """Seconds in the air from full to empty."""
    charges: Mapping[str, float | None]
    """Seconds on the ground from empty to full; None: they do not charge."""


_STARTED: dict[Path, subprocess.Popen[bytes]] = {}
"""The processes started by this one, by folder; reaped by `end`."""

_FOR_APPS = "autopilot: an app starts this by itself when it flies; there is nothing to do by hand"


def start(
    folder: Path, fleet: SimulatedFleet, command: Sequence[str] | None = None
) -> dict[str, str]:
    """Start the simulated vehicles of a folder, unless they run; return their URIs.

    To those that run further ones are added. Raises `BadInput` if they cannot be started. `command` starts them, with the
    folder appended; default: the library's own program.
    """
    folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    write_whole(folder / FLEET, msgspec.json.encode(fleet).decode())
    with suppress(BadInput):
        if list(uris_in(folder)) == list(fleet.homes)[: len(uris_in(folder))]:
            told(folder, "join")
            return uris_in(folder)
        end(folder)  # it has other vehicles
    words = [*(command or respawn.library(COMMAND)), str(folder)]
    process = respawn.start(words, folder / LOG)
    _STARTED[folder] = process
    until = time.monotonic() + _PATIENCE
    while time.monotonic() < until and process.poll() is None:
        with suppress(NotRunning):
            return uris_in(folder)
        time.sleep(0.01)
    raise BadInput(f"the simulated vehicles did not start; what they said is in {folder / LOG}")


def uris_in(folder: Path) -> dict[str, str]:
    """Return the vehicles' URIs; raise `BadInput` if none run for this folder."""
    uris: dict[str, str] = json.loads(told(folder, "uris"))
    return uris


def told(folder: Path, do: str, **more: object) -> str:
    """Send a request to the simulated vehicles of a folder; raise `BadInput` if it is refused.

    `fault` with `drone`, `name` and `value`; `join`, `state`, `uris`, `end`.
    """
    return ask(folder / NOTE, {"do": do, **more}, _PATIENCE)


def end(folder: Path) -> None:
    """End the simulated vehicles of a folder, if there are any."""
    until = time.monotonic() + _PATIENCE
    with suppress(BadInput):
        while time.monotonic() < until:
            told(folder, "end")
            time.sleep(0.02)
    process = _STARTED.pop(folder, None)
    if process is not None:
        process.wait(_PATIENCE)


def main(arguments: Sequence[str]) -> int:
    """Run the simulated vehicles of a folder until they are not needed."""
    folder = Path(*arguments[:1])
    if len(arguments) != 1 or not os.path.isfile(folder / FLEET):
        print(_FOR_APPS, file=sys.stderr)
        return 2
    with (folder / LOCK).open("a") as lock:
        not_for_children(lock.fileno())
        fcntl.flock(lock, fcntl.LOCK_EX)  # another one is ending
        asyncio.run(_run(folder))
    return 0


async def _run(folder: Path) -> None:
    desk = _Desk(folder)
    over = desk.over
    for number in (signal.SIGTERM, signal.SIGINT):
        asyncio.get_running_loop().add_signal_handler(number, over.set)
    no_more = in_children(deaf)
    signal.signal(signal.SIGHUP, signal.SIG_IGN)
    server = desk.server
    await server.start(desk.port)
    try:
        async with listening(folder / NOTE, answering(desk.answer)):
            while not over.is_set():
                desk.keep()
                # while this folder's gateway runs, vehicles on the ground are still asked how they are
                is_flown = locks.is_taken(folder / GATEWAY_LOCK)
                if server.quiet > _IDLE and not server.airborne and not is_flown:
                    break
                with suppress(TimeoutError):
                    async with asyncio.timeout(_LOOK):
                        await over.wait()
    finally:
        no_more()
        await server.close()
        desk.keep()


class _Desk:
    """Serves requests of other processes, and keeps where the vehicles are."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self.over = asyncio.Event()
        kept = _kept(folder)
        self.port = int(kept.get("port", 0))
        self.server = Server()
        self._join(kept.get("vehicles", {}))

    @property
    def _fleet(self) -> SimulatedFleet:
        return msgspec.json.decode((self._folder / FLEET).read_bytes(), type=SimulatedFleet)

    def _join(self, kept: Mapping[str, Mapping[str, Any]]) -> None:
        """Have those of the fleet that are not there yet."""
        fleet = self._fleet
        for number, (id, home) in enumerate(fleet.homes.items(), 1):
            if id in self.server.vehicles:
                continue
            vehicle = self.server.join(_build(fleet, id, number, home))
            known = kept.get(id, {})
            vehicle.charge = known.get("level", 1.0)
            east, north, _ = known.get("at", (0.0, 0.0, 0.0))
            vehicle.body.at[:] = [east, north, 0.0]  # those in the air have fallen meanwhile

    async def answer(self, request: Mapping[str, object]) -> str:
        match request:
            case {"do": "uris"}:
                return json.dumps(self.server.uris)
            case {"do": "state"}:
                return json.dumps(self._state())
            case {"do": "end"}:
                self.over.set()
                return "it ends"
            case {"do": "join"}:
                self._join({})
                return "they are there"
            case {"do": "fault", "drone": str(id), "name": str(name), "value": value}:
                if id not in self.server.vehicles:
                    raise BadInput(f"there is no drone {id}")
                if not isinstance(value, bool | int | float | str):
                    raise BadInput(f"{name} cannot be {value!r}")
                try:
                    let(self.server.vehicles[id], name, value)
                except ValueError as error:
                    raise BadInput(str(error)) from None
                return f"{id}: {name} is {value}"
        raise BadInput("that cannot be asked of simulated vehicles")

    def keep(self) -> None:
        with suppress(OSError):
            write_whole(self._folder / VEHICLES, json.dumps(self._state()))

    def _state(self) -> dict[str, Any]:
        vehicles = {id: _told(vehicle) for id, vehicle in self.server.vehicles.items()}
        return {"port": self.server.port, "vehicles": vehicles}


def _build(fleet: SimulatedFleet, id: str, number: int, home: Point) -> Build:
    charge = fleet.charges.get(id)
    return Build(
        id=id,
        system=number,
        make=fleet.makes[id],
        home=fleet.plane.to_degrees(home),
        flight=fleet.flights[id],
        charge=inf if charge is None else charge,
    )


def _told(vehicle: Vehicle) -> dict[str, object]:
    record = vehicle.record
    return {
        "at": vehicle.body.at,
        "level": vehicle.charge,
        "doing": vehicle.doing.value,
        "armed": vehicle.armed,
        "orders": record.orders,
        "photos": record.photos,
        "fell": record.fell,
        "landings": record.landings,
    }


def _kept(folder: Path) -> dict[str, Any]:
    with suppress(OSError, ValueError):
        kept: dict[str, Any] = json.loads((folder / VEHICLES).read_text(encoding="utf-8"))
        return kept
    return {}
