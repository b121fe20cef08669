"""The options of Crazyflies in a fleet file: `[navigation.crazyflie]`, overridden by `[drone.options]`."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from math import sqrt
from sys import float_info

from ..files.addresses import USUAL, radio_bytes
from ..shared.domain.actions import BUILT_IN, PICK
from ..shared.domain.errors import BadInput
from ..shared.domain.text import number, quoted


@dataclass(frozen=True, slots=True, kw_only=True)
class Gripper:
    """A gripper deck, controlled by a parameter."""

    parameter: str
    pick: float
    release: float
    seconds: float = BUILT_IN[PICK].seconds
    """How long it takes to close or to open."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CrazyflieOptions:
    """The validated options."""

    measure: Mapping[str, str]
    """The log variable of each quantity that can be measured; ANY_OTHER: of all others."""
    measure_seconds: float
    """Seconds over which a measurement is averaged."""
    camera: tuple[str, int] | None
    """The address of the AI-deck's streamer."""
    camera_view: tuple[float, float]
    """The field of view in degrees: across and along."""
    grip: Gripper | None
    decks: tuple[str, ...]
    """The decks that it must have, as the firmware names them."""
    cells: int
    """The number of cells in series: two on a Bolt or a Flapper."""
    least_voltage: float
    """Volts of a cell at rest below which it does not take off."""
    sure_within: float
    """The largest standard deviation of its position for a take-off, in metres."""
    lost_beyond: float
    """The largest standard deviation of its position in the air, in metres: beyond, it lands."""
    starts_at_home: bool
    """It only measures its relative movement: its position is set to its home at the start."""
    addresses: tuple[str, ...]
    """Radio addresses to scan."""
    udp: tuple[str, ...]
    """Addresses of simulated drones to scan."""

    def variable_of(self, quantity: str) -> str | None:
        """Return the log variable of a quantity; None: it has none."""
        return self.measure.get(quantity, self.measure.get(ANY_OTHER))


ANY_OTHER = "*"
"""The key in `measure` for all quantities that are not named there."""

_KNOWN = tuple(field.name for field in fields(CrazyflieOptions))
_VIEW = (65.0, 50.0)
_LEAST_VOLTAGE = 3.7
SURE_WITHIN = 0.07
"""Metres: with radio beacons (Loco) it is sure to five centimetres, with others to two."""
LOST_BEYOND = sqrt(0.05)
"""Metres, about 0.22: three times the largest deviation while it receives its beacons."""
_LONGEST = 10.0
_CELLS = 6


def options_of(given: Mapping[str, object]) -> CrazyflieOptions:
    """Read the options; raise `BadInput` with the key that is invalid."""
    for key in given:
        if key not in _KNOWN:
            raise BadInput(f"a Crazyflie has no option {quoted(key)}; it has {', '.join(_KNOWN)}")
    reading = _OptionReader(given)
    sure_within = reading.length("sure_within", SURE_WITHIN)
    lost_beyond = reading.length("lost_beyond", max(LOST_BEYOND, sure_within))
    if lost_beyond < sure_within:
        raise reading.bad("lost_beyond", f"at least sure_within, which is {number(sure_within)}")
    return CrazyflieOptions(
        measure=reading.names("measure"),
        measure_seconds=reading.number("measure_seconds", 1.0, least=0.0),
        camera=reading.address("camera"),
        camera_view=reading.view("camera_view"),
        grip=reading.grip("grip"),
        decks=reading.texts("decks", ()),
        cells=reading.count("cells", 1, most=_CELLS),
        least_voltage=reading.number("least_voltage", _LEAST_VOLTAGE, least=0.0),
        sure_within=sure_within,
        lost_beyond=lost_beyond,
        starts_at_home=reading.flag("starts_at_home"),
        addresses=reading.radio_addresses("addresses"),
        udp=reading.texts("udp", ()),
    )


