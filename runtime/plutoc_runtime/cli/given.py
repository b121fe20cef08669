"""Writes down what drones are told, on its way to them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..files.toml_text import text, value

if TYPE_CHECKING:
    from ..actions import Plain
    from ..controls import Controls
    from ..kernel import Kernel
    from ..model import Item, Point, Telemetry
    from ..navigation import Job
    from ..standing import Standing


@dataclass(frozen=True, slots=True, kw_only=True)
class Command:
    """One command to one drone."""

    time: float
    drone: str
    what: str
    to: Point | None = None
    speed: float | None = None
    """The most that it may fly, metres per second."""


class Given:
    """Drones that can be told what others can; each command is kept, and handed on to those others."""

    def __init__(
        self, kernel: Kernel, drones: Controls, speeds: Mapping[str, float], climb: float
    ) -> None:
        self._kernel, self._drones = kernel, drones
        self._speeds, self._climb_limit = speeds, climb
        self.commands: list[Command] = []

    def _note(
        self, drone: str, what: str, to: Point | None = None, speed: float | None = None
    ) -> None:
        self.commands.append(
            Command(time=self._kernel.now, drone=drone, what=what, to=to, speed=speed)
        )

    def _here(self, drone: str, height: float) -> Point:
        x, y, _ = self._drones.telemetry(drone).location
        return x, y, height

    def _climb(self, drone: str) -> float:
        return min(self._climb_limit, self._speeds[drone])

    # What is told

    async def takeoff(self, drone: str, height: float) -> None:
        """Rise straight up to a height; does nothing for a drone that flies."""
        if self._drones.telemetry(drone).landed:
            self._note(drone, "take off", self._here(drone, height), self._climb(drone))
        await self._drones.takeoff(drone, height)

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        self._note(drone, "go to", target, self._speeds[drone])
        await self._drones.go_to(drone, target)

    async def land(self, drone: str) -> None:
        """Land here; does nothing for a drone that stands on the ground."""
        if not self._drones.telemetry(drone).landed:
            self._note(drone, "land", self._here(drone, 0.0), self._climb(drone))
        await self._drones.land(drone)

    async def hold(self, drone: str) -> None:
        """Hover, for as long as an action of the app's own takes; never returns by itself."""
        self._note(drone, "hover, for an action of the app's own")
        await self._drones.hold(drone)

    async def act(
        self,
        drone: str,
        action: str,
        parameters: Mapping[str, Plain],
        item: Item | None,
        job: str | None,
    ) -> object:
        """Do one of the built-in actions here, and return what came of it."""
        given = [f"{name} = {value(one)}" for name, one in parameters.items()]
        what = [*([text(item.name)] if item is not None else []), *given]
        self._note(drone, f"{action}, {', '.join(what)}" if what else action)
        return await self._drones.act(drone, action, parameters, item, job)

    async def read(self, drone: str, name: str) -> float:
        """Return what a drone measures under this name, for an action of the app's own."""
        self._note(drone, f"read {name}")
        return await self._drones.read(drone, name)

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set what a drone has under this name, for an action of the app's own."""
        self._note(drone, f"set {name} = {value!r}")
        await self._drones.write(drone, name, value)

    def break_off(self, drone: str) -> None:
        """Stop whatever a drone does, and hover; a command under way raises `FlightFailed`."""
        if not self._drones.telemetry(drone).landed:
            self._note(drone, "stop, and hover")
        self._drones.break_off(drone)

    async def cut(self, drone: str) -> None:
        """Switch its motors off now, wherever it is: only ever because a person said just that."""
        self._note(drone, "cut the motors")
        await self._drones.cut(drone)

    # What is asked

    def telemetry(self, drone: str) -> Telemetry:
        """Return what is known of a drone; the value stays current."""
        return self._drones.telemetry(drone)

    def why_not(self, drone: str, action: str, parameters: Mapping[str, Plain]) -> str | None:
        """Return why a drone's hardware cannot do a built-in action, or None."""
        return self._drones.why_not(drone, action, parameters)

    def begins(self, drone: str, job: Job | None, seconds: float) -> None:
        """A flight begins, which is expected to take so long."""
        self._drones.begins(drone, job, seconds)

    def mended(self, drone: str) -> None:
        """A person has looked after a lost drone: it may be asked again."""
        self._drones.mended(drone)

    async def reach(self, drone: str) -> bool:
        """Wait, after a failed flight, until a drone takes commands again; False: it is lost."""
        return await self._drones.reach(drone)

    async def fetched(self, drone: str) -> bool:
        """Wait until somebody has put a drone back into its dock, well; False: nobody does."""
        return await self._drones.fetched(drone)

    def unload(self, drone: str) -> None:
        """Whoever meets it takes off what it carries."""
        self._drones.unload(drone)

    async def roll_call(self, drone: str) -> Standing:
        """Ask a drone where it is and what it has done; say so if it does not answer."""
        return await self._drones.roll_call(drone)
