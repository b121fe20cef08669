"""What PX4 and ArduPilot must be told, each in its own way, and what their modes are called.

Each fact names the source that it was read in (docs/mavlink.md). A command that is accepted is not yet done.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, Protocol

ARM = 400
TAKEOFF = 22
LAND = 21
SET_MODE = 176
CHANGE_SPEED = 178
REPOSITION = 192
GRIPPER = 211
"""MAV_CMD."""
CUT = 21196
"""The second parameter of a command to disarm in the air (MAV_CMD_COMPONENT_ARM_DISARM)."""
_CUSTOM_MODE = 1
_TAKES_MODE = 1
"""MAV_DO_REPOSITION_FLAGS_CHANGE_MODE."""
_ABOVE_SEA = 5
_ABOVE_HOME = 3
"""MAV_FRAME_GLOBAL_INT, metres above sea level, as both makes take it; MAV_FRAME_GLOBAL_RELATIVE_ALT."""

ACCEPTED = 0
NOT_NOW = 1
IN_PROGRESS = 5
ANSWERS = {
    1: "it rejects that for now",
    2: "it denies that",
    3: "it does not know that command",
    4: "it could not do that",
    6: "it broke that off",
}
"""MAV_RESULT."""


@dataclass(frozen=True, slots=True)
class Order:
    """A command as it is sent."""

    message: str
    fields: Mapping[str, Any]


@dataclass(frozen=True, slots=True)
class Place:
    """Where to fly, as autopilots are told: degrees, and metres above sea level and above home."""

    latitude: float
    longitude: float
    above_sea: float
    above_home: float


def long(command: int, *values: float | None) -> Order:
    given = {f"param{number}": value for number, value in enumerate(values, 1)}
    return Order("COMMAND_LONG", {"command": command, **given})


def reposition(place: Place, speed: float | None, flags: int) -> Order:
    """Return the command to fly to a place; as COMMAND_INT, for as a float a latitude would be a metre off."""
    fields = {
        "command": REPOSITION,
        "frame": _ABOVE_SEA,
        "param1": speed,
        "param2": flags,
        "x": round(place.latitude * 1e7),
        "y": round(place.longitude * 1e7),
        "z": place.above_sea,
    }
    return Order("COMMAND_INT", fields)


def grips(number: int, close: bool) -> Order:
    return long(GRIPPER, number, 1 if close else 0)


CUT_MOTORS = long(ARM, 0, CUT)
LAND_HERE = long(LAND)


class Make(Protocol):
    """How one make is told."""

    name: str

    def arms(self) -> Sequence[Order]:
        """Return the commands that arm it, one after the other."""
        ...

    def rises(self, place: Place) -> Sequence[Order]:
        """Return the commands that let it take off, once it is armed."""
        ...

    def goes(self, place: Place, speed: float, stays: bool) -> Sequence[Order]:
        """Return the commands that send it to a place at no more than a speed.

        `stays`: its mode need not change for that; where it has taken another one by itself meanwhile, it should refuse.
        """
        ...

    def holds(self) -> Sequence[Order]:
        """Return the commands that stop it."""
        ...

    def mode_name(self, number: int) -> str:
        """Return what its present mode is called."""
        ...

    modes: ClassVar[Mapping[str, frozenset[int]]]
    """In which modes it may be, by what it was told: `rise`, `go`, `hold`, `land`; `return` is what it does by itself."""


class Px4:
    name = "PX4"
    _AUTO = 4
    _SUB: ClassVar[Mapping[int, str]] = {
        1: "Ready",
        2: "Takeoff",
        3: "Hold",
        4: "Mission",
        5: "Return",
        6: "Land",
    }
    _MAIN: ClassVar[Mapping[int, str]] = {
        1: "Manual",
        2: "Altitude",
        3: "Position",
        5: "Acro",
        6: "Offboard",
        7: "Stabilized",
    }

    modes: ClassVar[Mapping[str, frozenset[int]]] = {
        "rise": frozenset({_AUTO << 16 | 2 << 24, _AUTO << 16 | 3 << 24}),
        "go": frozenset({_AUTO << 16 | 3 << 24}),
        "hold": frozenset({_AUTO << 16 | 3 << 24}),
        "land": frozenset({_AUTO << 16 | 6 << 24}),
        "return": frozenset({_AUTO << 16 | 5 << 24}),
    }

    def arms(self) -> Sequence[Order]:
        """It does not arm in the mode in which it has landed."""
        return [self._mode(3), long(ARM, 1, 0)]

    def rises(self, place: Place) -> Sequence[Order]:
        """A height above sea level is taken as it is."""
        return [long(TAKEOFF, None, None, None, None, None, None, place.above_sea)]

    def goes(self, place: Place, speed: float, stays: bool) -> Sequence[Order]:
        """The speed is that of the command: DO_CHANGE_SPEED is accepted, and is for missions.

        It does not know the command without the flag.
        """
        return [reposition(place, speed, _TAKES_MODE)]

    def holds(self) -> Sequence[Order]:
        return [self._mode(3)]

    def _mode(self, sub: int) -> Order:
        return long(SET_MODE, _CUSTOM_MODE, self._AUTO, sub)

    def mode_name(self, number: int) -> str:
        main = number >> 16 & 0xFF
        sub = number >> 24
        name = self._SUB.get(sub) if main == self._AUTO else self._MAIN.get(main)
        return name or f"{main}.{sub}"


class ArduPilot:
    name = "ArduPilot"
    _GUIDED = 4
    _LAND = 9
    _BRAKE = 17
    _TAKEOFF: ClassVar[dict[str, Any]] = {
        "command": TAKEOFF,
        "frame": _ABOVE_HOME,  # it denies any other
        "param1": 0,
        "param2": 0,
        "x": 0,
        "y": 0,
    }
    _NAMES: ClassVar[Mapping[int, str]] = {
        0: "Stabilize",
        2: "AltHold",
        3: "Auto",
        4: "Guided",
        5: "Loiter",
        6: "RTL",
        9: "Land",
        16: "PosHold",
        17: "Brake",
        21: "SmartRTL",
    }
    modes: ClassVar[Mapping[str, frozenset[int]]] = {
        "rise": frozenset({_GUIDED}),
        "go": frozenset({_GUIDED}),
        "hold": frozenset({_BRAKE}),
        "land": frozenset({_LAND}),
        "return": frozenset({6, 21}),
    }

    def arms(self) -> Sequence[Order]:
        return [self._mode(self._GUIDED), long(ARM, 1, 0)]

    def rises(self, place: Place) -> Sequence[Order]:
        return [Order("COMMAND_INT", self._TAKEOFF | {"z": place.above_home})]

    def goes(self, place: Place, speed: float, stays: bool) -> Sequence[Order]:
        """The speed comes after the place: a new leg begins at that of its parameters."""
        return [
            reposition(place, None, 0 if stays else _TAKES_MODE),
            long(CHANGE_SPEED, 1, speed, -1),
        ]

    def holds(self) -> Sequence[Order]:
        """Brake, as in Loiter the sticks of a transmitter count: with the throttle down it would sink."""
        return [self._mode(self._BRAKE)]

    def _mode(self, number: int) -> Order:
        return long(SET_MODE, _CUSTOM_MODE, number)

    def mode_name(self, number: int) -> str:
        return self._NAMES.get(number, str(number))


MAKES: Mapping[str, Make] = {"px4": Px4(), "ardupilot": ArduPilot()}
"""By what MAVSDK calls them."""
