"""What a vehicle's autopilot is set to: its own failsafes, which are read once, and the map, which it gets as its fence.

That fence is the map, and its ceiling, each by some metres more. No-fly areas are ours alone: drones fly along their
edges, and places by satellites are metres off.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping, Sequence
from math import inf
from typing import TYPE_CHECKING, Any

from ..drones.protocol import DroneSetup, LinkLost, NavigationError, Rejected
from ..shared.domain.text import number
from . import own_failsafes
from .options import VehicleOptions

if TYPE_CHECKING:
    from ..geodesy import LocalPlane
    from ..shared.domain.airspace import Airspace

_PARAMETER = 6.0
"""The time-out of a parameter."""
_UPLOAD = 10.0
"""Seconds for a fence, of some messages each way."""


class AutopilotSettings:
    """The settings of one vehicle's autopilot."""

    def __init__(
        self, setup: DroneSetup, options: VehicleOptions, ask: Callable[..., Awaitable[Any]]
    ) -> None:
        self._drone = setup.id
        self._setup = setup
        self._options = options
        self._ask = ask
        self._parameters: dict[str, float] = {}
        self._was_asked = False
        """Those of `own_failsafes`, and whether it was asked for them."""
        self._has_fence = False

    def forget(self) -> None:
        """Begin anew: it may be another vehicle, or have been set anew."""
        self._parameters = {}
        self._was_asked = False
        self._has_fence = False

    async def read(self, name: str) -> float:
        """Return a parameter; raise `Rejected` if there is none of this name."""
        return float(await self._ask("read", _PARAMETER, name=name))

    async def write(self, name: str, value: float) -> None:
        """Set a parameter."""
        try:
            await self._ask("write", _PARAMETER, name=name, value=value)
        except Rejected as error:
            raise Rejected(f"{self._drone}: {name} was not set: {error}") from None

    async def look(self, make: str) -> bool:
        """Read what it does by itself, once; return whether that was now.

        A parameter that it does not have, or tell, is passed over.
        """
        if self._was_asked:
            return False
        for name in own_failsafes.PARAMETERS[make]:
            try:
                self._parameters[name] = await self.read(name)
            except Rejected:
                continue
            except LinkLost:
                break  # it tells none, or is not heard at all, which the next command says
        self._was_asked = True
        return True

    def does(self, make: str) -> Mapping[str, str]:
        """Return what it does by itself, as far as that was read."""
        return own_failsafes.described(make, self._parameters, self._highest)

    def too_slow(self, make: str) -> str | None:
        """Return why it cannot fly as fast as its category does, or None."""
        most = own_failsafes.fastest(make, self._parameters)
        if most is None or self._setup.speed <= most:
            return None
        slower = f"it flies no faster than {number(most)} m/s (MPC_XY_VEL_MAX)"
        return f"its category's speed is {number(self._setup.speed)} m/s, and {slower}"

    async def fence_in(self, make: str) -> str | None:
        """Give it the map as its fence, once; return why it has none."""
        airspace = self._setup.airspace
        plane = self._setup.plane
        if self._has_fence or not self._options.fence or airspace is None or plane is None:
            return None
        try:
            beyond = self._options.beyond
            corners = _corners(airspace, plane, beyond)
            await self._ask("fence", _UPLOAD, corners=corners)
            # one that climbs through its fence to return would hold there, until its battery is empty
            returns = own_failsafes.return_height(make, self._parameters)
            height = max(self._highest, returns or 0.0) + beyond
            for name, value in _limits(make, height).items():
                await self.write(name, value)
        except (ValueError, NavigationError) as error:
            return (
                f"it has no fence around the map ({error}); fence = false in [navigation.mavlink] flies"
                " without one"
            )
        self._has_fence = True
        return None

    @property
    def _highest(self) -> float:
        """The height above its home up to which it may fly."""
        airspace = self._setup.airspace
        return inf if airspace is None else airspace.ceiling - self._setup.home[2]


_HEIGHT_AND_POLYGON = 1 | 4
"""Of FENCE_TYPE: without the circle around home, which is 300 m wide unless it is set otherwise."""


def _corners(airspace: Airspace, plane: LocalPlane, beyond: float) -> Sequence[tuple[float, float]]:
    """Return latitude and longitude of the corners of a map that is larger by so many metres all around.

    Raises `ValueError` if it reaches too far from its origin.
    """
    width, depth = airspace.size
    left = -beyond
    right = width + beyond
    low = -beyond
    high = depth + beyond
    around = ((left, low), (right, low), (right, high), (left, high))
    places = [plane.to_degrees((x, y, 0.0)) for x, y in around]
    return [(latitude, longitude) for latitude, longitude, _ in places]


def _limits(make: str, height: float) -> Mapping[str, float]:
    """Return the parameters that let it keep its fence, to a height above its home in metres.

    What it does beyond it stays as it is set.
    """
    if make == "PX4":
        return {"GF_MAX_VER_DIST": height}
    return {
        "FENCE_TYPE": _HEIGHT_AND_POLYGON,
        "FENCE_ALT_MAX": height,
        "FENCE_ENABLE": 1,
    }
