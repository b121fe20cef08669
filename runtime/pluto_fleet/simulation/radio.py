"""A simulated radio with delays: commands arrive later, and so do their results."""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from functools import partial
from typing import Any, TypeVar

from ..jobs.controls import (
    Command,
    Controls,
    Cut,
    ForwardingControls,
    Read,
    See,
    Trigger,
    Write,
)
from ..jobs.reports import DroneReport
from ..shared.domain.errors import Failure, FlightFailed
from ..shared.time.kernel import FLEET, EventKind, Future, Kernel

T = TypeVar("T")

COMMAND, ANSWER = "command", "answer"


class Radio(ForwardingControls):
    """Controls with delayed commands and answers.

    `delay` returns the seconds of a delay, for `command` or `answer`. A command that is aborted in
    transit does not arrive.
    """

    def __init__(self, kernel: Kernel, controls: Controls, delay: Callable[[str], float]) -> None:
        super().__init__(controls)
        self._kernel, self._delay = kernel, delay
        self._orders: dict[str, Future[None]] = {}
        """A future for each drone's command, which fails if the command is aborted."""
        self.break_off = self._break_off
        self.reach = self._reach
        self.drone_report = self._drone_report

    def _break_off(self, drone: str) -> None:
        """Stop what a drone does, or a command in transit."""
        order = self._orders.pop(drone, None)
        self._controls.break_off(drone)
        if order is not None:
            why = f"{drone} was told to break it off"
            order.fail(FlightFailed(Failure.REFUSED, why))

    async def do(self, drone: str, command: Command) -> Any:
        done = partial(self._controls.do, drone, command)
        match command:
            case Cut():
                return await done()
            case Read() | Write() | See() | Trigger():
                return await self._asked(done())
            case _:
                return await self._sent(drone, done)

    async def _reach(self, drone: str) -> bool:
        return await self._sent(drone, partial(self._controls.reach, drone))

    async def _drone_report(self, drone: str) -> DroneReport:
        return await self._asked(self._controls.drone_report(drone))

    async def _asked(self, question: Coroutine[Any, Any, T]) -> T:
        """Query a drone, concurrently with its command."""
        try:
            await self._kernel.sleep(self._delay(COMMAND), EventKind.FLIGHT)
            answer = await question
        finally:
            question.close()
        await self._kernel.sleep(self._delay(ANSWER), EventKind.FLIGHT)
        return answer

    async def _sent(self, drone: str, command: Callable[[], Coroutine[Any, Any, T]]) -> T:
        self._orders[drone] = broken_off = Future[None]()
        try:
            await self._on_its_way(COMMAND, broken_off)
            result = await command()
            await self._on_its_way(ANSWER, broken_off)
        finally:
            if self._orders.get(drone) is broken_off:
                del self._orders[drone]
        return result

    async def _on_its_way(self, what: str, broken_off: Future[None]) -> None:
        seconds = self._delay(what)
        if seconds > 0:
            until = self._kernel.now + seconds
            await self._kernel.within(broken_off, until, EventKind.FLIGHT, FLEET)
        if broken_off.is_set:
            broken_off.result()
