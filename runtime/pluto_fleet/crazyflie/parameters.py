"""Parameters of a Crazyflie: always read from the drone, and read back after they were set."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from contextlib import suppress
from math import isclose, isfinite
from typing import TYPE_CHECKING

from ..drones.protocol import LinkLost, Rejected
from ..shared.domain.text import number, quoted
from . import messages
from .session import CrazyflieSession

if TYPE_CHECKING:
    from cflib.crazyflie import Crazyflie as Cf
    from cflib.crazyflie.param import ParamTocElement as Element

_ALL, _ONE = 12.0, 3.0
"""Time-outs in seconds: of reading all parameters after connecting, and of reading one."""
_FLOATS = ("<f", "<d", "<e")
_EXACT = 1e-3
"""The tolerance of a number that is stored in single precision."""


def element_of(cf: Cf, name: str) -> Element | None:
    """Return a parameter's entry of the table of contents."""
    group, _, variable = name.partition(".")
    return cf.param.toc.toc.get(group, {}).get(variable)


async def complete(session: CrazyflieSession, limit: float = _ALL) -> bool:
    """Wait until all parameters have been read once, or the link is lost; return whether they were."""
    with suppress(LinkLost):
        await session.until(lambda _: session.complete.is_set(), limit, well=False)
    return session.complete.is_set()


def known(session: CrazyflieSession) -> dict[str, float]:
    """Return all values as last read: those of decks, for example, never change."""
    return {
        f"{group}.{name}": float(value)
        for group, values in list(session.cf.param.values.items())
        for name, value in list(values.items())
    }


async def read(session: CrazyflieSession, name: str) -> float:
    _element(session, name)
    return await _asked(session, name, lambda cf: cf.param.request_param_update(name))


async def write(session: CrazyflieSession, name: str, value: float, *, stays: bool = True) -> None:
    """Set a parameter, and verify it; one that resets itself is really a command."""
    element = _element(session, name)
    whole = element.pytype not in _FLOATS
    if not isfinite(value) or (whole and not float(value).is_integer()):
        raise Rejected(messages.bad_value(session.drone, name, value, element.ctype))
    sent = int(value) if whole else float(value)

    def send(cf: Cf) -> None:
        try:
            cf.param.set_value(name, sent)
        except Exception as error:  # out of its range, or read-only
            wrong = messages.bad_value(session.drone, name, value, element.ctype)
            raise Rejected(f"{wrong} ({error})") from error

    # The first answer only echoes what was sent, so the value is read again.
    has = await _asked(session, name, send, lambda cf: cf.param.request_param_update(name))
    if stays and not isclose(has, value, rel_tol=_EXACT, abs_tol=_EXACT):
        raise Rejected(
            f"{session.drone}: {quoted(name)} was set to {number(value)}, and is {number(has)}"
        )


def _element(session: CrazyflieSession, name: str) -> Element:
    element = element_of(session.cf, name)
    if element is None:
        groups = list(session.cf.param.toc.toc.items())
        known = [f"{group}.{one}" for group, names in groups for one in list(names)]
        raise Rejected(messages.no_parameter(session.drone, name, known))
    return element


async def _asked(session: CrazyflieSession, name: str, *questions: Callable[[Cf], None]) -> float:
    """Send requests one after the other, each when the one before is answered; return the last answer.

    One exchange at a time, as an answer does not identify its request.
    """
    if not await complete(session):  # until then, answers may belong to cflib's requests
        session.now()
        raise LinkLost(f"{session.drone}: {messages.UNREAD}")
    group, _, variable = name.partition(".")
    told: asyncio.Queue[float] = asyncio.Queue()

    def hear(_: str, value: str) -> None:
        session.tell(told.put_nowait, float(value))

    async with session.asking:
        await session.call(lambda cf: cf.param.add_update_callback(group, variable, hear))
        try:
            for question in questions:
                await session.call(question)
                async with asyncio.timeout(_ONE):
                    answer = await told.get()
        except TimeoutError:
            session.now()
            raise LinkLost(messages.not_read(session.drone, name)) from None
        finally:
            if not session.lost:
                known = session.cf.param
                session.worker.post(lambda: known.remove_update_callback(group, variable, hear))
    return answer
