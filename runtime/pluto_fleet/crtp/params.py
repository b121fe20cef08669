"""The parameters of a drone."""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import IntEnum

from .battery import EMPTY, LOW
from .packets import TABLE_CHANNEL, Errno, Port, TableOfContents, packed
from .supervisor import LANDED

PARAM_TYPES = {"b": 0x00, "h": 0x01, "i": 0x02, "f": 0x06, "B": 0x08, "H": 0x09, "L": 0x0A}
_LETTERS = {kind: letter for letter, kind in PARAM_TYPES.items()}
_EXTENDED, _READ_ONLY = 0x10, 0x40

_READ, _WRITE, _MISC = 1, 2, 3
_PERSISTENT = 1
"""The only extended type."""


class Misc(IntEnum):
    """Commands of the miscellaneous channel."""

    SET_BY_NAME = 0
    CHANGED = 1
    EXTENDED_TYPE = 2
    STORE = 3
    STORED_STATE = 4
    CLEAR = 5
    DEFAULT = 6
    EXTENDED_TYPE_V2 = 7
    DEFAULT_V2 = 8


@dataclass(slots=True)
class Parameter:
    """A parameter and its value."""

    name: str
    letter: str
    value: float
    read_only: bool = False
    persistent: bool = False
    default: float | None = None
    stored: float | None = None

    def packed(self, value: float | None = None) -> bytes:
        """Return a value, or its own, as it is sent."""
        shown = self.value if value is None else value
        return struct.pack("<" + self.letter, shown if self.letter == "f" else int(shown))

    @property
    def kind(self) -> int:
        """How the table writes down its type."""
        flags = (_READ_ONLY if self.read_only else 0) | (_EXTENDED if self.persistent else 0)
        return PARAM_TYPES[self.letter] | flags


class Parameters:
    """The parameters of one drone; `changed` is called with each one set."""

    def __init__(
        self, parameters: Sequence[Parameter], changed: Callable[[str, float], None]
    ) -> None:
        self._all = parameters
        for one in parameters:
            one.default = one.value
        self._by_name = {one.name: one for one in parameters}
        self._changed = changed
        self._table = TableOfContents(Port.PARAMETERS, [(one.name, one.kind) for one in parameters])

    def __getitem__(self, name: str) -> float:
        return self._by_name[name].value

    def reset(self) -> None:
        """Reset all as after a restart, except for stored values."""
        for one in self._all:
            stored = one.stored if one.stored is not None else one.default
            assert stored is not None
            one.value = stored

    def put(self, name: str, value: float) -> bytes:
        """Change one from within; return the notification."""
        number = next(place for place, one in enumerate(self._all) if one.name == name)
        self._all[number].value = value
        return self._told(number)

    def take(self, channel: int, data: bytes) -> Sequence[bytes]:
        """Return the answers to a packet."""
        if channel == TABLE_CHANNEL:
            answer = self._table.answer(data)
            return [] if answer is None else [answer]
        if channel == _MISC:
            return [] if not data else self._misc(data)
        if len(data) < 2:
            return []
        number = int.from_bytes(data[:2], "little")
        if number >= len(self._all):
            return [packed(Port.PARAMETERS, channel, data[:2] + bytes([Errno.ENOENT]))]
        one, status = self._all[number], b"\0" if channel == _READ else b""
        if channel == _WRITE:
            self._set(one, data[2:])
        return [packed(Port.PARAMETERS, channel, data[:2] + status + one.packed())]

    def _set(self, one: Parameter, value: bytes) -> bool:
        form = "<" + one.letter
        if one.read_only or len(value) != struct.calcsize(form):
            return False
        (one.value,) = struct.unpack(form, value)
        self._changed(one.name, one.value)
        return True

    def _told(self, number: int) -> bytes:
        head = struct.pack("<BH", Misc.CHANGED, number)
        return packed(Port.PARAMETERS, _MISC, head + self._all[number].packed())

    def _misc(self, data: bytes) -> Sequence[bytes]:
        if data[0] == Misc.SET_BY_NAME:
            return self._by_its_name(data)
        if len(data) < 3:
            return []
        number = int.from_bytes(data[1:3], "little")
        one = self._all[number] if number < len(self._all) else None
        answer = bytes([Errno.ENOENT]) if one is None else _about(one, data[0])
        return [packed(Port.PARAMETERS, _MISC, data[:3] + answer)]

    def _by_its_name(self, data: bytes) -> Sequence[bytes]:
        """Set a parameter by name."""
        group, _, rest = data[1:].partition(b"\0")
        name, _, value = rest.partition(b"\0")
        one = self._by_name.get(b".".join((group, name)).decode("latin-1"))
        asked = packed(Port.PARAMETERS, _MISC, data[: len(data) - len(value)])
        if one is None or not value or _LETTERS.get(value[0]) != one.letter:
            return [asked + bytes([Errno.ENOENT])]
        done = self._set(one, value[1:])
        return [
            asked + bytes([Errno.OK if done else Errno.EINVAL]),
            self._told(self._all.index(one)),
        ]


