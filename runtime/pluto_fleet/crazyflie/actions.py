"""The actions of a Crazyflie, as configured in the fleet file, and how it identifies itself.

A picture comes from the streamer of an AI-deck, which sends its camera's pictures by TCP. Each packet has
its length, two bytes of routing, and a part of the data: first the header of a picture, then its bytes. Raw
pictures are stored as grey levels in a common format, others as the JPEG that they are.
"""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import count
from math import radians, tan
from pathlib import Path
from struct import Struct

from ..drones.equipment import no_gripper, no_source, quantity_of
from ..drones.protocol import ActionNotDone, PositionLost, Rejected
from ..shared.domain.actions import MEASURE, PHOTO, PICK, RELEASE, Plain
from ..shared.domain.model import Photo
from ..shared.domain.text import quoted
from . import logs, messages, parameters
from .options import CrazyflieOptions
from .session import CrazyflieSession, Worker

_PACKET = Struct("<HBB")
_WAY = 2
"""Bytes of routing, which the length includes."""
_HEAD = Struct("<BHHBBI")
_MAGIC = 0xBC
_RAW = 0
_LARGEST = 1 << 20
"""The largest picture in bytes, ten times that of its camera."""

LIMIT = 6.0
"""The time-out in seconds; it sends some pictures a second."""


class NoPicture(Exception):
    """The data received is not a picture."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Picture:
    """A picture in a file format."""

    data: bytes
    suffix: str


async def picture(where: tuple[str, int]) -> Picture:
    """Return the next complete picture; raise `OSError`, `TimeoutError` or `NoPicture`.

    Connects each time, as old pictures queue up on an open connection.
    """
    async with asyncio.timeout(LIMIT):
        reader, writer = await asyncio.open_connection(*where)
        try:
            return await _next(reader)
        except asyncio.IncompleteReadError:
            raise NoPicture("it ended within a picture") from None
        finally:
            writer.transport.abort()


async def _next(reader: asyncio.StreamReader) -> Picture:
    while True:
        head = await _part(reader)
        if len(head) != _HEAD.size or head[0] != _MAGIC:
            continue  # the middle of a picture, or another message of the deck
        _, width, height, depth, kind, size = _HEAD.unpack(head)
        if not 0 < size <= _LARGEST:
            raise NoPicture(f"a picture of {size} bytes was announced")
        data = bytearray()
        while len(data) < size:
            data += await _part(reader)
        if kind != _RAW:
            return Picture(data=bytes(data), suffix=".jpg")
        if len(data) != width * height * max(1, depth // 8):
            raise NoPicture(f"{len(data)} bytes are no picture of {width} by {height}")
        grey = f"P5 {width} {height} 255\n".encode()
        return Picture(data=grey + data, suffix=".pgm")


async def _part(reader: asyncio.StreamReader) -> bytes:
    length, _, _ = _PACKET.unpack(await reader.readexactly(_PACKET.size))
    return await reader.readexactly(max(0, length - _WAY))


_DOUBTS = 2.0
"""Seconds after which a drone that is still unsure of its position has lost it."""


def why_not(
    drone: str,
    options: CrazyflieOptions,
    session: CrazyflieSession | None,
    action: str,
    parameters_: Mapping[str, Plain],
) -> str | None:
    """Return why it cannot do an action, or None; its firmware's variables are known once it is connected."""
    cf = None if session is None or session.lost else session.cf
    if action == MEASURE:
        quantity = quantity_of(parameters_)
        name = options.variable_of(quantity)
        if name is None:
            return no_source(drone, options.measure, quantity, "log variable", "group.name")
        if cf is not None and not logs.has(cf, name):
            return messages.no_variable(drone, name)
        return None
    if action == PHOTO:
        if options.camera is not None:
            return None
        return (
            f"{drone} has no camera: name its AI-deck's streamer in the fleet file:"
            ' camera = "192.168.4.1:5000"'
        )
    if action in (PICK, RELEASE):
        if options.grip is None:
            such_as = '{ parameter = "gripper.closed", pick = 1, release = 0 }'
            return no_gripper(drone, "the parameter of its gripper", such_as)
        name = options.grip.parameter
        if cf is not None and parameters.element_of(cf, name) is None:
            return messages.no_parameter(drone, name)
        return None
    return f"{drone} is a Crazyflie, which cannot {action}"


