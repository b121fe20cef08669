"""Simulated vehicles in a process of their own; what it keeps is the state of each, and their port."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from math import inf
from pathlib import Path
from typing import Any

import msgspec

from ..geodesy import LocalPlane
from ..process.simulator import Simulator
from ..process.surroundings import NOTHING, Surroundings
from ..process.track_server import TrackServer
from ..process.whole_file import write_whole
from ..shared.domain.errors import BadInput
from ..wind import CALM, Wind
from .equipment import Around
from .server import Server, let
from .vehicle import Build, Vehicle

VEHICLES = "autopilot.json"
FLEET = "autopilot-fleet.json"
"""The files in its folder."""

_SIMULATOR = Simulator("autopilot", "simulated vehicles")
uris_in = _SIMULATOR.uris_in
end = _SIMULATOR.end
told = _SIMULATOR.told
"""Asks for `fault` with `drone`, `name` and `value`; `join`, `state`, `tracker`, and what all are asked."""

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
    measures: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    """The names of the values that their companion computers tell, by quantity."""
    surroundings: Surroundings = NOTHING
    wind: Wind = CALM


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
        uris = uris_in(folder)
        if list(uris) == list(fleet.homes)[: len(uris)]:
            told(folder, "join")
            return uris_in(folder)
        end(folder)  # it has other vehicles
    return _SIMULATOR.start(folder, command)


def main(arguments: Sequence[str]) -> int:
    """Run the simulated vehicles of a folder until they are not needed."""
    return _SIMULATOR.main(arguments, FLEET, _Desk)


class _Desk:
    """Serves requests of other processes, and keeps where the vehicles are."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        kept = _kept(folder)
        self._port = int(kept.get("port", 0))
        fleet = self._fleet
        self.server = Server(around=Around(fleet.surroundings, fleet.plane))
        self._tracker = TrackServer(fleet.surroundings.world)
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

    async def start(self) -> None:
        await self.server.start(self._port)

    async def answer(self, request: Mapping[str, object]) -> str:
        match request:
            case {"do": "state"}:
                return json.dumps(self._state())
            case {"do": "tracker"}:
                return await self._tracker.address()
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

    async def close(self) -> None:
        self._tracker.close()
        await self.server.close()
        self.keep()

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
        grips=True,
        senses={name: quantity for quantity, name in fleet.measures.get(id, {}).items()},
        wind=fleet.wind,
    )


def _told(vehicle: Vehicle) -> dict[str, object]:
    record = vehicle.record
    return {
        "at": vehicle.truth,
        "level": vehicle.charge,
        "doing": vehicle.doing.value,
        "armed": vehicle.armed,
        "orders": record.orders,
        "photos": record.photos,
        "grips": record.grips,
        "fell": record.fell,
        "landings": record.landings,
        "overruled": record.overruled,
    }


def _kept(folder: Path) -> dict[str, Any]:
    with suppress(OSError, ValueError):
        kept: dict[str, Any] = json.loads((folder / VEHICLES).read_text(encoding="utf-8"))
        return kept
    return {}
