"""Parameters of a Crazyflie: read anew when asked, and read back after they were set."""

from __future__ import annotations

import asyncio
from contextlib import suppress
from math import isclose
from typing import TYPE_CHECKING

from ..drones.errors import LinkLost, Rejected
from . import words

if TYPE_CHECKING:
    from .borrowed import Cf, Element
    from .session import Session

_ALL, _ONE = 12.0, 3.0
"""Seconds until all parameters have been read after connecting, and until one is."""
_FLOATS = ("<f", "<d", "<e")
_EXACT = 1e-3
"""How far a number may be off that was kept as a short one."""


def element_of(cf: Cf, name: str) -> Element | None:
    """Return what the table of contents has of a parameter."""
    group, _, variable = name.partition(".")
    return cf.param.toc.toc.get(group, {}).get(variable)


async def complete(session: Session) -> bool:
    """Wait until all parameters have been read once; say whether that came to be."""
    with suppress(TimeoutError):
        async with asyncio.timeout(_ALL):
            await session.complete.wait()
    return session.complete.is_set()


def known(session: Session) -> dict[str, float]:
    """Return all values as they were last told: those of decks, for example, never change."""
    return {
        f"{group}.{name}": float(value)
        for group, values in list(session.cf.param.values.items())
        for name, value in list(values.items())
    }


async def read(session: Session, name: str) -> float:
    """Return what a parameter is now."""
    if element_of(session.cf, name) is None:
        raise Rejected(words.no_parameter(session.drone, name))
    group, _, variable = name.partition(".")
    told: asyncio.Queue[float] = asyncio.Queue()

    def hear(_: str, value: str) -> None:
        session.tell(told.put_nowait, float(value))

    def ask(cf: Cf) -> None:
        cf.param.add_update_callback(group, variable, hear)
        cf.param.request_param_update(name)

    await session.call(ask)
    try:
        async with asyncio.timeout(_ONE if session.complete.is_set() else _ALL):
            return await told.get()
    except TimeoutError:
        session.now()
        raise LinkLost(words.not_read(session.drone, name)) from None
    finally:
        if not session.lost:
            parameters = session.cf.param
            session.worker.post(lambda: parameters.remove_update_callback(group, variable, hear))


async def write(session: Session, name: str, value: float, *, stays: bool = True) -> None:
    """Set a parameter, and see that it is so; one that does not stay is a command in disguise."""
    element = element_of(session.cf, name)
    if element is None:
        raise Rejected(words.no_parameter(session.drone, name))
    if not await complete(session):  # cflib would wait for that itself, a minute long
        session.now()
        raise LinkLost(f"{session.drone}: {words.UNREAD}")
    whole = element.pytype not in _FLOATS
    if whole and not float(value).is_integer():
        raise Rejected(words.bad_value(session.drone, name, value, element.ctype))
    number = int(value) if whole else float(value)
    try:
        await session.call(lambda cf: cf.param.set_value(name, number))
    except LinkLost:
        raise
    except Exception as error:  # out of its range, or one that can only be read
        wrong = words.bad_value(session.drone, name, value, element.ctype)
        raise Rejected(f"{wrong} ({error})") from error
    has = await read(session, name)
    if stays and not isclose(has, value, rel_tol=_EXACT, abs_tol=_EXACT):
        raise Rejected(words.not_taken(session.drone, name, value, has))
