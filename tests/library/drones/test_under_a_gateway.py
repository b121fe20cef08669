"""Real drones behind the gateway: jobs, failures, and what is done without a brain."""

from __future__ import annotations

import asyncio
import socket
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

import pytest

from pluto_fleet.drones.protocol import BATTERY_LOW
from pluto_fleet.drones.real_fleet import RealFleet
from pluto_fleet.gateway.gateway import Gateway
from pluto_fleet.gateway.ledger import FileLedger
from pluto_fleet.gateway.process import LINGERS, Ending
from pluto_fleet.gateway.server import Server
from pluto_fleet.jobs.telemetry import Publisher
from pluto_fleet.process.ipc import line
from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from pluto_fleet.shared.domain.model import Point
from pluto_fleet.shared.time.future import Future
from tests.kit.drones import FakeDrone, the_loop
from tests.library.drones.teams import FIELD, Flown, flying
from tests.library.gateway.flights import Task
from tests.library.gateway.processes import settings

PATIENCE = 6.0
NO_DRONES = RealFleet(drones=(), localization="own", localization_options={})


class Craft:
    """A drone as the gateway knows it."""

    def __init__(self, flown: Flown, index: int) -> None:
        drone = flown.crafts[index]
        self.id, self.home, self.category = drone.id, drone.home, drone.category
        self.index = index


