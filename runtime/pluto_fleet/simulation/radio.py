"""A simulated radio with delays: commands arrive later, and so do their results."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

from ..jobs.controls import ForwardingControls
from ..shared.domain.errors import Failure, FlightFailed
from ..shared.time.future import Future
from ..shared.time.kernel import FLEET, EventKind, Kernel

if TYPE_CHECKING:
    from ..jobs.controls import Controls
    from ..jobs.reports import DroneReport
    from ..shared.domain.actions import Plain
    from ..shared.domain.model import Item, Point

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
        self.late = 0
        """The number of delayed messages."""

    def _late(self, what: str) -> float:
        seconds = self._delay(what)
        self.late += seconds > 0
        return seconds

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, or a command in transit."""
        order = self._orders.pop(drone, None)
        self._controls.break_off(drone)
        if order is not None:
            why = f"{drone} was told to break it off"
            order.fail(FlightFailed(Failure.REFUSED, why))

    async def hold(self, drone: str) -> None:
        """Hover, for as long as an action of the app's own takes."""
        await self._sent(drone, partial(self._controls.hold, drone))

    async def takeoff(self, drone: str, height: float) -> None:
        """Take off to a height."""
        await self._sent(drone, partial(self._controls.takeoff, drone, height))

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        await self._sent(drone, partial(self._controls.go_to, drone, target))

    async def land(self, drone: str) -> None:
        """Land here."""
        await self._sent(drone, partial(self._controls.land, drone))

    async def act(
        self,
        drone: str,
        action: str,
        parameters: Mapping[str, Plain],
        item: Item | None,
        job: str | None,
    ) -> object:
        """Do a built-in action here, and return its result."""
        act = self._controls.act
        return await self._sent(drone, partial(act, drone, action, parameters, item, job))

    async def read(self, drone: str, name: str) -> float:
        """Return a sensor or variable of a drone."""
        return await self._asked(self._controls.read(drone, name))

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set a parameter of a drone."""
        await self._asked(self._controls.write(drone, name, value))

    async def cut(self, drone: str) -> None:
        """Switch its motors off."""
        await self._controls.cut(drone)

    async def reach(self, drone: str) -> bool:
        """Wait, after a failed flight, until a drone takes commands again."""
        return await self._sent(drone, partial(self._controls.reach, drone))

    async def drone_report(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done, be it busy or not."""
        return await self._asked(self._controls.drone_report(drone))

    async def _asked(self, question: Coroutine[Any, Any, T]) -> T:
        """Query a drone, concurrently with its command."""
        try:
            await self._kernel.sleep(self._late(COMMAND), EventKind.FLIGHT)
            answer = await question
        finally:
            question.close()
        await self._kernel.sleep(self._late(ANSWER), EventKind.FLIGHT)
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
        seconds = self._late(what)
        if seconds > 0:
            until = self._kernel.now + seconds
            await self._kernel.within(broken_off, until, EventKind.FLIGHT, FLEET)
        if broken_off.is_set:
            broken_off.result()
