"""One flight of a plan in virtual time: the app's brain, the gateway, cflib and simulated Crazyflies in one loop."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from pluto_fleet.app import App
from pluto_fleet.crtp.drone import Build, SimulatedCrazyflie
from pluto_fleet.crtp.equipment import camera, fitted, port_of
from pluto_fleet.crtp.flight_log import FlightLog
from pluto_fleet.crtp.server import Server
from pluto_fleet.drones.real_fleet import real_fleet
from pluto_fleet.drones.team import Team, make_one
from pluto_fleet.files.fleet import FleetFile
from pluto_fleet.files.stand_ins import CRTP, StandIns, as_stand_ins
from pluto_fleet.flight.driver import Driver, begun
from pluto_fleet.gateway.gateway import Gateway
from pluto_fleet.jobs.controls import fleet_drones
from pluto_fleet.process.realtime import RealTime
from pluto_fleet.shared.alone.world import World
from pluto_fleet.shared.domain.app import moving
from pluto_fleet.shared.domain.model import Mission
from pluto_fleet.shared.flow.record import fleet_data
from tests.kit.unthreaded import in_virtual_time, passes, the_air
from tests.prediction.record import Flown

Prepare = Callable[[SimulatedCrazyflie], object]


def flown(
    app: App,
    missions: Sequence[Mission[Any]],
    fleet: FleetFile,
    *,
    seed: int = 0,
    prepare: Prepare = lambda _: None,
    say: Callable[[str], object] = lambda _: None,
) -> Flown:
    """Fly missions to their end; `prepare` is called with each drone before it is connected."""
    with TemporaryDirectory(prefix="flown-") as folder:
        flight = _flown(app, missions, fleet, seed, prepare, say, Path(folder))
        return in_virtual_time(flight)


async def _flown(
    app: App,
    missions: Sequence[Mission[Any]],
    fleet: FleetFile,
    seed: int,
    prepare: Prepare,
    say: Callable[[str], object],
    folder: Path,
) -> Flown:
    fleet = as_stand_ins(fleet, StandIns(CRTP, len(fleet.drones)))
    app = moving(app, fleet.motion)
    crafts = fleet_drones(app, fleet)
    builds = [
        Build(
            id=one.id,
            home=one.home,
            seed=1000 * seed + one.index,
            flight=one.category.flight_time,
            charge=one.category.charge_time,
        )
        for one in crafts
    ]
    world = World(seed, fleet.airspace, fleet.world)
    server = Server(builds, FlightLog(), world)
    await server.start()
    for drone in server.drones.values():
        prepare(drone)
    streamer = await camera()
    real = real_fleet(fleet, missions, server.uris)
    options = fitted({}, f"127.0.0.1:{port_of(streamer)}", world)
    real = replace(real, drones=tuple(replace(one, options=options) for one in real.drones))
    kernel = RealTime()
    navigations = {
        one.id: make_one(how, one.home, one.category.speed, folder)
        for one, how in zip(crafts, real.drones, strict=True)
    }
    clock = the_air().time
    team = Team(kernel, crafts, navigations, fleet.airspace, folder=folder, say=say, clock=clock)
    slack = fleet.motion.slack
    gateway = Gateway(kernel, team, crafts, fleet.airspace, apart=fleet.apart, slack=slack)
    team.begin()
    link = gateway.link(1)
    await passes(20.0)  # until all are connected, and sure of their places
    events: list[Mapping[str, Any]] = []
    brain = app.new_brain(fleet_data(fleet), space=fleet.airspace, hooks=None)
    seen: dict[str, object] = {}

    def news() -> Mapping[str, object]:
        told = {
            id: {"at": one.location, "battery": one.battery_level, "landed": one.landed}
            for id, one in team.telemetry.items()
        }
        new = {id: one for id, one in told.items() if seen.get(id) != one}
        seen.update(new)
        return new

    driver = Driver(kernel, brain, obey=link.send, motions=news, hear=events.append)
    link.hear = driver.tell
    heart = asyncio.ensure_future(_beats(partial(link.send, {"do": "heartbeat"}), driver.look))
    began = kernel.time()
    kernel.post(driver.call, lambda now: brain.begin(begun(app, missions), now))
    over = await kernel.run(driver.done)
    heart.cancel()
    await team.close()
    streamer.close()
    await server.close()
    kinds = [event["event"] for event in events]
    ends = [event for event in events if event["event"] == "mission.ended"]
    levels = [event["battery"] for event in events if isinstance(event.get("battery"), float)]
    return Flown(
        plan=app.name,
        code=int(any(event["status"] != "COMPLETED" for event in ends)),
        makespan=max((event["t"] for event in ends), default=over) - began,
        began=began,
        battery=min(levels, default=1.0),
        flights=kinds.count("trip.launched"),
        failed=kinds.count("trip.failed"),
        load=0.0,
    )


async def _beats(*calls: Callable[[], object]) -> None:
    """Tell the gateway of the brain, and the brain of the drones, ten times a second."""
    while True:
        for call in calls:
            call()
        await asyncio.sleep(0.1)
