"""Simulated Crazyflies in a process of their own; what it keeps is the state of each."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import msgspec

from ..process.simulator import Simulator
from ..process.surroundings import NOTHING, Surroundings
from ..process.track_server import TrackServer
from ..process.whole_file import write_whole
from ..shared.domain.errors import BadInput
from .battery import CHARGE, FLIGHT
from .drone import Build, SimulatedCrazyflie
from .equipment import camera, port_of
from .flight_log import FileLog, Point
from .server import HOST, Server

DRONES = "crtp.json"
WORLD = "crtp-world.json"
"""The files in its folder."""

_SIMULATOR = Simulator("crtp", "simulated drones")
uris_in = _SIMULATOR.uris_in
end = _SIMULATOR.end
told = _SIMULATOR.told
"""Asks for `join` with `drone`, `home` and `battery`, `fault` with `drone`, `name` and `value`, `state`, `camera`, `tracker`, and what all are asked."""

Battery = tuple[float, float]
"""The seconds from full to empty in the air, and from empty to full on the pad."""
USUAL: Battery = FLIGHT, CHARGE


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
    return _SIMULATOR.start(folder, command)


def main(arguments: Sequence[str]) -> int:
    """Run the simulated drones of a folder until they are not needed."""
    return _SIMULATOR.main(arguments, DRONES, _Desk)


class _Desk:
    """Serves requests of other processes, and keeps where the drones are."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        kept = _kept(folder)
        self._ports = {id: int(one.get("port", 0)) for id, one in kept.items()}
        self._log = FileLog(folder)
        around = msgspec.json.decode((folder / WORLD).read_bytes(), type=Surroundings)
        self._world = around.world
        builds = [_build(id, number, one) for number, (id, one) in enumerate(kept.items())]
        self.server = Server(builds, self._log, self._world)
        for id, drone in self.server.drones.items():
            _restore(drone, kept[id])
        self._tracker = TrackServer(self._world)
        self._camera: asyncio.Server | None = None

    async def start(self) -> None:
        await self.server.start(self._ports)

    async def answer(self, request: Mapping[str, object]) -> str:
        match request:
            case {"do": "state"}:
                return json.dumps(_state(self.server))
            case {"do": "camera"}:
                self._camera = self._camera or await camera()
                return f"{HOST}:{port_of(self._camera)}"
            case {"do": "tracker"}:
                return await self._tracker.address()
            case {"do": "join", "drone": str(id), "home": list(home), "battery": list(battery)}:
                number = len(self.server.endpoints)
                await self.server.join(_build(id, number, {"home": home, "battery": battery}))
                return f"{id} is there"
            case {"do": "fault", "drone": str(id), "name": str(name), "value": value}:
                if id not in self.server.endpoints:
                    raise BadInput(f"there is no drone {id}")
                if not isinstance(value, bool | int | float | list):
                    raise BadInput(f"{name} cannot be {value!r}")
                try:
                    await self.server.let(id, name, value)
                except ValueError as error:
                    raise BadInput(str(error)) from None
                return f"{id}: {name} is {value}"
        raise BadInput("that cannot be asked of simulated drones")

    def keep(self) -> None:
        self._log.flush()
        _write(self._folder, _state(self.server))

    async def close(self) -> None:
        if self._camera is not None:
            self._camera.close()
        self._tracker.close()
        await self.server.close()
        self._log.close()
        _write(self._folder, _state(self.server))


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
