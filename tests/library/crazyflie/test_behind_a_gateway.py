"""Crazyflies behind one gateway, through cflib: a fault fails its own flight and no other, and is got over."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest

from pluto_fleet.crtp.drone import Build
from pluto_fleet.crtp.flight_log import FlightLog
from pluto_fleet.crtp.server import Server
from pluto_fleet.drones.team import Team
from pluto_fleet.gateway.gateway import Gateway
from pluto_fleet.jobs.controls import FleetDrone
from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from pluto_fleet.shared.domain.model import Category
from pluto_fleet.shared.domain.motion import CRAZYFLIE
from tests.kit.unthreaded import in_virtual_time, the_air
from tests.library.crazyflie.hangar import FAST, navigation
from tests.library.drones.teams import FIELD, Asked
from tests.library.gateway.flights import Commander, Task

pytest.importorskip("cflib")

QUICK = Category(name="quick", speed=FAST, flight_time=420, charge_time=1200)
HOMES = {id: (2.0 * at + 1.0, 1.0, 0.0) for at, id in enumerate(("well", "away", "tumbler"))}
OPTIONS = {"measure": {"temperature": "bme.temp"}}
FAILS = {"away": Failure.LINK, "tumbler": Failure.CRASH}


async def fly(folder: Path) -> None:
    record = FlightLog()
    asked = Asked()
    builds = [Build(id=id, home=home) for id, home in HOMES.items()]
    server = Server(builds, record)
    await server.start()
    flies = {one.id: navigation(one, server.uris[one.id], folder, OPTIONS) for one in builds}
    crafts = [
        FleetDrone(id=one.id, category=QUICK, home=one.home, index=index)
        for index, one in enumerate(builds)
    ]
    say = asked.log.append
    clock = the_air().time
    team = Team(asked.kernel, crafts, flies, FIELD, folder=folder, say=say, clock=clock)
    gateway = Gateway(asked.kernel, team, crafts, FIELD, apart=0.5, slack=CRAZYFLIE.slack)
    team.begin()
    link = Commander(gateway.link(1))
    await asked.do(link.fleet_report())
    heard: dict[str, object] = {}
    for id, (x, y, _) in HOMES.items():
        job = Task(id=id, drone=id, stops=((x, y + 3.0, 0.8),), action="measure", item=None)
        asked.kernel.post(link.fly, job, lambda result, id=id: heard.setdefault(id, result))
    bodies = {id: drone.body for id, drone in server.drones.items()}
    await asked.until(lambda: all(body.position[1] > 2.0 for body in bodies.values()))
    await server.let("away", "silent", True)
    await server.let("tumbler", "tumble", True)
    await asked.until(lambda: len(heard) == len(HOMES))
    assert isinstance(heard.pop("well"), float)
    failures = {id: one.failure for id, one in heard.items() if isinstance(one, FlightFailed)}
    assert failures == FAILS, asked.log
    assert bodies["away"].airborne  # it hovers until it is heard again
    await server.let("away", "silent", False)
    assert not await asked.do(gateway.recover("tumbler"))
    await server.let("tumbler", "fetch", True)
    asked.kernel.post(team.mended, "tumbler")
    for id, home in HOMES.items():
        assert await asked.do(gateway.recover(id)), asked.log
        assert bodies[id].position == pytest.approx(home, abs=0.15)
    cut = [one for one in record.commands if one.what in ("setpoint", "emergency stop")]
    assert [one for one in cut if one.flying] == []
    await team.close()
    await asyncio.sleep(0)
    await server.close()


def test_a_fault_fails_its_own_flight_and_is_got_over(tmp_path: Path) -> None:
    in_virtual_time(fly(tmp_path))
