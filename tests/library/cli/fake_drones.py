"""Drones that are not there, behind the public protocol: what is done to them stands in `RECORD`."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Mapping, Sequence
from math import inf
from pathlib import Path

from pluto_fleet.drones.protocol import DroneEvent, DroneSetup, DroneTelemetry, LinkLost
from pluto_fleet.shared.domain.actions import Plain
from pluto_fleet.shared.domain.model import Item, Point

RECORD: list[tuple[str, str]] = []
"""(uri, what was asked)."""

ASKED = {"connect", "preflight", "facts", "identify", "locate", "close"}
"""What neither arms nor moves a drone."""

THERE: dict[str, DroneTelemetry] = {}
"""What each drone would tell, by its uri."""

NOT_READY = {"fake://4": ["its battery is at 3.10 V", "it lies on its back"]}


def at(position: Point, *, flying: bool = False, voltage: float = 4.02) -> DroneTelemetry:
    """Return what a drone tells."""
    return DroneTelemetry(
        time=1.0, position=position, yaw=0.0, voltage=voltage, battery_level=0.87, flying=flying
    )


class Bare:
    """A drone; `fake://lost` is not there, and `fake://silent` does not even say so."""

    def __init__(self, setup: DroneSetup) -> None:
        assert Path(setup.folder).is_dir()
        self.uri = setup.uri or ""
        self._telemetry = DroneTelemetry(
            time=-inf, position=setup.home, yaw=0.0, voltage=0.0, battery_level=1.0, flying=False
        )

    def _note(self, what: str) -> None:
        RECORD.append((self.uri, what))

    async def connect(self) -> None:
        self._note("connect")
        await asyncio.sleep(0)
        if self.uri == "fake://lost":
            raise LinkLost("nobody is there")
        if self.uri == "fake://silent":
            await asyncio.Event().wait()
        if self.uri == "fake://wrong":
            raise TypeError("not a \x1b[2Jfloat")
        self._telemetry = THERE[self.uri]

    async def preflight(self) -> Sequence[str]:
        self._note("preflight")
        return NOT_READY.get(self.uri, [])

    async def facts(self) -> Mapping[str, str]:
        self._note("facts")
        return {"firmware": "2025.02", "decks": "bcLighthouse4"}

    @property
    def telemetry(self) -> DroneTelemetry:
        return self._telemetry

    async def takeoff(self, height: float, speed: float) -> None:
        self._note("takeoff")

    async def go_to(self, target: Point, speed: float) -> None:
        self._note("go_to")

    async def hold(self) -> None:
        self._note("hold")

    async def land(self, speed: float) -> None:
        self._note("land")

    async def emergency_stop(self) -> None:
        self._note("emergency_stop")

    async def close(self) -> None:
        self._note("close")

    async def events(self) -> AsyncIterator[DroneEvent]:
        return
        yield


class Fake(Bare):
    """One that can be found, can show itself, and is told where it is by others."""

    def why_not(self, action: str, parameters: Mapping[str, Plain]) -> str | None:
        return f"{self.uri} has no camera" if action == "take_photo" else None

    async def act(self, action: str, parameters: Mapping[str, Plain], item: Item | None) -> object:
        self._note(action)
        return None

    async def locate(self, position: Point) -> None:
        self._note("locate")

    async def identify(self) -> None:
        self._note("identify")

    @staticmethod
    async def scan(options: Mapping[str, object]) -> Sequence[str]:
        if options.get("dongle") == "none":
            raise LinkLost("there is no Crazyradio: plug one in")
        return list(THERE)


class Mocap:
    """Sees `cf1` alone."""

    def __init__(self, options: Mapping[str, object]) -> None:
        assert options == {"host": "lab"}

    async def positions(self) -> AsyncIterator[tuple[str, Point]]:
        while True:
            yield "cf1", (1.0, 1.0, 0.0)
            await asyncio.sleep(0.01)


class Counted(Bare):
    """One whose addresses are numbers."""

    @staticmethod
    def canonical_uri(uri: str) -> str:
        number = uri.removeprefix("fake://")
        if not number.isdecimal():
            raise ValueError("is of no fake: they are counted")
        return f"fake://{int(number)}"
