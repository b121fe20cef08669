"""Log blocks: variables that a drone sends periodically."""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from functools import partial

from ..process.surroundings import quantities_in
from ..shared.alone.world import World
from .battery import CarriedBody
from .body import Body
from .commander import Supervisor
from .packets import TABLE_CHANNEL, Errno, Port, TableOfContents, packed

_TYPES = {"B": 1, "H": 2, "L": 3, "b": 4, "h": 5, "i": 6, "f": 7, "e": 8}
_LETTERS = {kind: letter for letter, kind in _TYPES.items()}

_CONTROL, _DATA = 1, 2

MOST_BYTES, MOST_BLOCKS, MOST_VARIABLES = 26, 16, 128
_TICK = 0.01
"""Seconds; periods are so many of them."""

Reader = Callable[[], float]


class BlockCommand(IntEnum):
    """Commands for a block."""

    DELETE = 2
    START = 3
    STOP = 4
    RESET = 5
    CREATE = 6
    APPEND = 7


@dataclass(slots=True)
class _Block:
    readers: list[tuple[str, Reader]] = field(default_factory=list)
    period: float = 0.0
    """Seconds; 0: it is not sent."""
    due: float = 0.0

    @property
    def size(self) -> int:
        return sum(struct.calcsize("<" + letter) for letter, _ in self.readers)


