"""The parameters of a drone."""

from __future__ import annotations

import struct
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from .battery import EMPTY, LOW
from .commander import LANDED
from .packets import TABLE_CHANNEL, Errno, Port, TableOfContents, packed

_TYPES = {"b": 0x00, "h": 0x01, "i": 0x02, "f": 0x06, "B": 0x08, "H": 0x09, "L": 0x0A}
_EXTENDED, _READ_ONLY = 0x10, 0x40
_READ, _WRITE, _MISC = 1, 2, 3
_EXTENDED_TYPE = 2
_EXTENDED_TYPE_V2 = 7
"""The commands of the miscellaneous channel that cflib sends as it connects."""
_PERSISTENT = 1
"""The only extended type."""


@dataclass(slots=True)
class Parameter:
    """A parameter and its value."""

    name: str
    letter: str
    value: float
    read_only: bool = False
    persistent: bool = False

    def packed(self) -> bytes:
        value = self.value if self.letter == "f" else int(self.value)
        return struct.pack("<" + self.letter, value)

    @property
    def kind(self) -> int:
        """How the table writes down its type."""
        flags = (_READ_ONLY if self.read_only else 0) | (_EXTENDED if self.persistent else 0)
        return _TYPES[self.letter] | flags


class Parameters:
    """The parameters of one drone; `changed` is called with each one set."""

    def __init__(
        self, parameters: Sequence[Parameter], changed: Callable[[str, float], None]
    ) -> None:
        self._all = parameters
        self._defaults = [one.value for one in parameters]
        self._by_name = {one.name: one for one in parameters}
        self._changed = changed
        self._table = TableOfContents(Port.PARAMETERS, [(one.name, one.kind) for one in parameters])

    def __getitem__(self, name: str) -> float:
        return self._by_name[name].value

    def __setitem__(self, name: str, value: float) -> None:
        self._by_name[name].value = value

    def reset(self) -> None:
        for one, default in zip(self._all, self._defaults, strict=True):
            one.value = default

    def take(self, channel: int, data: bytes) -> bytes | None:
        if channel == TABLE_CHANNEL:
            return self._table.answer(data)
        head, rest = (data[:3], data[1:3]) if channel == _MISC else (data[:2], data[:2])
        if len(rest) < 2:
            return None
        number = int.from_bytes(rest, "little")
        one = self._all[number] if number < len(self._all) else None
        if one is None or (channel == _MISC and data[0] not in (_EXTENDED_TYPE, _EXTENDED_TYPE_V2)):
            return packed(Port.PARAMETERS, channel, head + bytes([Errno.ENOENT]))
        if channel == _MISC:
            status = bytes([Errno.OK]) if data[0] == _EXTENDED_TYPE_V2 else b""
            kind = bytes([_PERSISTENT if one.persistent else 0])
            return packed(Port.PARAMETERS, channel, head + status + kind)
        if channel == _WRITE:
            self._set(one, data[2:])
        status = b"\0" if channel == _READ else b""
        return packed(Port.PARAMETERS, channel, head + status + one.packed())

    def _set(self, one: Parameter, value: bytes) -> None:
        form = "<" + one.letter
        if not one.read_only and len(value) == struct.calcsize(form):
            (one.value,) = struct.unpack(form, value)
            self._changed(one.name, one.value)


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
