"""Writes down what drones are told, on its way to them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import tomlkit

from ..jobs.controls import ForwardingControls

if TYPE_CHECKING:
    from plutoc_runtime.domain.actions import Plain
    from plutoc_runtime.domain.model import Item, Point
    from plutoc_runtime.time.kernel import Kernel

    from ..jobs.controls import Controls


@dataclass(frozen=True, slots=True, kw_only=True)
class Command:
    """One command to one drone."""

    time: float
    drone: str
    what: str
    to: Point | None = None
    speed: float | None = None
    """The most that it may fly, metres per second."""


class Given(ForwardingControls):
    """Drones that can be told what others can; each command is kept, and handed on to those others."""

    def __init__(
        self, kernel: Kernel, drones: Controls, speeds: Mapping[str, float], climb: float
    ) -> None:
        super().__init__(drones)
        self._kernel = kernel
        self._speeds, self._climb_limit = speeds, climb
        self.commands: list[Command] = []

    def _note(
        self, drone: str, what: str, to: Point | None = None, speed: float | None = None
    ) -> None:
        self.commands.append(
            Command(time=self._kernel.now, drone=drone, what=what, to=to, speed=speed)
        )

    def _here(self, drone: str, height: float) -> Point:
        x, y, _ = self._controls.telemetry[drone].location
        return x, y, height

    def _climb(self, drone: str) -> float:
        return min(self._climb_limit, self._speeds[drone])

    async def takeoff(self, drone: str, height: float) -> None:
        """Rise straight up to a height; does nothing for a drone that flies."""
        if self._controls.telemetry[drone].landed:
            self._note(drone, "take off", self._here(drone, height), self._climb(drone))
        await self._controls.takeoff(drone, height)

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        self._note(drone, "go to", target, self._speeds[drone])
        await self._controls.go_to(drone, target)

    async def land(self, drone: str) -> None:
        """Land here; does nothing for a drone that stands on the ground."""
        if not self._controls.telemetry[drone].landed:
            self._note(drone, "land", self._here(drone, 0.0), self._climb(drone))
        await self._controls.land(drone)

    async def hold(self, drone: str) -> None:
        """Hover, for as long as an action of the app's own takes; never returns by itself."""
        self._note(drone, "hover, for an action of the app's own")
        await self._controls.hold(drone)

    async def act(
        self,
        drone: str,
        action: str,
        parameters: Mapping[str, Plain],
        item: Item | None,
        job: str | None,
    ) -> object:
        """Do one of the built-in actions here, and return what came of it."""
        given = [f"{name} = {tomlkit.item(one).as_string()}" for name, one in parameters.items()]
        what = [*([tomlkit.item(item.name).as_string()] if item is not None else []), *given]
        self._note(drone, f"{action}, {', '.join(what)}" if what else action)
        return await self._controls.act(drone, action, parameters, item, job)

    async def read(self, drone: str, name: str) -> float:
        """Return what a drone measures under this name, for an action of the app's own."""
        self._note(drone, f"read {name}")
        return await self._controls.read(drone, name)

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set what a drone has under this name, for an action of the app's own."""
        self._note(drone, f"set {name} = {value!r}")
        await self._controls.write(drone, name, value)

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover; a command under way raises `FlightFailed`."""
        if not self._controls.telemetry[drone].landed:
            self._note(drone, "stop, and hover")
        self._controls.break_off(drone)

    async def cut(self, drone: str) -> None:
        """Switch its motors off now, wherever it is: only ever because a person said just that."""
        self._note(drone, "cut the motors")
        await self._controls.cut(drone)
