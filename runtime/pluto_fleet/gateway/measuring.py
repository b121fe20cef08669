"""Measuring what drones fly: how long each command really took, and what it used of the battery."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

from ..jobs.controls import Act, GoTo, Land, TakeOff
from ..jobs.flown import ACTION, BROKEN_OFF, DONE, FAILED, LAND, LEG, TAKE_OFF
from ..shared.domain.errors import Cancelled, Failure, FlightFailed

if TYPE_CHECKING:
    from ..jobs.controls import Command, FleetDrone
    from ..jobs.flown import Flown
    from ..jobs.telemetry import Telemetry
    from ..shared.time.kernel import Kernel

T = TypeVar("T")


class Measuring:
    """Tells how each command went that moves a flying drone, or acts with it."""

    def __init__(
        self,
        kernel: Kernel,
        telemetry: Mapping[str, Telemetry],
        drones: Mapping[str, FleetDrone],
        hear: Callable[[Flown], object],
    ) -> None:
        """`drones` is kept up to date by its owner."""
        self._kernel = kernel
        self._telemetry = telemetry
        self._drones = drones
        self._hear = hear
        self.moving: set[str] = set()
        """The drones that carry out a command now."""
        self.turned: set[str] = set()
        """Those that were sent elsewhere on their way: their legs were not flown as they began."""

    async def measured(
        self, drone: str, command: Command, carried_out: Coroutine[Any, Any, T]
    ) -> T:
        """Carry out a command, and tell how that went, if it moves a flying drone, or acts with it."""
        telemetry = self._telemetry[drone]
        category = self._drones[drone].category
        begun, start, level = self._kernel.now, telemetry.location, telemetry.battery_level
        more: dict[str, object] = {}
        match command:
            case TakeOff(height) if telemetry.landed:
                what = TAKE_OFF
                end = (*start[:2], height)
                more = {"flight_time": category.flight_time, "charge_time": category.charge_time}
            case GoTo(target, _) if not telemetry.landed:
                what = LEG
                end = target
            case Land() if not telemetry.landed:
                what = LAND
                end = (*start[:2], 0.0)
            case Act(action) if not telemetry.landed:
                what = ACTION
                end = start
                more = {"action": action}
            case _:
                return await carried_out

        def tell(ended: str) -> None:
            if ended == BROKEN_OFF:
                more["at"] = [round(one, 3) for one in telemetry.location]
            self._hear(
                {
                    "drone": drone,
                    "category": category.name,
                    "what": what,
                    "from": list(start),
                    "to": list(end),
                    "speed": category.speed,
                    "seconds": round(self._kernel.now - begun, 4),
                    "battery": [round(level, 5), round(telemetry.battery_level, 5)],
                    "ended": ended,
                    **more,
                }
            )

        self.moving.add(drone)
        try:
            result = await carried_out
        except FlightFailed as error:
            tell(BROKEN_OFF if error.failure is Failure.REFUSED else FAILED)
            raise
        except Cancelled:
            tell(BROKEN_OFF)
            raise
        finally:
            self.moving.discard(drone)
            is_as_told = drone not in self.turned
            self.turned.discard(drone)
        tell(DONE if is_as_told else BROKEN_OFF)
        return result
