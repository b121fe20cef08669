"""Carrying out what a brain orders, by a link to a gateway, and telling it what came of that."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from ..gateway.wire import result_data
from ..shared.domain.errors import Cancelled, FlightFailed
from ..shared.hooks.plain_data import item_of

if TYPE_CHECKING:
    from collections.abc import Coroutine

    from ..jobs.job import CommandLink
    from ..shared.domain.actions import Plain
    from ..shared.domain.model import Item, Point
    from ..shared.time.kernel import Kernel, Key, Task

Order = Mapping[str, Any]
Message = dict[str, Any]


class OrderedJob:
    """The job of an order to fly."""

    __slots__ = ("action", "beside", "drone", "id", "item", "parameters", "seconds", "stops")

    def __init__(self, order: Order) -> None:
        self.id: str = order["flight"]
        self.drone: str = order["drone"]
        self.stops: tuple[Point, ...] = tuple((x, y, z) for x, y, z in order["stops"])
        self.action: str | None = order["action"]
        self.parameters: Mapping[str, Plain] = order["parameters"]
        self.item: Item | None = item_of(order["item"])
        self.seconds: float = order["seconds"]
        self.beside: bool = order["beside"]

    def begins(self) -> None:
        """Called right before the action is done."""


class Dispatcher:
    """Gives a link the orders of a brain."""

    def __init__(self, kernel: Kernel, link: CommandLink, keys: Mapping[str, Key]) -> None:
        self._kernel, self._link, self._keys = kernel, link, keys
        self.tell: Callable[[Message], object] = _ignore
        """Called with what came of an order."""
        self._under_way: dict[int, Task[Any]] = {}

    def obey(self, order: Order) -> None:
        """Carry out an order; what comes of it is told later, never from within this call."""
        drone, number = order["drone"], order["id"]
        match order["do"]:
            case "fly":
                self._link.fly(OrderedJob(order), partial(self._reported, number))
            case "attach":
                self._link.attach(order["flight"], partial(self._reported, number))
            case "break_off":
                self._link.break_off(drone)
            case "mended":
                self._link.mended(drone)
            case "cancel":
                task = self._under_way.pop(order["order"], None)
                if task is not None:
                    task.cancel()
            case do:
                task = self._kernel.spawn(
                    self._command(order), self._keys[drone], f"{drone} is told to {do}"
                )
                task.over = partial(self._ended, number)
                self._under_way[number] = task

    def _command(self, order: Order) -> Coroutine[Any, Any, object]:
        link, drone = self._link, order["drone"]
        match order["do"]:
            case "hold":
                return link.hold(drone)
            case "read":
                return link.read(drone, order["name"])
            case "write":
                return link.write(drone, order["name"], order["value"])
            case "home":
                return link.home(drone)
            case "land":
                return link.land(drone)
            case "recover":
                return self._recovered(drone)
            case do:
                raise ValueError(f"a brain ordered {do!r}, which this library does not know")

    async def _recovered(self, drone: str) -> bool | str:
        """Bring a drone home; if it is lost, return what it says of that itself."""
        if await self._link.recover(drone):
            return True
        report = await self._link.drone_report(drone)
        return "; ".join(report.problems)

    def _reported(self, number: int, result: object) -> None:
        self.tell(outcome(number, result))

    def _ended(self, number: int, task: Task[Any]) -> None:
        if self._under_way.pop(number, None) is not task:
            return  # it was cancelled
        if task.error is None:
            self.tell(outcome(number, task.result()))
        elif isinstance(task.error, FlightFailed):
            self.tell(outcome(number, task.error))
        elif not isinstance(task.error, Cancelled):
            self._kernel.crash(task.error)


def outcome(number: int, result: object) -> Message:
    """Return what a brain is told of an order."""
    said = "failed" if isinstance(result, FlightFailed) else "done"
    return {said: number, **result_data(result)}


def _ignore(_: object) -> None:
    """Do nothing: no callback is set."""
