"""The log blocks of a Crazyflie: its regular telemetry, and single variables on request.

A block holds 26 bytes, a drone 16 blocks. cflib's object for a block is valid for one connection.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping
from statistics import fmean
from typing import TYPE_CHECKING

from ..drones.protocol import Rejected
from . import messages
from .session import CrazyflieSession
from .state import STATE, VARIANCES, state_of

if TYPE_CHECKING:
    from cflib.crazyflie import Crazyflie as Cf
    from cflib.crazyflie.log import LogConfig

_STATE_MS, _VARIANCE_MS, _ONE_MS = 100, 250, 100


def begin(session: CrazyflieSession) -> None:
    """Start its telemetry; called in the worker, once the tables are known."""
    cf = session.cf

    def state(sent: int, values: Mapping[str, float], _: object) -> None:
        session.tell(session.hear, state_of(values, session.loop.time(), sent / 1000.0))

    def variances(_: int, values: Mapping[str, float], __: object) -> None:
        told = tuple(values[name] for name in VARIANCES if name in values)
        session.tell(session.hear_variances, told, session.loop.time())

    wanted = (("state", STATE, _STATE_MS, state), ("variances", VARIANCES, _VARIANCE_MS, variances))
    for name, variables, period, hear in wanted:
        there = [variable for variable in variables if has(cf, variable)]
        session.lacks += tuple(variable for variable in variables if variable not in there)
        if there:
            _block(cf, name, there, period, hear).start()


def has(cf: Cf, name: str) -> bool:
    group, _, variable = name.partition(".")
    toc = cf.log.toc
    return toc is not None and variable in toc.toc.get(group, {})


def _block(
    cf: Cf,
    name: str,
    variables: list[str],
    period: int,
    hear: Callable[[int, Mapping[str, float], object], None],
) -> LogConfig:
    from cflib.crazyflie.log import LogConfig

    block = LogConfig(name, period)
    for variable in variables:
        block.add_variable(variable)
    block.data_received_cb.add_callback(hear)
    cf.log.add_config(block)
    return block


class LogReader:
    """Reads single log variables: each has a block while it is read."""

    def __init__(self, session: CrazyflieSession) -> None:
        self._session = session
        self._blocks: dict[str, LogConfig] = {}
        self._hearing: dict[str, Callable[[float], None]] = {}
        self._turn = asyncio.Lock()

    async def mean(self, name: str, seconds: float) -> float:
        """Return a variable's mean over some time; 0: its next value."""
        session = self._session
        if not has(session.cf, name):
            raise Rejected(messages.no_variable(session.drone, name))
        values: list[float] = []
        enough = asyncio.Event()
        began = session.loop.time()

        def hear(value: float) -> None:
            values.append(value)
            if session.loop.time() - began >= seconds:
                enough.set()

        async with self._turn:
            began = session.loop.time()
            self._hearing[name] = hear
            try:
                await self._given_back(name)
                await session.call(lambda cf: self._start(cf, name))
                async with asyncio.timeout(seconds + 3.0):
                    await enough.wait()
            except TimeoutError:
                session.now()  # raises if it is silent altogether
                if not values:
                    raise Rejected(messages.not_read(session.drone, name)) from None
            finally:
                del self._hearing[name]
                self._stop(name)
        return float(fmean(values))

    def _start(self, cf: Cf, name: str) -> None:
        block = self._blocks.get(name)
        if block is None:

            def hear(_: int, values: Mapping[str, float], __: object) -> None:
                self._session.tell(self._heard, name, float(values[name]))

            block = _block(cf, name, [name], _ONE_MS, hear)
            self._blocks[name] = block
        block.start()

    def _heard(self, name: str, value: float) -> None:
        hear = self._hearing.get(name)
        if hear is not None:
            hear(value)

    async def _given_back(self, name: str) -> None:
        """Wait until the drone has deleted the block of the last reading."""
        block = self._blocks.get(name)
        for _ in range(50):
            if block is None or not block.added:
                return
            await asyncio.sleep(0.02)

    def _stop(self, name: str) -> None:
        """Delete the block eventually."""
        block = self._blocks.get(name)
        if block is not None:
            self._session.worker.post(block.delete)