@asynccontextmanager
async def commanded(
    folder: Path,
    count: int = 1,
    patience: float | None = None,
    ledger: FileLedger | None = None,
) -> AsyncIterator[tuple[Flown, Gateway]]:
    """Begin a gateway over some fake drones, and query the drones."""
    drones = [FakeDrone(f"cf{i}", (float(i), 1.0, 0.0)) for i in range(1, count + 1)]
    async with flying(folder, *drones) as flown:
        crafts = [Craft(flown, index) for index in range(count)]
        gateway = Gateway(
            flown.kernel,
            flown.team,
            crafts,
            FIELD,
            ledger=ledger,
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
    """Return a job that any of them can do."""
    return Task(id=f"Field/{drone}/0/1", drone=drone, stops=(there,), action="measure", item=None)


async def test_a_job_is_flown_by_a_real_drone(tmp_path: Path) -> None:
    """What its action gave is reported once; then it is flown home."""
    async with commanded(tmp_path, 2) as (flown, gateway):
        link, heard = gateway.link(1), list[object]()
        await flown.do(link.fleet_report())
        flown.kernel.post(link.fly, measuring("cf1", (4.0, 5.0, 1.2)), heard.append)
        await flown.until(lambda: heard)
        assert heard == [21.5]
        assert flown.drones["cf1"].place == pytest.approx((4, 5, 1.2), abs=0.1)
        assert await flown.do(gateway.recover("cf1"))
        assert flown.drones["cf1"].place == pytest.approx((1, 1, 0), abs=0.1)
        assert not flown.drones["cf1"].motors


async def test_a_silent_drone_fails_its_job_and_comes_home_when_it_is_back(tmp_path: Path) -> None:
    """No other drone notices."""
    async with commanded(tmp_path, 2) as (flown, gateway):
        link, lost, well = gateway.link(1), list[object](), list[object]()
        await flown.do(link.fleet_report())
        flown.kernel.post(link.fly, measuring("cf1", (1.0, 5.0, 1.2)), lost.append)
        flown.kernel.post(link.fly, measuring("cf2", (4.0, 5.0, 1.2)), well.append)
        await flown.until(lambda: flown.drones["cf1"].place[1] > 2)
        flown.drones["cf1"].goes_silent()
        await flown.until(lambda: lost and well)
        assert isinstance(lost[0], FlightFailed)
        assert (lost[0].failure, well) == (Failure.LINK, [21.5])
        the_loop().call_later(30, setattr, flown.drones["cf1"], "answers", True)
        assert await flown.do(gateway.recover("cf1"))
        assert flown.drones["cf1"].place == pytest.approx((1, 1, 0), abs=0.1)


async def test_a_drone_with_a_low_battery_is_waited_for_where_it_landed(tmp_path: Path) -> None:
    """Recovered when a person has put it home."""
    async with commanded(tmp_path) as (flown, gateway):
        link, heard, drone = gateway.link(1), list[object](), flown.drones["cf1"]
        await flown.do(link.fleet_report())
        flown.kernel.post(link.fly, measuring("cf1", (1.0, 5.0, 1.2)), heard.append)
        await flown.until(lambda: drone.place[1] > 3)
        drone.level = 0.1
        drone.happens(BATTERY_LOW, "3.1 V")
        recovers = flown.begin(gateway.recover("cf1"))
        the_loop().call_later(200, drone.put, (1.0, 1.0, 0.0))
        assert await flown.until(lambda: recovers.is_set) > 190
        assert recovers.result()
        assert isinstance(heard[0], FlightFailed)
        assert heard[0].failure is Failure.BATTERY
        assert drone.told[-1] == "land"


async def test_without_a_brain_all_land_and_a_silent_one_delays_no_other(tmp_path: Path) -> None:
    """When it is back, and still not commanded, it lands, too."""
    async with commanded(tmp_path, 3, PATIENCE) as (flown, gateway):
        link, lost = gateway.link(1), flown.drones["cf2"]
        await flown.do(link.fleet_report())
        for id in flown.drones:
            link.heartbeat()
            await flown.do(flown.team.takeoff(id, 1.2))
        lost.goes_silent()
        others = [flown.drones["cf1"], flown.drones["cf3"]]
        seconds = await flown.until(lambda: not any(drone.motors for drone in others))
        assert seconds < PATIENCE + 1.2 / 0.3 + 3
        assert lost.motors
        assert gateway.flies
        lost.answers = True
        await flown.until(lambda: not lost.motors, 30)
        await flown.until(lambda: not gateway.flies, 1)


async def test_another_gateway_flies_none_whose_motors_were_cut(tmp_path: Path) -> None:
    """Against what the drone says of itself: it was switched off and on, and has forgotten."""
    ledger = FileLedger(tmp_path / "ledger")
    async with commanded(tmp_path, ledger=ledger) as (flown, gateway):
        await flown.up()
        assert await flown.do(gateway.cut_motors("cf1")) == ""
        assert not flown.drones["cf1"].motors
    ledger.close()
    ledger = FileLedger(tmp_path / "ledger")
    async with commanded(tmp_path, ledger=ledger) as (flown, gateway):
        link, heard, drone = gateway.link(1), list[object](), flown.drones["cf1"]
        fleet_report = await flown.do(link.fleet_report())
        assert fleet_report.drones["cf1"].problems == ("cf1's motors were cut",)
        flown.kernel.post(link.fly, measuring("cf1", (1.0, 5.0, 1.2)), heard.append)
        await flown.until(lambda: heard)
        assert str(heard[0]) == "cf1's motors were cut"
        assert not await flown.do(gateway.recover("cf1"))
        assert drone.told == []
        flown.kernel.post(link.mended, "cf1")
        assert await flown.do(gateway.recover("cf1"))
        again = measuring("cf1", (2.0, 1.0, 1.2))
        flown.kernel.post(link.fly, again, heard.append)
        await flown.until(lambda: len(heard) == 2)
        assert heard[1] == 21.5
    ledger.close()


@pytest.mark.parametrize("back", [True, False])
async def test_a_goodbye_leaves_none_behind_in_the_air(tmp_path: Path, back: bool) -> None:
    """The brain may go at once; who was silent is landed when it is back, and given up in the end."""
    async with commanded(tmp_path, 2, PATIENCE) as (flown, gateway):
        over, link, lost = Future[None](), gateway.link(1), flown.drones["cf2"]
        ending = Ending(gateway, over, settings(real=NO_DRONES, speed=1.0))
        server = Server(gateway, Publisher(flown.team.telemetry), flown.log.append, ending.goodbye)
        ending.server = server
        ours, theirs = socket.socketpair()
        serving = asyncio.ensure_future(
            server.serve(*await asyncio.open_unix_connection(sock=ours))
        )
        reader, writer = await asyncio.open_unix_connection(sock=theirs)
        flown.kernel.post(ending.look)
        await flown.do(link.fleet_report())
        for id in flown.drones:
            await flown.do(flown.team.takeoff(id, 1.2))
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
