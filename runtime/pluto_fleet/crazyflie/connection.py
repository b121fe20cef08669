"""From a URI to a session: scanning, opening a link, and sending a drone its position.

Every wait has a time-out, and no object of cflib is opened twice.
"""

from __future__ import annotations

import asyncio
import socket
from collections.abc import Iterator
from contextlib import suppress
from math import hypot
from pathlib import Path
from typing import Any

from ..drones.protocol import LinkLost
from ..files.addresses import CHANNELS, USUAL, radio_bytes
from ..shared.domain.model import Point
from ..shared.domain.text import number
from . import logs, messages, parameters
from .driver import (
    LINK_CONTROL,
    PLATFORM,
    bear_silence,
    cache_folder,
    forget_dead_radios,
    load,
    packet,
)
from .options import CrazyflieOptions
from .session import CrazyflieSession, SessionObserver, Worker

_IMPORT, _OPEN = 20.0, 5.0
ANSWER, TELEMETRY = 5.0, 3.0
"""Time-outs in seconds: of further tables, and of the first telemetry."""
_ASK_AGAIN = 1.0
"""Seconds until a request is repeated; not earlier, as two answers would make cflib begin twice."""


async def open_session(
    drone: str, uri: str, folder: Path, observer: SessionObserver, silence: float
) -> CrazyflieSession:
    """Return a session with running telemetry; raise `LinkLost` if that fails."""
    session = CrazyflieSession(drone, uri, observer, silence)
    try:
        await _open(session, folder)
    except BaseException:  # also if cancelled: nothing may be left open
        session.release()
        raise
    return session


async def _open(session: CrazyflieSession, folder: Path) -> None:
    await session.worker.call(load, _IMPORT)
    await session.worker.call(lambda: _begin(session, folder), _OPEN)
    await _answer(session)
    # Its pings are not used here, and the thread that sends them may die holding the lock
    # that every other sender needs.
    await session.call(lambda cf: cf.link_statistics.stop())
    await session.call(lambda _: logs.begin(session), _OPEN)
    if await session.until_told(TELEMETRY) is None:
        raise LinkLost(f"{session.drone} answers, but does not tell where it is")


def _begin(session: CrazyflieSession, folder: Path) -> None:
    """Open the link; called in the worker."""
    from cflib.crazyflie import Crazyflie

    forget_dead_radios()
    bear_silence(session.silence)
    cf = Crazyflie(rw_cache=cache_folder(folder))
    session.listen(cf)
    cf.open_link(session.uri)


async def _answer(session: CrazyflieSession) -> None:
    """Wait until its tables are complete, as long as there is progress."""
    heard, at = 0, session.loop.time()
    while not session.established.is_set():
        entries = _entries(session)
        if entries > heard:
            heard, at = entries, session.loop.time()
        if session.loop.time() - at > ANSWER:
            if session.answered:
                raise LinkLost(
                    f"{session.drone} answered, and then told nothing more of itself in"
                    f" {number(ANSWER)} s"
                )
            raise LinkLost(
                f"{session.drone} does not answer at {session.uri}: nothing came in"
                f" {number(ANSWER)} s; is it on?"
            )
        with suppress(TimeoutError):
            async with asyncio.timeout(_ASK_AGAIN):
                await session.established.wait()
                break
        if session.uri.startswith("udp://"):  # over the radio, the dongle repeats packets
            await session.call(lambda _: _ask_again(session))
    if session.lost:
        raise LinkLost(f"{session.drone} cannot be reached at {session.uri}: {session.lost}")


def _entries(session: CrazyflieSession) -> int:
    """Return the number of known table entries, while a thread of cflib fills them."""
    tables = (session.cf.log.toc, session.cf.param.toc)
    groups = [group for toc in tables if toc is not None for group in list(toc.toc.values())]
    return sum(map(len, groups))


