"""cflib with its own threads, in real time: a drone by UDP, and some behind one dongle that is pulled out."""

from __future__ import annotations

import asyncio
import threading
from pathlib import Path

import pytest

from pluto_fleet.crtp.drone import Build
from pluto_fleet.crtp.flight_log import FlightLog
from pluto_fleet.drones.protocol import LINK_LOST, LinkLost
from tests.kill.lives import eventually
from tests.library.crazyflie.hangar import FAST, PATIENCE, hangar, navigation
from tests.library.crtp.radio import Ether, plugged_in

pytest.importorskip("cflib")
pytestmark = pytest.mark.filterwarnings(
    # the thread of cflib's that has the dongle ends so when it is pulled out
    "ignore:Exception in thread Shared Radio:pytest.PytestUnhandledThreadExceptionWarning"
)

IDS = ("cf1", "cf2", "cf3")
THREADS = ("cflib for", "closing the link", "Radio", "ping", "Incoming", "Param", "Timer", "Udp")


def left() -> list[str]:
    """Return the threads that should have ended; the one that has the dongle waits for ever."""
    names = [thread.name for thread in threading.enumerate()]
    return [one for one in names if one.startswith(THREADS) and not one.startswith("Shared")]


@pytest.fixture
def air() -> Ether:
    """Three drones in reach of one dongle."""
    builds = [Build(id=id, home=(2.0 * at, 1.0, 0.0)) for at, id in enumerate(IDS)]
    return Ether(builds, FlightLog())


def test_closing_in_the_air_lands_first_cuts_nothing_and_ends_all_threads(tmp_path: Path) -> None:
    async def fly() -> None:
        async with hangar(tmp_path) as one:
            cf = await one.connected()
            await cf.takeoff(0.3, FAST)
            await cf.close()
            assert one.did("land") and not one.did("setpoint") and not one.did("emergency stop")
            assert not one.flies and not one.drone.supervisor.locked

    asyncio.run(fly())
    assert eventually(lambda: left() == [], PATIENCE), left()


@pytest.mark.long  # twenty seconds in real time
def test_a_dongle_that_is_pulled_out_is_a_lost_link_and_back_it_is_used_again(
    air: Ether, tmp_path: Path
) -> None:
    async def fly() -> None:
        flown = [navigation(air.drones[id].build, air.uris[id], tmp_path) for id in IDS]
        await asyncio.gather(*(one.connect() for one in flown))
        await asyncio.gather(*(one.takeoff(0.5, 2.0) for one in flown))
        air.unplugged = True
        for one in flown:
            async with asyncio.timeout(PATIENCE):
                event = await anext(aiter(one.events()))
            assert event.kind == LINK_LOST
        again = await asyncio.gather(*(one.connect() for one in flown), return_exceptions=True)
        assert all(isinstance(one, LinkLost) for one in again)
        assert "no Crazyradio is plugged in" in str(again[0])
        air.unplugged = False
        await asyncio.gather(*(one.connect() for one in flown))
        assert all(drone.body.airborne for drone in air.drones.values())
        await asyncio.gather(*(one.land(2.0) for one in flown))
        await asyncio.gather(*(one.close() for one in flown))

    with plugged_in(air):
        asyncio.run(fly())
    for drone in air.drones.values():
        assert not drone.body.airborne and not drone.supervisor.locked
    assert eventually(lambda: left() == [], PATIENCE), left()
