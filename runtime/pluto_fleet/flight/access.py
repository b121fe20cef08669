"""How a flight reaches the gateway of its drones, or starts one."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING, Any

from ..drones.real_fleet import real_fleet
from ..files.fleet import not_real
from ..files.stand_ins import CRTP
from ..gateway.settings import Settings, joining_data, settings_for
from ..gateway.starting import connect
from ..journal.place import gateway_folder
from ..process import respawn
from ..shared.domain.actions import MEASURE
from ..shared.domain.errors import BadInput
from ..wind import CALM

if TYPE_CHECKING:
    from pathlib import Path

    from ..drones.real_fleet import RealFleet
    from ..files.fleet import FleetFile
    from ..jobs.link import Link
    from ..process.realtime import RealTime
    from ..process.surroundings import Surroundings
    from .config import FlightSetup


class GatewayAccess:
    """The gateway of a flight, which may be another one in each of its runs."""

    def __init__(self, flight: FlightSetup, records: Sequence[Mapping[str, Any]] = ()) -> None:
        """`records` are the missions of an earlier run, whose actions the drones must be capable of, too."""
        self._flight = flight
        self._records = records
        self._folder = gateway_folder(flight.journal)

    async def link(
        self, kernel: RealTime, fleet: FleetFile, epoch: int, lost: Callable[[], object]
    ) -> Link:
        """Connect to the gateway, or start it; `lost` is called if it dies."""
        command = respawn.library("gateway", beside=self._flight.app.package)
        settings = await self._settings(fleet)
        return await connect(self._folder, settings, kernel, epoch, lost, command)

    async def joining(self, fleet: FleetFile) -> Mapping[str, object]:
        """Return the last drone of a fleet, as the gateway takes it in; raise `BadInput` if it cannot fly."""
        flight = self._flight
        if not flight.sim and not flight.stand_ins and (why := not_real(fleet)):
            raise BadInput(why)
        settings = await self._settings(fleet)
        real = None if settings.real is None else settings.real.drones[-1]
        return joining_data(settings.drones[-1], real)

    async def _settings(self, fleet: FleetFile) -> Settings:
        flight = self._flight
        return settings_for(
            flight.app,
            fleet,
            seed=flight.seed,
            faults=flight.faults,
            real=None if flight.sim else await self._real(fleet),
            speed=flight.speed,
        )

    async def _real(self, fleet: FleetFile) -> RealFleet:
        """Return the gateway's arguments for real drones; starts those that stand in for them if needed."""
        flight = self._flight
        real = real_fleet(fleet, flight.missions, records=self._records)
        if flight.stand_ins is None:
            return real
        if flight.stand_ins.kind == CRTP:
            return await self._crazyflies(fleet, real)
        return await self._vehicles(fleet, real)

    def _batteries(self, fleet: FleetFile) -> Mapping[str, tuple[float, float]]:
        """Return for each drone the seconds from full to empty in the air, and from empty to full."""
        flight = self._flight
        kinds = {one.name: one for one in flight.app.categories}
        return {
            drone.id: (
                kind.flight_time / flight.fleet.motion.drain,
                kind.charge_time if flight.charges else inf,
            )
            for drone in fleet.drones
            for kind in (kinds[drone.category],)
        }

    def _surroundings(self, fleet: FleetFile) -> Surroundings:
        """Return what there is around simulated drones, as the fleet file says or the seed has it."""
        from ..process.surroundings import Surroundings  # rarely needed
        from ..shared.alone.world import invented

        seed = self._flight.seed
        data = invented(seed, fleet.airspace) if fleet.world is None else fleet.world
        return Surroundings(seed=seed, data=data)

    async def _vehicles(self, fleet: FleetFile, real: RealFleet) -> RealFleet:
        """Start simulated vehicles that speak MAVLink."""
        from ..autopilot.equipment import fitted, sensors
        from ..autopilot.process import SimulatedFleet, start, told  # rarely needed

        assert fleet.plane is not None
        batteries = self._batteries(fleet)
        around = self._surroundings(fleet)
        kinds = {one.name: one for one in self._flight.app.categories}
        can = {one.id for one in fleet.drones if kinds[one.category].can(MEASURE)}
        measures = {
            one.id: sensors(one.options, around.world) if one.id in can else {}
            for one in real.drones
        }
        wind = CALM if fleet.wind is None else replace(fleet.wind, seed=self._flight.seed)
        simulated = SimulatedFleet(
            plane=fleet.plane,
            homes={drone.id: drone.home for drone in fleet.drones},
            makes={drone.id: str(drone.options.get("autopilot", "px4")) for drone in real.drones},
            flights={id: flight for id, (flight, _) in batteries.items()},
            charges={
                id: None if charge == inf else charge for id, (_, charge) in batteries.items()
            },
            measures=measures,
            surroundings=around,
            wind=wind,
        )
        uris = await asyncio.to_thread(start, self._folder, simulated)
        drones = (
            replace(one, uri=uris[one.id], options=fitted(one.options, measures[one.id]))
            for one in real.drones
        )
        return await self._tracked(replace(real, drones=tuple(drones)), around, told)

    async def _crazyflies(self, fleet: FleetFile, real: RealFleet) -> RealFleet:
        """Start simulated Crazyflies."""
        from ..crtp.equipment import fitted, settable
        from ..crtp.process import start, told  # rarely needed

        homes = {drone.id: drone.home for drone in fleet.drones}
        batteries = self._batteries(fleet)
        around = self._surroundings(fleet)
        uris = await asyncio.to_thread(start, self._folder, homes, None, batteries, around)
        camera = await asyncio.to_thread(told, self._folder, "camera")
        drones = (
            replace(
                drone,
                uri=uris[drone.id],
                options=fitted(drone.options, camera, around.world),
                parameters=settable(drone.parameters),
            )
            for drone in real.drones
        )
        return await self._tracked(replace(real, drones=tuple(drones)), around, told)

    async def _tracked(
        self, real: RealFleet, around: Surroundings, told: Callable[[Path, str], str]
    ) -> RealFleet:
        """Return a fleet with what tracks what moves there, if anything does; `told` asks the simulated drones."""
        if not around.data.movers:
            return real
        address = await asyncio.to_thread(told, self._folder, "tracker")
        return replace(real, tracker="lines", tracker_options={"address": address})