def _ask_again(session: CrazyflieSession) -> None:
    """Repeat the requests that cflib sends only once: the platform and the protocol's version."""
    cf = session.cf
    if cf.platform.get_protocol_version() < 0:
        port = PLATFORM if session.answered else LINK_CONTROL
        cf.send_packet(packet(port, 1, b"\0"))


_HERE = "kalman.initial"
_RESET = "kalman.resetEstimation"
_ESTIMATOR, _KALMAN = "stabilizer.estimator", 2.0
_ORIGIN = 0.2
"""Metres from its own origin within which it has just been started."""


async def set_initial_position(session: CrazyflieSession, home: Point) -> None:
    """Set its position to its home; not if it has flown already."""
    state = session.now()
    if state.flies or hypot(state.position[0], state.position[1]) > _ORIGIN:
        return
    for axis, value in zip("XYZ", home, strict=True):
        await parameters.write(session, f"{_HERE}{axis}", value)
    await parameters.write(session, _RESET, 1.0, stays=False)
    await parameters.write(session, _RESET, 0.0)
    session.confidence.forget()


async def send_external_position(session: CrazyflieSession, position: Point) -> None:
    """Send it its position as measured from outside; only its Kalman estimator uses that."""
    if not session.located:
        session.located = True
        if parameters.element_of(session.cf, _ESTIMATOR) is not None and not session.now().flies:
            await parameters.write(session, _ESTIMATOR, _KALMAN)
    x, y, z = position
    await session.call(lambda cf: cf.extpos.send_extpos(x, y, z))


_RATES = ((2, "2M"), (1, "1M"), (0, "250K"))
"""The data rates by the dongle's number and in URIs; most drones use the first."""
_PROBE = 0xFF
_LIMIT = 60.0
_ANSWER = 0.2


async def scan(options: CrazyflieOptions) -> list[str]:
    """Return the URIs of all drones that answer; raise `LinkLost` if there is no radio."""
    worker = Worker("scan")
    try:
        return await worker.call(lambda: _look(options), _LIMIT)
    finally:
        worker.end()


def _look(options: CrazyflieOptions) -> list[str]:
    found = [uri for uri in options.udp if _answers(uri)]
    if not options.addresses:
        return found
    load()
    from cflib.drivers.crazyradio import get_serials

    dongles = 1
    with suppress(Exception):  # to open the first says what is wrong
        dongles = max(dongles, len(get_serials()))
    there = set[str]()
    refused = list[LinkLost]()
    for dongle in range(dongles):
        try:
            radio = _radio(dongle)
        except LinkLost as error:  # another program may have it
            refused.append(error)
            continue
        try:
            for address in options.addresses:
                heard = [one for one in _on_the_air(radio, address) if one not in there]
                there.update(heard)
                found += [f"radio://{dongle}/{one}" for one in heard]
        finally:
            radio.close()
    if len(refused) == dongles:
        raise refused[0]
    return found


def _radio(dongle: int) -> Any:
    from cflib.crtp.radiodriver import RadioManager

    try:
        return RadioManager.open(dongle)
    except Exception as error:  # cflib raises just that
        raise LinkLost(f"the radio finds no drone: {messages.cause(str(error))}") from error


def _on_the_air(radio: Any, address: str) -> Iterator[str]:
    """Yield what answers at a radio address: the end of its URI, behind the dongle."""
    radio.set_address(tuple(radio_bytes(address)))
    radio.set_arc(1)
    for code, rate in _RATES:
        radio.set_data_rate(code)
        for channel in radio.scan_channels(0, CHANNELS - 1, (_PROBE,)):
            yield f"{channel}/{rate}" if address == USUAL else f"{channel}/{rate}/{address}"


def _answers(uri: str) -> bool:
    """Return whether a probe by UDP is answered."""
    host, _, port = uri.removeprefix("udp://").rpartition(":")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asking:
        asking.settimeout(_ANSWER)
        try:
            asking.connect((host, int(port)))
            asking.send(bytes((_PROBE,)))
            return bool(asking.recv(64))
        except (OSError, ValueError):
            return False