async def act(
    session: CrazyflieSession,
    readings: logs.LogReader,
    options: CrazyflieOptions,
    folder: Path,
    action: str,
    parameters_: Mapping[str, Plain],
) -> object:
    """Do an action, and return its result; raise `ActionNotDone` if it failed."""
    reason = why_not(session.drone, options, session, action, parameters_)
    if reason is not None:
        raise ActionNotDone(reason)
    await _check_place(session)
    try:
        if action == MEASURE:
            name = options.variable_of(quantity_of(parameters_))
            assert name is not None  # else there is a reason why not
            value = await readings.mean(name, options.measure_seconds)
            await _check_place(session)
            return value
        if action == PHOTO and options.camera is not None:
            return await _photo(session, options.camera, options, folder)
        if options.grip is not None:
            value = options.grip.pick if action == PICK else options.grip.release
            await parameters.write(session, options.grip.parameter, value)
            await asyncio.sleep(options.grip.seconds)
    except Rejected as error:  # the drone is healthy, and has refused
        raise ActionNotDone(str(error)) from error
    return None


async def _check_place(session: CrazyflieSession) -> None:
    """Raise `PositionLost` if an action would be done, or was done, at an unknown place.

    A drone that is unsure for a moment only is waited for.
    """
    await session.until(lambda _: session.adrift or not session.doubts, _DOUBTS)
    variance = session.confidence.variance
    if session.doubts and variance is not None:
        raise PositionLost(messages.lost_its_place(session.drone, variance))


def ground(options: CrazyflieOptions, height: float) -> tuple[float, float]:
    """Return how many metres of ground its camera sees from a height: across and along."""
    across, along = (
        round(2.0 * height * tan(radians(angle) / 2.0), 3) for angle in options.camera_view
    )
    return across, along


async def _photo(
    session: CrazyflieSession, camera: tuple[str, int], options: CrazyflieOptions, folder: Path
) -> Photo:
    """Take a picture straight down and store it as a file."""
    before = session.now().position
    try:
        taken = await picture(camera)
    except (OSError, TimeoutError, NoPicture) as error:
        why = str(error) or "nothing came in time"
        where = f"{camera[0]}:{camera[1]}"
        raise ActionNotDone(f"{session.drone} gives no photo at {where}: {why}") from error
    await _check_place(session)
    after = session.now().position
    x, y, z = (round((a + b) / 2, 3) for a, b in zip(before, after, strict=True))
    across, along = ground(options, z)
    file = await _kept(session.worker, folder, session.drone, taken)
    return Photo(position=(x, y, z), width=across, height=along, file=str(file))


async def _kept(worker: Worker, folder: Path, drone: str, taken: Picture) -> Path:
    """Write a picture into a new file; never over another one."""

    def write() -> Path:
        for number in count(1):
            file = folder / f"{drone}-{number:04}{taken.suffix}"
            try:
                with file.open("xb") as opened:
                    opened.write(taken.data)
            except FileExistsError:
                continue
            return file
        raise AssertionError  # unreachable: the numbers are endless

    try:
        return await worker.call(write, 5.0)
    except OSError as error:
        raise ActionNotDone(
            f"the photo of {drone} could not be kept in {quoted(str(folder))}: {error}"
        ) from error


_LIGHTS = "led.bitmask"
_OURS, _ALL = 0x80, 0x3F
"""The bit that takes the LEDs over from the firmware, and the mask of all LEDs."""
_TIMES, _SECONDS = 8, 0.25


async def blink(session: CrazyflieSession) -> None:
    """Blink for four seconds, or beep once if its firmware does not release the LEDs."""
    if parameters.element_of(session.cf, _LIGHTS) is None:
        await session.call(lambda cf: cf.platform.send_user_notification(True))
        return
    before = await parameters.read(session, _LIGHTS)
    try:
        for _ in range(_TIMES):
            for value in (_OURS | _ALL, _OURS):
                await parameters.write(session, _LIGHTS, value)
                await asyncio.sleep(_SECONDS)
    finally:
        await asyncio.shield(parameters.write(session, _LIGHTS, before))
