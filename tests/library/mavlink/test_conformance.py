"""A MAVLink vehicle of either make passes the kit: flown through MAVSDK, in real time, against simulated ones."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import ClassVar

import pytest

from pluto_fleet.autopilot.server import Server, let
from pluto_fleet.autopilot.vehicle import Build, Vehicle
from pluto_fleet.drones.conformance.contract import NavigationContract
from pluto_fleet.drones.conformance.recording import Truth
from pluto_fleet.drones.protocol import DroneNavigation, DroneSetup
from pluto_fleet.geodesy import LocalPlane
from pluto_fleet.mavlink.navigation import MavlinkVehicle

pytestmark = [pytest.mark.process, pytest.mark.long]

PLANE = LocalPlane(47.397742, 8.545594, 488.0, bearing=0.5)
HOME = (5.0, 5.0, 0.0)


class _Field(asyncio.SelectorEventLoop):
    """A loop in which vehicles are simulated, until it is closed."""

    def __init__(self, builds: Sequence[Build]) -> None:
        super().__init__()
        self.server = Server(builds)
        self.run_until_complete(self.server.start())

    def close(self) -> None:
        if not self.is_closed():
            self.run_until_complete(self.server.close())
            self.run_until_complete(asyncio.sleep(0))
        super().close()


class OfEither(NavigationContract):
    height, away, speed, tolerance, rest = 3.0, 8.0, 3.0, 0.6, 0.5
    may_fall = together = True
    autopilot: ClassVar[str]
    folder: ClassVar[Path]
    server: ClassVar[Server]
    fresh: ClassVar[list[str]]
    """The vehicles that have not flown yet."""
    flown: ClassVar[dict[DroneNavigation, Vehicle]]

    @classmethod
    def loop_factory(cls) -> asyncio.AbstractEventLoop:
        home = PLANE.to_degrees(HOME)
        builds = [
            Build(id=f"m{number}", system=number, home=home, make=cls.autopilot)
            for number in range(1, 9)
        ]
        field = _Field(builds)
        OfEither.server = field.server
        OfEither.fresh = [build.id for build in builds]
        OfEither.flown = {}
        return field

    def make(self) -> DroneNavigation:
        id = self.fresh.pop()
        made = self._made(id, self.server.uris[id])
        self.flown[made] = self.server.vehicles[id]
        return made

    def make_unreachable(self) -> DroneNavigation:
        return self._made("m99", f"mavlink+udp://127.0.0.1:{self.server.port}?system=99")

    def _made(self, id: str, uri: str) -> DroneNavigation:
        setup = DroneSetup(
            id=id, uri=uri, home=HOME, speed=5.0, options={}, folder=self.folder, plane=PLANE
        )
        return MavlinkVehicle(setup)

    def silence(self, navigation: DroneNavigation) -> None:
        let(self.flown[navigation], "silent", True)

    def crash(self, navigation: DroneNavigation) -> None:
        let(self.flown[navigation], "dead", True)

    def truth(self, navigation: DroneNavigation) -> Truth | None:
        if navigation not in self.flown:
            return None
        vehicle = self.flown[navigation]
        degrees = vehicle.place
        position = PLANE.to_metres(degrees)
        return Truth(position=position, yaw=navigation.telemetry.yaw, motors=vehicle.armed)

    def test_the_event_loop_is_never_held_up(self) -> None:
        """By what drives vehicles: they are simulated in the same loop, which a busy machine holds up."""
        for record in map(self._flown, self._flights()):
            assert [one for one in record.blocked if "/autopilot/" not in one] == []


class TestPx4(OfEither):
    autopilot = "px4"


class TestArduPilot(OfEither):
    autopilot = "ardupilot"


@pytest.fixture(scope="module", autouse=True)
def installed(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    pytest.importorskip("mavsdk")
    OfEither.folder = tmp_path_factory.mktemp("vehicles")
    yield
