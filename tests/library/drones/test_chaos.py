"""No matter what goes wrong, and when: every flight and rescue ends, and what can land has landed."""

from __future__ import annotations

import asyncio
from pathlib import Path
from random import Random

import pytest

from pluto_fleet.drones.protocol import BATTERY_LOW, LINK_LOST, LOCKED, NavigationError
from pluto_fleet.gateway.gateway import Gateway
from pluto_fleet.jobs.reports import Down
from tests.kit.draws import draws
from tests.kit.drones import FakeDrone, the_loop
from tests.library.drones.teams import Flown
from tests.library.drones.test_under_a_gateway import commanded, measuring
from tests.library.gateway.flights import Commander

COUNT = 4
LONG = 4000.0
"""Seconds in which all must be over: a link is waited for, and so is a person."""
METHODS = ("connect", "preflight", "takeoff", "go_to", "hold", "land", "act", "close")


FAULTS = (
    "silent",
    "falls",
    "hangs",
    "raises",
    "tells",
    "drifts",
    "empties",
    "blocks",
    "restarts",
)


def strike(drone: FakeDrone, what: str, chance: Random) -> None:
    """Let something go wrong with a drone, most often for a while."""
    later, method = the_loop().call_later, chance.choice(METHODS)
    match what:
        case "silent":
            drone.goes_silent()
            if chance.random() < 0.8:
                later(chance.choice((0.5, 3, 30, 200)), setattr, drone, "answers", True)
        case "falls" if drone.motors:
            drone.falls(tells=chance.random() < 0.5)
        case "hangs":
            drone.hangs.add(method)
            if chance.random() < 0.3:
                drone.clings.add(method)
                later(100, drone.clings.discard, method)
            later(chance.choice((1, 20, 100)), drone.hangs.discard, method)
        case "raises":
            drone.raises[method] = chance.choice(
                (NavigationError("no"), TypeError("what?"), SystemExit(1))
            )
            later(chance.choice((1, 20, 100)), drone.raises.pop, method, None)
        case "tells":
            drone.happens(chance.choice((BATTERY_LOW, LINK_LOST, LOCKED)))
        case "drifts" if drone.motors:
            x, y, z = drone.place
            drone.put((x + chance.uniform(-6, 6), y + chance.uniform(-6, 6), z))
        case "empties":
            drone.level = chance.choice((0.0, 0.02, 0.1))
            later(60, setattr, drone, "level", 0.9)
        case "blocks":
            drone.blocks[method] = chance.choice((0.06, 0.5, 5.0))
            later(20, drone.blocks.pop, method, None)
        case "restarts":
            drone.goes_silent()
            if drone.motors:
                drone.falls(tells=False)
            later(4, setattr, drone, "answers", True)


async def trouble(flown: Flown, gateway: Gateway, chance: Random) -> None:
    """Let something go wrong now and then, and a person look after what lies about."""
    while True:
        await asyncio.sleep(chance.expovariate(1 / 15))
        drone = chance.choice(list(flown.drones.values()))
        strike(drone, chance.choice(FAULTS), chance)
        if chance.random() < 0.2:
            flown.kernel.post(gateway.break_off, drone.id)
        for one in flown.drones.values():
            if not one.motors and chance.random() < 0.1:
                one.put(one.home)
                one.reasons, one.answers = (), True


async def flights(
    flown: Flown, gateway: Gateway, commander: Commander, drone: str, chance: Random
) -> None:
    """Fly job after job, as a brain does, and bring the drone back after each."""
    for number in range(3):
        target = chance.uniform(1, 5), chance.uniform(2, 9), 1.2
        heard: asyncio.Future[object] = asyncio.get_running_loop().create_future()

        def report(result: object, heard: asyncio.Future[object] = heard) -> None:
            heard.set_result(result)

        job = measuring(drone, target)
        job.id = f"{job.id}/{number}"
        flown.kernel.post(commander.fly, job, report)

        def over(heard: asyncio.Future[object] = heard) -> bool:
            return heard.done() or not gateway.jobs.is_flown_by(drone)  # if it was broken off

        await flown.until(over, LONG)
        rescue = flown.begin(gateway.recover(drone))
        rescue.watch(lambda _: None)  # it may be broken off at once
        async with asyncio.timeout(LONG):
            await asyncio.wait((asyncio.ensure_future(flown.kernel.offer(rescue)),))


@pytest.mark.parametrize("seed", draws(5, 24))
async def test_everything_ends_and_all_that_can_land_has_landed(tmp_path: Path, seed: int) -> None:
    """Three flights of each of four drones, with something going wrong every fifteen seconds."""
    chance = Random(f"chaos/{seed}")
    async with commanded(tmp_path, COUNT) as (flown, gateway):
        commander = Commander(gateway.link(1))
        await flown.do(commander.fleet_report())
        worse = asyncio.ensure_future(trouble(flown, gateway, chance))
        async with asyncio.timeout(3 * LONG):
            await asyncio.gather(
                *(flights(flown, gateway, commander, drone, chance) for drone in flown.drones)
            )
        if chance.random() < 0.5:
            how = chance.choice(list(Down))
            down = flown.begin(gateway.link(2).bring_down(how))
            await flown.until(lambda: down.is_set, LONG)
        worse.cancel()
        await asyncio.wait((worse,))
        for drone in flown.drones.values():
            for kept in (drone.hangs, drone.clings, drone.raises, drone.blocks):
                kept.clear()
            drone.answers = True
    assert [drone.id for drone in flown.drones.values() if drone.motors] == []
