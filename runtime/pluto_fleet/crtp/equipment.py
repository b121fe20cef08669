"""The equipment of simulated Crazyflies: an AI-deck's camera, sensors and a gripper."""

from __future__ import annotations

import asyncio
import struct
from collections.abc import Mapping
from contextlib import suppress
from math import atan, degrees

from ..shared.alone.world import HEIGHT as ALONG
from ..shared.alone.world import WIDTH as ACROSS
from ..shared.alone.world import World
from ..shared.domain.actions import BUILT_IN, PHOTO, PICK
from .drone import Build, SimulatedCrazyflie
from .flight_log import FlightLog
from .logs import quantities
from .params import parameters
from .server import HOST

WIDTH, HEIGHT = 324, 244
_MAGIC, _RAW = 0xBC, 0
_CHUNK = 1000
_PAUSE = 0.1
"""Seconds between two pictures."""
_FIRST = BUILT_IN[PHOTO].seconds
"""Seconds until a client gets its first picture."""
_ROUTE, _FUNCTION = 0x0C, 0x05


def picture(number: int) -> bytes:
    """Return a picture: a grey gradient that differs from one to the next."""
    row = bytes((column + number) % 256 for column in range(WIDTH))
    return row * HEIGHT


def frames(number: int) -> bytes:
    """Return a picture's packets: a header, then pieces, each preceded by its length."""
    pixels = picture(number)
    head = struct.pack("<BHHBBI", _MAGIC, WIDTH, HEIGHT, 1, _RAW, len(pixels))
    pieces = [head, *(pixels[at : at + _CHUNK] for at in range(0, len(pixels), _CHUNK))]
    return b"".join(
        struct.pack("<HBB", len(piece) + 2, _ROUTE, _FUNCTION) + piece for piece in pieces
    )


async def camera(port: int = 0) -> asyncio.Server:
    """Stream pictures to every client; close what is returned to end it."""
    return await asyncio.start_server(_stream, HOST, port)


async def _stream(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    number = 0
    await asyncio.sleep(_FIRST)
    with suppress(OSError):
        while not reader.at_eof():
            writer.write(frames(number))
            await writer.drain()
            number += 1
            with suppress(TimeoutError):
                async with asyncio.timeout(_PAUSE):
                    await reader.read(1)
    writer.close()
    with suppress(OSError):
        await writer.wait_closed()


def port_of(server: asyncio.Server) -> int:
    return int(server.sockets[0].getsockname()[1])


_VIEW = [2 * degrees(atan(share / 2)) for share in (ACROSS, ALONG)]
"""The angles of a camera that sees what those of other simulated drones see."""

_SENSORS = {"temperature": "bme.temp", "humidity": "bme.humidity", "pressure": "baro.pressure"}
_NOTHING = "sim.nothing"
"""The log variable for what there is not in its world."""
_GRIP = {"parameter": "gripper.closed", "pick": 1, "release": 0, "seconds": BUILT_IN[PICK].seconds}


def fitted(given: Mapping[str, object], camera: str, world: World) -> dict[str, object]:
    """Return the options of a simulated drone in a world, whose camera streams there.

    They are those of the fleet file, which is known to be right; where that names a part of a real
    drone that a simulated one lacks, it has one of its own instead.
    """
    return {
        "camera_view": _VIEW,
        **given,
        "camera": camera,
        "cells": 1,
        "decks": [],
        "grip": _grip(given.get("grip")),
        "measure": _sensors(given.get("measure"), world),
    }


def settable(given: Mapping[str, float]) -> dict[str, float]:
    """Return the parameters of a file that a simulated drone has, too."""
    there = {one.name for one in parameters() if not one.read_only}
    return {name: value for name, value in given.items() if name in there}


def _grip(given: object) -> Mapping[str, object]:
    if not isinstance(given, Mapping):
        return _GRIP
    if any(one.name == given["parameter"] for one in parameters()):
        return given
    return {**_GRIP, "seconds": given.get("seconds", _GRIP["seconds"])}


def _sensors(given: object, world: World) -> Mapping[str, str]:
    """Return the log variables of all quantities: of a file those that exist."""
    there = SimulatedCrazyflie(_SAMPLE, FlightLog(), lambda _: None).variables
    named = given if isinstance(given, Mapping) else {}
    return {
        **quantities(world),
        **_SENSORS,
        **{quantity: name for quantity, name in named.items() if name in there},
        "*": _NOTHING,
    }


_SAMPLE = Build(id="any", home=(0.0, 0.0, 0.0))
