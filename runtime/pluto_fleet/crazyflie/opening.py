"""How a link is opened: with a limit on every wait, and never twice for one object of cflib's."""

from __future__ import annotations

import asyncio
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from ..drones.errors import LinkLost
from . import logs, words
from .driver import LINK_CONTROL, PLATFORM, cache_folder, forget_dead_radios, load, packet
from .session import Observer, Session

if TYPE_CHECKING:
    from cflib.crazyflie import Crazyflie as Cf

_IMPORT, _OPEN = 20.0, 5.0
ANSWER, TELEMETRY = 5.0, 3.0
"""Seconds in which it must tell something more of itself, and begin to tell how it is."""
_AGAIN = 1.0
"""Seconds until something is asked again: were it answered twice, cflib would begin twice."""


async def open_session(drone: str, uri: str, folder: Path, observer: Observer) -> Session:
    """Return a connection on which the drone tells how it is; raise `LinkLost` if there is none."""
    session = Session(drone, uri, observer)
    try:
        await _open(session, folder)
    except BaseException:  # cancelled, too: nothing may be left of it
        session.release()
        raise
    return session


async def _open(session: Session, folder: Path) -> None:
    await session.worker.call(load, _IMPORT)
    await session.worker.call(lambda: _begin(session, folder), _OPEN)
    await _answer(session)
    # Its pings measure what nobody asks for, and the thread that sends them may die holding the lock
    # that every other sender needs.
    await session.call(lambda cf: cf.link_statistics.stop())
    await session.call(lambda _: logs.begin(session), _OPEN)
    if await session.until_told(TELEMETRY) is None:
        raise LinkLost(words.no_telemetry(session.drone))


def _begin(session: Session, folder: Path) -> None:
    """Open the link; called in the worker."""
    from cflib.crazyflie import Crazyflie

    forget_dead_radios()
    cf = Crazyflie(rw_cache=cache_folder(folder))
    session.listen(cf)
    cf.open_link(session.uri)


async def _answer(session: Session) -> None:
    """Wait until it has told its tables: for as long as there is more and more of them."""
    heard, at = 0, session.loop.time()
    while not session.established.is_set():
        entries = _entries(session.cf)
        if entries > heard:
            heard, at = entries, session.loop.time()
        if session.loop.time() - at > ANSWER:
            if session.answered:
                raise LinkLost(words.not_complete(session.drone, ANSWER))
            raise LinkLost(words.no_answer(session.drone, session.uri, ANSWER))
        with suppress(TimeoutError):
            async with asyncio.timeout(_AGAIN):
                await session.established.wait()
                break
        if session.uri.startswith("udp://"):  # radio packets are repeated by the dongle
            await session.call(lambda cf: _ask_again(session, cf))
    if session.lost:
        raise LinkLost(words.no_connection(session.drone, session.uri, session.lost))


def _entries(cf: Cf) -> int:
    """Return how much is known of its tables; read while a thread of cflib's fills them."""
    tables = (cf.log.toc, cf.param.toc)
    groups = [group for toc in tables if toc is not None for group in list(toc.toc.values())]
    return sum(map(len, groups))


def _ask_again(session: Session, cf: Cf) -> None:
    """Ask once more what cflib asks only once: who it is, and its protocol's version."""
    if cf.platform.get_protocol_version() < 0:
        port = PLATFORM if session.answered else LINK_CONTROL
        cf.send_packet(packet(port, 1, b"\0"))
