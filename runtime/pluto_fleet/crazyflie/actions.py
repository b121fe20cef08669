"""What a Crazyflie can do at the end of a trip, as the fleet file says how; nothing is pretended."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from itertools import count
from math import radians, tan
from pathlib import Path
from typing import TYPE_CHECKING

from plutoc_runtime.domain.actions import PICK, RELEASE
from plutoc_runtime.domain.model import Photo

from ..drones.errors import ActionNotDone, PositionLost, Rejected
from . import logs, parameters, words
from .camera import NoPicture, Picture, picture

if TYPE_CHECKING:
    from plutoc_runtime.domain.actions import Plain

    from .options import Options
    from .session import Session
    from .worker import Worker

MEASURE, PHOTO = "measure", "take_photo"
_DOUBTS = 2.0
"""Seconds after which one that still doubts where it is has lost its place, as far as it tells."""


def why_not(
    drone: str,
    options: Options,
    session: Session | None,
    action: str,
    parameters_: Mapping[str, Plain],
) -> str | None:
    """Return why it cannot do an action, or None; what its firmware has is known once it connects."""
    cf = None if session is None or session.lost else session.cf
    if action == MEASURE:
        quantity = _quantity(parameters_)
        name = options.variable_of(quantity)
        if name is None:
            return words.no_quantity(drone, quantity, tuple(options.measure))
        if cf is not None and not logs.has(cf, name):
            return words.no_variable(drone, name)
        return None
    if action == PHOTO:
        return words.no_camera(drone) if options.camera is None else None
    if action in (PICK, RELEASE):
        if options.grip is None:
            return words.no_grip(drone)
        name = options.grip.parameter
        if cf is not None and parameters.element_of(cf, name) is None:
            return words.no_parameter(drone, name)
        return None
    return words.no_action(drone, action)


async def act(
    session: Session,
    readings: logs.Readings,
    options: Options,
    folder: Path,
    action: str,
    parameters_: Mapping[str, Plain],
) -> object:
    """Do an action, and return what came of it; raise `ActionNotDone` if it was not done."""
    reason = why_not(session.drone, options, session, action, parameters_)
    if reason is not None:
        raise ActionNotDone(reason)
    await _check_place(session)
    try:
        if action == MEASURE:
            name = options.variable_of(_quantity(parameters_))
            assert name is not None  # or there is a reason why not
            value = await readings.mean(name, options.measure_seconds)
            await _check_place(session)
            return value
        if action == PHOTO and options.camera is not None:
            return await _photo(session, options.camera, options.camera_view, folder)
        if options.grip is not None:
            value = options.grip.pick if action == PICK else options.grip.release
            await parameters.write(session, options.grip.parameter, value)
            await asyncio.sleep(options.grip.seconds)
    except Rejected as error:  # the drone is well, and has not done it
        raise ActionNotDone(str(error)) from error
    return None


async def _check_place(session: Session) -> None:
    """Raise `PositionLost` for what would be done, or was measured, nobody knows where.

    Who doubts it for a moment has not lost it, and is waited for.
    """
    await session.until(lambda _: session.adrift or not session.doubts, _DOUBTS)
    variance = session.certainty.variance
    if session.doubts and variance is not None:
        raise PositionLost(words.lost_its_place(session.drone, variance))


def _quantity(parameters_: Mapping[str, Plain]) -> str:
    return str(parameters_.get("quantity", "temperature"))


async def _photo(
    session: Session, camera: tuple[str, int], view: tuple[float, float], folder: Path
) -> Photo:
    """Take a picture straight down and keep it as a file."""
    before = session.now().position
    try:
        taken = await picture(camera)
    except (OSError, TimeoutError, NoPicture) as error:
        why = str(error) or "nothing came in time"
        where = f"{camera[0]}:{camera[1]}"
        raise ActionNotDone(words.no_photo(session.drone, where, why)) from error
    await _check_place(session)
    after = session.now().position
    x, y, z = (round((a + b) / 2, 3) for a, b in zip(before, after, strict=True))
    across, along = (2.0 * z * tan(radians(angle) / 2.0) for angle in view)
    file = await _kept(session.worker, folder, session.drone, taken)
    return Photo(position=(x, y, z), width=round(across, 3), height=round(along, 3), file=str(file))


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
        raise AssertionError  # there is always another number

    try:
        return await worker.call(write, 5.0)
    except OSError as error:
        raise ActionNotDone(words.not_kept(drone, str(folder), str(error))) from error