def _about(one: Parameter, command: int) -> bytes:
    """Return a parameter's metadata."""
    match command:
        case Misc.EXTENDED_TYPE:
            return bytes([_PERSISTENT if one.persistent else 0])
        case Misc.EXTENDED_TYPE_V2:
            return bytes([Errno.OK, _PERSISTENT if one.persistent else 0])
        case Misc.DEFAULT:
            return one.packed(one.default)
        case Misc.DEFAULT_V2:
            return bytes([Errno.OK]) + one.packed(one.default)
        case Misc.STORE if one.persistent:
            one.stored = one.value
            return bytes([Errno.OK])
        case Misc.CLEAR if one.persistent:
            one.stored = None
            return bytes([Errno.OK])
        case Misc.STORED_STATE if one.persistent:
            kept = b"" if one.stored is None else one.packed(one.stored)
            return bytes([0 if one.stored is None else 1]) + one.packed(one.default) + kept
        case _:
            return bytes([Errno.ENOENT])


def parameters(cells: int = 1) -> list[Parameter]:
    """Return the parameters, as they are after a start."""
    numbers = [
        ("stabilizer.estimator", "B", 2),
        ("stabilizer.controller", "B", 1),
        ("stabilizer.stop", "B", 0),
        ("kalman.resetEstimation", "B", 0),
        ("kalman.initialX", "f", 0.0),
        ("kalman.initialY", "f", 0.0),
        ("kalman.initialZ", "f", 0.0),
        ("kalman.robustTdoa", "B", 0),
        ("locSrv.extPosStdDev", "f", 0.01),
        ("commander.enHighLevel", "B", 1),
        ("hlCommander.vtoff", "f", 0.5),
        ("hlCommander.vland", "f", 0.5),
        ("pm.lowVoltage", "f", LOW * cells),
        ("pm.criticalLowVoltage", "f", EMPTY * cells),
        ("supervisor.landedTimeout", "H", LANDED * 1000.0),
        ("posCtlPid.xVelMax", "f", 1.0),
        ("posCtlPid.yVelMax", "f", 1.0),
        ("posCtlPid.zVelMax", "f", 1.0),
        ("sound.effect", "B", 0),
        ("sound.freq", "H", 4000),
        ("led.bitmask", "B", 0),
        ("ring.effect", "B", 1),
        ("ring.solidRed", "B", 20),
        ("gripper.closed", "B", 0),
        ("gripper.force", "f", 0.5),
        ("motorPowerSet.enable", "B", 0),
    ]
    fixed = [
        ("cpu.flash", "H", 1024),
        ("cpu.id0", "L", 0x2A0034),
        ("deck.bcLighthouse4", "B", 1),
        ("deck.bcFlow2", "B", 0),
        ("deck.bcZRanger2", "B", 0),
        ("deck.bcLoco", "B", 0),
        ("deck.bcLedRing", "B", 1),
        ("deck.bcBuzzer", "B", 1),
        ("deck.bcAI", "B", 1),
        ("deck.bcMultiranger", "B", 1),
        ("firmware.revision0", "L", 0x2025C0DE),
        ("firmware.revision1", "H", 0x0ACE),
        ("firmware.modified", "B", 0),
        ("imu_sensors.BMP388", "B", 1),
        ("system.selftestPassed", "B", 1),
    ]
    kept = [("health.startPropTest", "B", 0), ("ring.ledIntensity", "B", 100)]
    return [
        *(Parameter(name, letter, value) for name, letter, value in numbers),
        *(Parameter(name, letter, value, read_only=True) for name, letter, value in fixed),
        *(Parameter(name, letter, value, persistent=True) for name, letter, value in kept),
    ]