class Logs:
    """The log blocks of one drone."""

    def __init__(self, variables: Mapping[str, tuple[str, Reader]]) -> None:
        self._readers = [reader for _, reader in variables.values()]
        kinds = [(name, _TYPES[letter]) for name, (letter, _) in variables.items()]
        self._table = TableOfContents(Port.LOG, kinds, bytes([MOST_BLOCKS, MOST_VARIABLES]))
        self._blocks: dict[int, _Block] = {}

    def reset(self) -> None:
        self._blocks.clear()

    def take(self, channel: int, data: bytes, now: float) -> bytes | None:
        if channel == TABLE_CHANNEL:
            return self._table.answer(data)
        if channel != _CONTROL or not data:
            return None
        number = data[1] if len(data) > 1 else 0
        return packed(Port.LOG, _CONTROL, bytes([data[0], number, self._do(data, number, now)]))

    def due(self, now: float) -> Iterator[bytes]:
        for number, block in self._blocks.items():
            if block.period <= 0.0 or now < block.due:
                continue
            block.due += block.period * max(1, int((now - block.due) / block.period))
            stamp = (int(now * 1000.0) & 0xFFFFFF).to_bytes(3, "little")
            values = b"".join(_written(letter, read()) for letter, read in block.readers)
            yield packed(Port.LOG, _DATA, bytes([number]) + stamp + values)

    def _do(self, data: bytes, number: int, now: float) -> Errno:
        command = data[0]
        if command == BlockCommand.RESET:
            self.reset()
            return Errno.OK
        if command == BlockCommand.CREATE:
            return self._create(number, data[2:])
        block = self._blocks.get(number)
        if block is None:
            return Errno.ENOENT
        match command:
            case BlockCommand.APPEND:
                return self._append(block, data[2:])
            case BlockCommand.DELETE:
                del self._blocks[number]
            case BlockCommand.START:
                if len(data) < 3 or not data[2]:
                    return Errno.EINVAL
                block.period, block.due = data[2] * _TICK, now
            case BlockCommand.STOP:
                block.period = 0.0
            case _:
                return Errno.ENOEXEC
        return Errno.OK

    def _create(self, number: int, variables: bytes) -> Errno:
        if number in self._blocks:
            return Errno.EEXIST
        if len(self._blocks) >= MOST_BLOCKS:
            return Errno.ENOMEM
        block = _Block()
        error = self._append(block, variables)
        if error is Errno.OK:
            self._blocks[number] = block
        return error

    def _append(self, block: _Block, variables: bytes) -> Errno:
        added: list[tuple[str, Reader]] = []
        for kind, variable in struct.iter_unpack("<BH", variables[: len(variables) // 3 * 3]):
            letter = _LETTERS.get(kind & 0x0F)
            if letter is None or variable >= len(self._readers):
                return Errno.ENOENT
            added.append((letter, self._readers[variable]))
        used = sum(len(other.readers) for other in self._blocks.values())
        if used + len(added) > MOST_VARIABLES:
            return Errno.ENOMEM
        if _Block(block.readers + added).size > MOST_BYTES:
            return Errno.E2BIG
        block.readers += added
        return Errno.OK


_WHOLE = {"B": (0, 0xFF), "H": (0, 0xFFFF), "L": (0, 0xFFFFFFFF)} | {
    "b": (-0x80, 0x7F),
    "h": (-0x8000, 0x7FFF),
    "i": (-0x80000000, 0x7FFFFFFF),
}


def _written(letter: str, value: float) -> bytes:
    """Pack a value, limited to the range of its type."""
    if letter in _WHOLE:
        low, high = _WHOLE[letter]
        return struct.pack("<" + letter, min(high, max(low, int(value))))
    return struct.pack("<" + letter, value)


_FAR = 4.0
"""The reading of a range sensor without an obstacle, in metres."""


def variables(
    body: Body,
    battery: CarriedBody,
    supervisor: Supervisor,
    names: Mapping[str, str],
    *,
    variance: Reader,
    info: Reader,
    holds: Reader,
) -> Mapping[str, tuple[str, Reader]]:
    """Return the log variables: the type of each, and its reader."""
    measured = {name: ("f", partial(battery.read, quantity)) for quantity, name in names.items()}
    return {
        **measured,
        "stateEstimate.x": ("f", lambda: body.estimate[0]),
        "stateEstimate.y": ("f", lambda: body.estimate[1]),
        "stateEstimate.z": ("f", lambda: body.estimate[2]),
        "stateEstimate.vx": ("f", lambda: body.velocity[0]),
        "stateEstimate.vy": ("f", lambda: body.velocity[1]),
        "stateEstimate.vz": ("f", lambda: body.velocity[2]),
        "stateEstimate.roll": ("f", lambda: 175.0 if body.tumbled else 0.0),
        "stateEstimate.pitch": ("f", lambda: 0.0),
        "stateEstimate.yaw": ("f", lambda: math.degrees(body.yaw)),
        "kalman.stateX": ("f", lambda: body.estimate[0]),
        "kalman.stateY": ("f", lambda: body.estimate[1]),
        "kalman.stateZ": ("f", lambda: body.estimate[2]),
        "kalman.varPX": ("f", variance),
        "kalman.varPY": ("f", variance),
        "kalman.varPZ": ("f", variance),
        "pm.vbat": ("f", lambda: battery.volts),
        "pm.vbatMV": ("H", lambda: battery.volts * 1000.0),
        "pm.batteryLevel": ("B", lambda: min(100.0, max(0.0, (battery.volts - 3.0) / 1.2 * 100.0))),
        "pm.state": ("b", lambda: battery.state),
        "pm.chargeCurrent": ("f", lambda: 0.4 if battery.charges else 0.0),
        "supervisor.info": ("H", info),
        "sys.canfly": ("B", lambda: supervisor.can_fly),
        "sys.isFlying": ("B", lambda: supervisor.flying),
        "sys.isTumbled": ("B", lambda: body.tumbled),
        "sys.armed": ("B", lambda: supervisor.armed),
        "radio.rssi": ("B", lambda: 45),
        "radio.isConnected": ("B", lambda: 1),
        "lighthouse.status": ("B", lambda: 2),
        "acc.x": ("f", lambda: 0.0),
        "acc.y": ("f", lambda: 0.0),
        "acc.z": ("f", lambda: -1.0 if body.tumbled else 1.0),
        "gyro.z": ("f", lambda: 0.0),
        "baro.temp": ("f", lambda: 24.0),
        "baro.pressure": ("f", lambda: 1013.25 - 0.12 * body.position[2]),
        "baro.asl": ("f", lambda: body.position[2]),
        "bme.temp": ("f", partial(battery.read, "temperature")),
        "bme.humidity": ("f", lambda: 40.0),
        "range.front": ("H", lambda: _FAR * 1000.0),
        "range.back": ("H", lambda: _FAR * 1000.0),
        "range.left": ("H", lambda: _FAR * 1000.0),
        "range.right": ("H", lambda: _FAR * 1000.0),
        "range.up": ("H", lambda: _FAR * 1000.0),
        "range.zrange": ("H", lambda: min(_FAR, body.position[2]) * 1000.0),
        "sim.nothing": ("f", lambda: 0.0),
        "gripper.holds": ("B", holds),
    }


def quantities(world: World) -> dict[str, str]:
    """Return the log variables of what there is to measure in a world, by its names."""
    there = enumerate(quantities_in(world))
    return {quantity: f"sim.quantity{number}" for number, quantity in there}
