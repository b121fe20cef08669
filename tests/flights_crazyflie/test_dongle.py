"""Ten Crazyflies on one dongle, which is pulled out while they fly; cflib's own radio driver."""

from __future__ import annotations

import asyncio
from pathlib import Path

import pytest

from pluto_fleet.crtp.drone import Build
from pluto_fleet.crtp.flight_log import MemoryLog
from pluto_fleet.shared.domain.errors import Failure, FlightFailed
from pluto_fleet.shared.domain.model import Point
from tests.flights_crazyflie.team import commanded, no_thread_is_left
from tests.library.crtp.radio import Ether, plugged_in

pytest.importorskip("cflib")
pytestmark = [
    pytest.mark.long,  # in real time; tests/library/crazyflie/test_radio.py pulls it out from three
    pytest.mark.filterwarnings(
        # the thread of cflib's that has the dongle ends so when it is pulled out
        "ignore:Exception in thread Shared Radio:pytest.PytestUnhandledThreadExceptionWarning"
    ),
]

COUNT = 10
HOMES: dict[str, Point] = {
    f"cf{i}": (1.0 + 1.2 * (i % 5), 1.0 + 1.2 * (i // 5), 0.0) for i in range(COUNT)
}


def test_without_their_dongle_all_hover_and_come_home_when_it_is_back(tmp_path: Path) -> None:
    """Each flight fails with the reason, and nothing hangs; cflib itself would, for ever."""
    ether = Ether([Build(id=id, home=at) for id, at in HOMES.items()], MemoryLog())

    async def fly() -> None:
        async with commanded(tmp_path, HOMES, ether.uris, {}) as flown:
            fleet_report = await flown.do(flown.link.fleet_report())
            assert all(report.reached for report in fleet_report.drones.values()), flown.log
            jobs = [
                flown.flies(id, (x, y + 3.0, 0.8), action=None) for id, (x, y, _) in HOMES.items()
            ]
            flights = asyncio.gather(*jobs)
            async with asyncio.timeout(60.0):
                while not all(drone.body.airborne for drone in ether.drones.values()):
                    await asyncio.sleep(0.1)
            ether.unplugged = True
            async with asyncio.timeout(30.0):
                ends = await flights
            failed = [end.failure for end in ends if isinstance(end, FlightFailed)]
            assert failed == [Failure.LINK] * COUNT, flown.log
            assert all(drone.body.airborne for drone in ether.drones.values())
            recovers = [flown.begin(flown.gateway.recover(id)) for id in HOMES]
            await asyncio.sleep(2.0)
            ether.unplugged = False
            async with asyncio.timeout(60.0):
                for recovered in recovers:
                    assert await flown.kernel.offer(recovered), flown.log
            assert not any(drone.body.airborne for drone in ether.drones.values())

    with plugged_in(ether):
        asyncio.run(fly())
    assert no_thread_is_left()
