"""Cases that are flown through MAVSDK in real time, each with a simulated vehicle of its own, all at once."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import replace

from pluto_fleet.autopilot.server import Server, let
from pluto_fleet.autopilot.vehicle import Vehicle
from pluto_fleet.drones.protocol import DroneSetup
from pluto_fleet.mavlink.navigation import MavlinkVehicle

Case = Callable[[MavlinkVehicle, Vehicle], Awaitable[None]]
Cases = Mapping[Case, dict[str, object]]
"""With the options of its vehicle, which is called as it is."""
_LONGEST = 90.0
"""Seconds that a case may take."""


async def came_of(
    cases: Cases, server: Server, setup: DroneSetup, *, connects: bool = False
) -> list[BaseException | None]:
    """Fly each case with its vehicle of a server; return what came of it.

    `setup`: that of all, but for what is each one's own; `connects`: each is connected to before.
    """
    await server.start()
    flown = [
        MavlinkVehicle(
            replace(setup, id=case.__name__, uri=server.uris[case.__name__], options=options)
        )
        for case, options in cases.items()
    ]

    async def fly(case: Case, flies: MavlinkVehicle) -> None:
        async with asyncio.timeout(_LONGEST):
            if connects:
                await flies.connect()
            await case(flies, server.vehicles[case.__name__])

    try:
        flights = (fly(*one) for one in zip(cases, flown, strict=True))
        return await asyncio.gather(*flights, return_exceptions=True)
    finally:
        for vehicle in server.vehicles.values():
            let(vehicle, "silent", False)  # so that it can be landed
        await asyncio.gather(*(flies.close() for flies in flown), return_exceptions=True)
        await server.close()
