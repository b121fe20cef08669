"""Classes that a fleet file may name: one that can fly, and some that lack something."""

from __future__ import annotations

from collections.abc import AsyncIterator, Callable, Coroutine, Mapping
from functools import wraps
from typing import Any

from pluto_fleet.drones import Point
from pluto_fleet.drones.protocol import DroneEvent, DroneSetup, DroneTelemetry
from tests.kit.drones import FakeDrone

NUMBER = 7


def logged(command: Callable[..., Coroutine[Any, Any, None]]) -> Callable[..., Any]:
    """Wrap a command, as people do."""

    @wraps(command)
    def call(*args: object) -> object:
        return command(*args)

    return call


class Good(FakeDrone):
    """It has everything, and calls its arguments as it likes."""

    def __init__(self, setup: DroneSetup) -> None:
        super().__init__(setup.id, setup.home)

    async def land(self, slowly: float, *, quietly: bool = True) -> None:
        """Come down."""

    @logged
    async def hold(self) -> None:
        """Hover."""


class Holder:
    """Classes may stand in classes."""

    class Inner(Good):
        """So may this one."""


class Late(Good):
    """Its telemetry is set when it is made, and its events come from a plain method."""

    def events(self) -> AsyncIterator[DroneEvent]:
        return super().events()


class Lazy:
    def __init__(self, setup: DroneSetup, radio: object) -> None: ...

    def connect(self) -> None: ...

    async def preflight(self) -> list[str]:
        return []

    async def takeoff(self, height: float) -> None: ...

    land = 3

    async def hold(self) -> None: ...

    async def emergency_stop(self) -> None: ...

    async def close(self) -> None: ...

    def telemetry(self) -> DroneTelemetry:
        raise NotImplementedError

    async def events(self) -> list[DroneEvent]:
        return []


class Looking(Good):
    """It can look who is there."""

    @staticmethod
    async def scan(options: Mapping[str, object]) -> list[str]:
        return []


class Shy(Good):
    """It can look only once it is there itself."""

    async def scan(self, options: Mapping[str, object]) -> list[str]:
        return []


class Cameras:
    """A localization that sees the drones."""

    def __init__(self, options: Mapping[str, object]) -> None:
        self.options = options

    async def positions(self) -> AsyncIterator[tuple[str, Point]]:
        yield "cf1", (1.0, 2.0, 0.5)


class Blind:
    def __init__(self) -> None: ...

    async def positions(self) -> list[tuple[str, Point]]:
        return []
