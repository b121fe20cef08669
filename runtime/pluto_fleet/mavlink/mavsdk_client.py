"""The process in which MAVSDK runs, as the gateway sees it: one for all vehicles, started when it is needed."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Callable, Mapping
from contextlib import suppress
from itertools import count
from typing import Any
from weakref import WeakKeyDictionary

from ..drones.protocol import LinkLost, Rejected
from ..process import respawn

Hear = Callable[[str, Any], object]
"""Called with what a vehicle tells: a word and its facts; `ended` with the reason is the last."""

_BEAT = 0.5
"""Seconds between two signs that this process lives."""
_LONGEST_LINE = 1 << 20
_ENDS = 3.0
"""The time-out of its end, in seconds."""
ENDED = "ended"
NO_ANSWER = "TIMEOUT"
"""What MAVSDK says where a vehicle did not answer a command, however often that was sent."""


class MavsdkClient:
    """The process and its vehicles; used within one event loop."""

    def __init__(self) -> None:
        self._numbers = count(1)
        self._asks = count(1)
        self._heard: dict[int, Hear] = {}
        self._answers: dict[int, asyncio.Future[Any]] = {}
        self._process: asyncio.subprocess.Process | None = None
        self._starting = asyncio.Lock()
        self._tasks: list[asyncio.Task[None]] = []

    def join(self, hear: Hear) -> int:
        """Return a number for one more vehicle."""
        number = next(self._numbers)
        self._heard[number] = hear
        return number

    async def leave(self, number: int) -> None:
        """Tell no more of a vehicle; the process ends with the last."""
        self._heard.pop(number, None)
        if self._heard:
            with suppress(LinkLost, Rejected):
                await self.ask("close", 1.0, vehicle=number)
        else:
            await self._end()

    async def ask(self, do: str, seconds: float, **facts: Any) -> Any:
        """Ask the process for something, and return its answer.

        Raises `Rejected` with what it says, and `LinkLost` if it says nothing in time.
        """
        process = await self._running()
        number = next(self._asks)
        answer = self._answers[number] = asyncio.get_running_loop().create_future()
        try:
            self._write(process, {"ask": number, "do": do, **facts})
            async with asyncio.timeout(seconds):
                return await answer
        except TimeoutError:
            raise LinkLost(f"no answer in {seconds:g} s") from None
        finally:
            self._answers.pop(number, None)

    async def _running(self) -> asyncio.subprocess.Process:
        async with self._starting:
            if self._process is None:
                self._process = await asyncio.create_subprocess_exec(
                    *respawn.library("mavsdk"),
                    stdin=asyncio.subprocess.PIPE,
                    stdout=asyncio.subprocess.PIPE,
                    limit=_LONGEST_LINE,
                    start_new_session=True,
                )
                self._tasks = [
                    asyncio.ensure_future(self._hear(self._process)),
                    asyncio.ensure_future(self._beat(self._process)),
                ]
            return self._process

    def _write(self, process: asyncio.subprocess.Process, message: Mapping[str, Any]) -> None:
        assert process.stdin is not None
        with suppress(OSError, RuntimeError):  # it has ended: `_hear` says so
            process.stdin.write(json.dumps(message).encode() + b"\n")

    async def _beat(self, process: asyncio.subprocess.Process) -> None:
        while True:
            self._write(process, {})
            await asyncio.sleep(_BEAT)

    async def _hear(self, process: asyncio.subprocess.Process) -> None:
        """Take what the process tells, until it ends; if that raises, all vehicles must know that they are not heard."""
        try:
            await self._take(process)
        finally:
            if self._process is process:
                self._gone()

    async def _take(self, process: asyncio.subprocess.Process) -> None:
        assert process.stdout is not None
        while line := await process.stdout.readline():
            message = json.loads(line)
            if "told" in message:
                hear = self._heard.get(message["vehicle"])
                if hear is not None:
                    hear(message["told"], message["facts"])
                continue
            answer = self._answers.get(message["answer"])
            if answer is None or answer.done():
                continue
            if "error" in message:
                answer.set_exception(Rejected(message["error"]))
            else:
                answer.set_result(message["value"])

    def _gone(self) -> None:
        """Fail what waits for the process; the next request starts another one."""
        self._process = None
        for task in self._tasks:
            if task is not asyncio.current_task():
                task.cancel()
        why = "the process of MAVSDK has ended"
        for answer in self._answers.values():
            if not answer.done():
                answer.set_exception(LinkLost(why))
        for hear in list(self._heard.values()):
            hear(ENDED, why)

    async def _end(self) -> None:
        process = self._process
        self._process = None
        if process is None:
            return
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        assert process.stdin is not None
        process.stdin.close()
        try:
            async with asyncio.timeout(_ENDS):
                await process.wait()
        except TimeoutError:
            process.kill()
            await process.wait()


_CLIENTS: WeakKeyDictionary[asyncio.AbstractEventLoop, MavsdkClient] = WeakKeyDictionary()


def client() -> MavsdkClient:
    """Return the client of this event loop."""
    loop = asyncio.get_running_loop()
    return _CLIENTS.setdefault(loop, MavsdkClient())
