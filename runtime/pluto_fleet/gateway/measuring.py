"""Measuring what drones fly: how long each command really took, and what it used of the battery."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

from ..jobs.flown import BROKEN_OFF, DONE, FAILED, TAKE_OFF
from ..shared.domain.errors import Cancelled, Failure, FlightFailed

if TYPE_CHECKING:
    from ..jobs.controls import FleetDrone
    from ..jobs.flown import Flown
    from ..jobs.telemetry import Telemetry
    from ..shared.domain.model import Point
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
        self._kernel, self._telemetry, self._drones = kernel, telemetry, drones
        self._hear = hear
        self.moving: set[str] = set()
        """The drones that carry out a command now."""

    async def measured(
        self,
        drone: str,
        what: str,
        command: Coroutine[Any, Any, T],
        *,
        to: Point | None = None,
        height: float | None = None,
        **more: object,
    ) -> T:
        """Carry out a command `to` a point, or to a `height` here, and tell how that went."""
        telemetry, category = self._telemetry[drone], self._drones[drone].category
        if telemetry.landed is not (what == TAKE_OFF):
            return await command  # it is refused, or there is nothing to do
        begun, start, level = self._kernel.now, telemetry.location, telemetry.battery_level
        end = to or (start if height is None else (*start[:2], height))
        if what == TAKE_OFF:
            more = {"flight_time": category.flight_time, "charge_time": category.charge_time}

        def tell(ended: str) -> None:
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
