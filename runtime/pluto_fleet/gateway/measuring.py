"""Measuring what drones fly: how long each command really took, and what it used of the battery."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypeVar

from ..jobs.controls import ForwardingControls
from ..jobs.flown import ACTION, BROKEN_OFF, DONE, FAILED, LAND, LEG, TAKE_OFF
from ..shared.domain.errors import Cancelled, Failure, FlightFailed

if TYPE_CHECKING:
    from ..jobs.controls import Controls, FleetDrone
    from ..jobs.flown import Flown
    from ..shared.domain.actions import Plain
    from ..shared.domain.model import Item, Point
    from ..shared.time.kernel import Kernel

T = TypeVar("T")


class MeasuringControls(ForwardingControls):
    """Controls that tell how each command went that moves a flying drone, or acts with it."""

    def __init__(
        self,
        kernel: Kernel,
        controls: Controls,
        drones: Sequence[FleetDrone],
        hear: Callable[[Flown], object],
    ) -> None:
        super().__init__(controls)
        self._kernel, self._hear = kernel, hear
        self._categories = {drone.id: drone.category for drone in drones}
        self.moving: set[str] = set()
        """The drones that carry out a command now."""

    def join(self, drone: FleetDrone) -> None:
        """Measure a drone that has joined, too."""
        self._categories[drone.id] = drone.category

    async def takeoff(self, drone: str, height: float) -> None:
        """Take off to a height."""
        x, y, _ = self.telemetry[drone].location
        category, command = self._categories[drone], self._controls.takeoff(drone, height)
        battery = {"flight_time": category.flight_time, "charge_time": category.charge_time}
        await self._measured(drone, TAKE_OFF, (x, y, height), command, **battery)

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        await self._measured(drone, LEG, target, self._controls.go_to(drone, target))

    async def land(self, drone: str) -> None:
        """Land here."""
        x, y, _ = self.telemetry[drone].location
        await self._measured(drone, LAND, (x, y, 0.0), self._controls.land(drone))

    async def act(
        self,
        drone: str,
        action: str,
        parameters: Mapping[str, Plain],
        item: Item | None,
        job: str | None,
    ) -> object:
        """Do a built-in action here, and return its result."""
        command = self._controls.act(drone, action, parameters, item, job)
        here = self.telemetry[drone].location
        return await self._measured(drone, ACTION, here, command, action=action)

    async def _measured(
        self,
        drone: str,
        what: str,
        to: Point,
        command: Coroutine[Any, Any, T],
        **more: object,
    ) -> T:
        telemetry, category = self.telemetry[drone], self._categories[drone]
        if telemetry.landed is not (what == TAKE_OFF):
            return await command  # it is refused, or there is nothing to do
        begun, start, level = self._kernel.now, telemetry.location, telemetry.battery_level

        def tell(ended: str) -> None:
            self._hear(
                {
                    "drone": drone,
                    "category": category.name,
                    "what": what,
                    "from": list(start),
                    "to": list(to),
                    "speed": category.speed,
                    "seconds": round(self._kernel.now - begun, 4),
                    "battery": [round(level, 5), round(telemetry.battery_level, 5)],
                    "ended": ended,
                    **more,
                }
            )

        self.moving.add(drone)
        try:
            result = await command
        except FlightFailed as error:
            tell(BROKEN_OFF if error.failure is Failure.REFUSED else FAILED)
            raise
        except Cancelled:
            tell(BROKEN_OFF)
            raise
        finally:
            self.moving.discard(drone)
        tell(DONE)
        return result

    # What is not measured

    async def hold(self, drone: str) -> None:
        """Hover, for as long as an action of the app's own takes."""
        await self._controls.hold(drone)

    async def read(self, drone: str, name: str) -> float:
        """Return a sensor or variable of a drone."""
        return await self._controls.read(drone, name)

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set a parameter of a drone."""
        await self._controls.write(drone, name, value)

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover."""
        self._controls.break_off(drone)

    async def cut(self, drone: str) -> None:
        """Switch its motors off."""
        await self._controls.cut(drone)
