"""A radio on which everything takes a moment: commands arrive later, and so does what they gave."""

from __future__ import annotations

from collections.abc import Callable, Coroutine
from functools import partial
from typing import TYPE_CHECKING, Any, TypeVar

from ..errors import Failure, FlightFailed
from ..kernel import FLEET, Kernel, Kind, Timer
from ..signals import Signal

if TYPE_CHECKING:
    from ..model import Point, Telemetry
    from ..navigation import Job, Navigation
    from ..standing import Standing

T = TypeVar("T")

COMMAND, ANSWER = "command", "answer"


class Radio:
    """A navigation whose commands and answers are on their way for a while.

    `delay` says how many seconds each is: it is asked with `command` or `answer`. What is broken
    off while it is on its way does not arrive.
    """

    def __init__(
        self, kernel: Kernel, navigation: Navigation, delay: Callable[[str], float]
    ) -> None:
        self._kernel, self._navigation, self._delay = kernel, navigation, delay
        self._jobs: dict[str, Timer] = {}
        self._orders: dict[str, Signal[None]] = {}
        """What drones were told to do for themselves: a signal each, that fails if it is broken off."""
        self.late = 0
        """How many messages were late."""

    def telemetry(self, drone: str) -> Telemetry:
        """Return what is known of a drone; the value stays current."""
        return self._navigation.telemetry(drone)

    def fly(self, job: Job, report: Callable[[object], None]) -> None:
        """Give a drone its job, which arrives later."""
        answer = partial(self._answered, job.drone, report)
        self._later(job.drone, COMMAND, partial(self._navigation.fly, job, answer))

    def _answered(self, drone: str, report: Callable[[object], None], result: object) -> None:
        self._later(drone, ANSWER, partial(report, result))

    def _late(self, what: str) -> float:
        seconds = self._delay(what)
        self.late += seconds > 0
        return seconds

    def _later(self, drone: str, what: str, call: Callable[[], object]) -> None:
        seconds = self._late(what)
        if seconds <= 0:
            call()
            return
        when = self._kernel.now + seconds
        arrives = partial(self._arrives, drone, call)
        self._jobs[drone] = self._kernel.at(when, Kind.FLIGHT, FLEET, arrives)

    def _arrives(self, drone: str, call: Callable[[], object]) -> None:
        self._jobs.pop(drone, None)
        call()

    def break_off(self, drone: str) -> None:
        """Stop whatever a drone does, or is about to be told."""
        timer, order = self._jobs.pop(drone, None), self._orders.pop(drone, None)
        if timer is not None:
            timer.cancel()
        self._navigation.break_off(drone)
        if order is not None:
            why = f"{drone} was told to break it off"
            order.fail(FlightFailed(Failure.REFUSED, why))

    async def hold(self, drone: str) -> None:
        """Hover, for as long as an action of the app's own takes."""
        await self._sent(drone, partial(self._navigation.hold, drone))

    async def takeoff(self, drone: str, height: float) -> None:
        """Rise to a height."""
        await self._sent(drone, partial(self._navigation.takeoff, drone, height))

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        await self._sent(drone, partial(self._navigation.go_to, drone, target))

    async def land(self, drone: str) -> None:
        """Land here."""
        await self._sent(drone, partial(self._navigation.land, drone))

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight."""
        return await self._sent(drone, partial(self._navigation.recover, drone))

    async def roll_call(self, drone: str) -> Standing:
        """Ask a drone where it is and what it has done, be it busy or not."""
        await self._kernel.sleep(self._late(COMMAND), Kind.FLIGHT)
        standing = await self._navigation.roll_call(drone)
        await self._kernel.sleep(self._late(ANSWER), Kind.FLIGHT)
        return standing

    async def _sent(self, drone: str, command: Callable[[], Coroutine[Any, Any, T]]) -> T:
        self._orders[drone] = broken_off = Signal[None]()
        try:
            await self._on_its_way(COMMAND, broken_off)
            result = await command()
            await self._on_its_way(ANSWER, broken_off)
        finally:
            if self._orders.get(drone) is broken_off:
                del self._orders[drone]
        return result

    async def _on_its_way(self, what: str, broken_off: Signal[None]) -> None:
        seconds = self._late(what)
        if seconds > 0:
            until = self._kernel.now + seconds
            await self._kernel.within(broken_off, until, Kind.FLIGHT, FLEET)
        if broken_off.is_set:
            broken_off.result()