@dataclass(frozen=True, slots=True)
class _OptionReader:
    """Reads a table of options."""

    given: Mapping[str, object]

    def bad(self, key: str, wanted: str) -> BadInput:
        return BadInput(f"its option {key} must be {wanted}")

    def number(self, key: str, default: float, *, least: float) -> float:
        value = _number(self.given.get(key, default))
        if value is None or value < least:
            raise self.bad(key, f"a number from {least:g} on")
        return value

    def count(self, key: str, default: int, *, most: int) -> int:
        value = self.given.get(key, default)
        if not isinstance(value, int) or isinstance(value, bool) or not 1 <= value <= most:
            raise self.bad(key, f"a whole number from 1 to {most}")
        return value

    def length(self, key: str, default: float) -> float:
        value = _number(self.given.get(key, default))
        if value is None or not 0.0 < value <= _LONGEST:
            raise self.bad(key, f"a number of metres above 0, at most {_LONGEST:g}")
        return value

    def flag(self, key: str) -> bool:
        value = self.given.get(key, False)
        if not isinstance(value, bool):
            raise self.bad(key, "true or false")
        return value

    def texts(self, key: str, default: tuple[str, ...]) -> tuple[str, ...]:
        value = self.given.get(key, default)
        if isinstance(value, str):
            return (value,)
        if not isinstance(value, (list, tuple)) or not all(isinstance(one, str) for one in value):
            raise self.bad(key, 'a list of texts, such as ["bcLighthouse4"]')
        return tuple(value)

    def radio_addresses(self, key: str) -> tuple[str, ...]:
        found = self.texts(key, (USUAL,))
        try:
            return tuple(radio_bytes(one).hex().upper() for one in found)
        except ValueError as error:
            raise BadInput(f"its option {key}: {error}") from error

    def names(self, key: str) -> Mapping[str, str]:
        value = self.given.get(key, {})
        if not isinstance(value, Mapping):
            raise self.bad(key, 'a table, such as { temperature = "bme.temp" }')
        for quantity, name in value.items():
            if not _is_name(name):
                raise self.bad(f"{key}.{quantity}", 'a log variable, such as "bme.temp"')
        return dict(value)

    def address(self, key: str) -> tuple[str, int] | None:
        value = self.given.get(key)
        if value is None:
            return None
        host, _, port = value.rpartition(":") if isinstance(value, str) else ("", "", "")
        if not host or not port.isdecimal() or not 0 < int(port) < 65536:
            raise self.bad(key, 'a host and a port, such as "192.168.4.1:5000"')
        return host.removeprefix("[").removesuffix("]"), int(port)

    def view(self, key: str) -> tuple[float, float]:
        match self.given.get(key, _VIEW):
            case [across, along]:
                angles = _number(across) or 0.0, _number(along) or 0.0
                if all(0.0 < angle < 180.0 for angle in angles):
                    return angles
        raise self.bad(key, "two angles in degrees, such as [65, 50]")

    def grip(self, key: str) -> Gripper | None:
        match self.given.get(key):
            case None:
                return None
            case {"parameter": str(name), "pick": pick, "release": release, **rest} if _is_name(
                name
            ) and rest.keys() <= {"seconds"}:
                match _number(pick), _number(release), _number(
                    rest.get("seconds", BUILT_IN[PICK].seconds)
                ):
                    case (float(on), float(off), float(seconds)) if seconds >= 0.0:
                        return Gripper(parameter=name, pick=on, release=off, seconds=seconds)
        wanted = 'a table, such as { parameter = "gripper.closed", pick = 1, release = 0 }'
        raise self.bad(key, wanted)


def _number(value: object) -> float | None:
    """Return a finite number, and None for everything else."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return None
    return float(value) if abs(value) <= float_info.max else None


def _is_name(value: object) -> bool:
    """Return whether this is a name as in the firmware: a group, a dot and a name."""
    return isinstance(value, str) and value.count(".") == 1 and all(value.split("."))
