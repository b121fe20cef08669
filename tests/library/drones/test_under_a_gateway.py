"""Real drones behind the gateway: jobs, failures, and what is done without a brain."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

import pytest

from pluto_fleet.drones.real_fleet import RealFleet
from pluto_fleet.gateway.gateway import Gateway
from pluto_fleet.gateway.process import LINGERS, Ending
from pluto_fleet.gateway.server import Server
from pluto_fleet.jobs.controls import FleetDrone, TakeOff
from pluto_fleet.process.ipc import line
from pluto_fleet.shared.domain.model import Point
from pluto_fleet.shared.time.kernel import Future
from tests.kit.drones import FakeDrone, the_loop
from tests.library.drones.teams import FIELD, Flown, flying
from tests.library.gateway.flights import Commander, Task
from tests.library.gateway.processes import settings

PATIENCE = 6.0
NO_DRONES = RealFleet(drones=(), localization="own", localization_options={})


@asynccontextmanager
async def commanded(
    folder: Path, count: int, patience: float | None = None
) -> AsyncIterator[tuple[Flown, Gateway]]:
    """Begin a gateway over some fake drones, and query the drones."""
    drones = [FakeDrone(f"cf{i}", (float(i), 1.0, 0.0)) for i in range(1, count + 1)]
    async with flying(folder, *drones) as flown:
        crafts = [
            FleetDrone(id=one.id, category=one.category, home=one.home, index=index)
            for index, one in enumerate(flown.crafts)
        ]
        gateway = Gateway(
            flown.kernel,
            flown.team,
            crafts,
            FIELD,
            apart=0.5,
            slack=0.15,
            patience=patience,
        )
        try:
            yield flown, gateway
        finally:
            for task in list(flown.kernel.tasks):
                flown.kernel.post(task.cancel)


def measuring(drone: str, there: Point) -> Task:
    return Task(id=f"Field/{drone}/0/1", drone=drone, stops=(there,), action="measure", item=None)


async def test_without_a_brain_all_land_and_a_silent_one_delays_no_other(tmp_path: Path) -> None:
    """When it is back, and still not commanded, it lands, too."""
    async with commanded(tmp_path, 3, PATIENCE) as (flown, gateway):
        link = Commander(gateway.link(1))
        lost = flown.drones["cf2"]
        await flown.do(link.fleet_report())
        for id in flown.drones:
            link.heartbeat()
            await flown.do(flown.team.do(id, TakeOff(1.2)))
        lost.goes_silent()
        others = [flown.drones["cf1"], flown.drones["cf3"]]
        seconds = await flown.until(lambda: not any(drone.motors for drone in others))
        assert seconds < PATIENCE + 1.2 / 0.3 + 3
        assert lost.motors
        assert gateway.flies
        lost.answers = True
        await flown.until(lambda: not lost.motors, 30)
        await flown.until(lambda: not gateway.flies, 1)


async def test_while_the_gateway_is_held_up_its_brain_is_not_silent(tmp_path: Path) -> None:
    """What it said meanwhile is still to be read; a brain that says nothing after that is silent."""
    async with commanded(tmp_path, 1, PATIENCE) as (flown, gateway):
        line = gateway.link(1)
        drone = flown.drones["cf1"]
        link = Commander(line)
        await flown.do(link.fleet_report())
        link.heartbeat()
        await flown.do(flown.team.do("cf1", TakeOff(1.2)))
        link.heartbeat()
        held_up = PATIENCE + 1.0
        the_loop().call_later(1.0, the_loop().advance, held_up)
        await asyncio.sleep(1.0 + held_up + 0.1)
        assert gateway.is_commanded_by(line)
        link.heartbeat()
        seconds = await flown.until(lambda: not gateway.is_commanded_by(line))
        assert seconds == pytest.approx(PATIENCE, abs=0.2)
        await flown.until(lambda: not drone.motors)


@pytest.mark.parametrize("back", [True, False])
async def test_a_goodbye_leaves_none_behind_in_the_air(tmp_path: Path, back: bool) -> None:
    """The brain may go at once; who was silent is landed when it is back, and given up in the end."""
    async with commanded(tmp_path, 2, PATIENCE) as (flown, gateway):
        over, link, lost = Future[None](), gateway.link(1), flown.drones["cf2"]
        ending = Ending(gateway, over, settings(real=NO_DRONES, speed=1.0))
        server = Server(gateway, flown.log.append, ending.goodbye)
        ending.server = server
        ours, theirs = socket.socketpair()
        serving = asyncio.ensure_future(
            server.serve(*await asyncio.open_unix_connection(sock=ours))
        )
        reader, writer = await asyncio.open_unix_connection(sock=theirs)
        flown.kernel.post(ending.look)
        await flown.do(link.fleet_report())
        for id in flown.drones:
            await flown.do(flown.team.do(id, TakeOff(1.2)))
        writer.write(line({"do": "link", "epoch": 2}))
        writer.write(line({"do": "goodbye"}))
        lost.goes_silent()
        async with asyncio.timeout(10):  # or the brain would be kept waiting
            await reader.read()
        assert not flown.drones["cf1"].motors
        assert not over.is_set
        lost.answers = back
        seconds = await flown.until(lambda: over.is_set, LINGERS + 2)
        assert lost.motors is not back
        assert seconds < 30 if back else seconds > LINGERS - 2
        writer.close()
        await serving
