"""The way between a brain and the gateway that flies its drones: mappings, as they are, in both directions.

What a brain says shall be done (docs/seam.md) is sent unchanged, over a socket or by a call, to the one place
that obeys it; what is reported of it comes back as the brain is told it. The library's own questions go the
same way; their ids are texts, and those of a brain's orders are numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

from ..shared.fleet.orders import failure_of
from ..shared.time.kernel import Future
from .reports import Down, DroneReport, FleetReport, drone_report_of, fleet_report_of

if TYPE_CHECKING:
    from .telemetry import Telemetry

Order = Mapping[str, Any]
"""What to `do`, for which `drone`, and the `id` under which it is reported, if it is."""
Message = dict[str, Any]
"""What is told: that an order is `done` or has `failed`, or what was `flown`."""

UNCERTAIN = "uncertain"
MISHAPS = ("lost", "crash", "battery", UNCERTAIN)
"""What can happen to simulated drones: a lost link, a fall, an empty battery, and an action of which no report comes."""


class Link:
    """One brain's way to its gateway, as long as it is the one in command."""

    def __init__(self) -> None:
        self.hear: Callable[[Message], object] = _ignore
        """Called, within the kernel, with what a brain is to be told, and with each `flown`."""
        self.seen: Callable[[], object] = _nothing
        """Called at each update of the telemetry from another process."""
        self._answers: dict[str, Future[Any]] = {}
        """The library's own questions, by their ids."""
        self._count = 0

    def send(self, order: Order) -> None:
        """Give an order; what comes of it is heard later, never from within this call."""
        raise NotImplementedError

    def telemetry(self, drone: str) -> Telemetry:
        """Return a drone's telemetry, an object that is always current."""
        raise NotImplementedError

    def moves(self, drone: str) -> bool:
        """Return whether a drone is carrying out a command that moves it, or acts; not while it waits for its way."""
        raise NotImplementedError

    async def ask(self, do: str, **facts: object) -> Any:
        """Send a question of the library's own and return the answer; raise `FlightFailed`.

        There is no answer once another brain commands. Cancelling this cancels the question.
        """
        self._count += 1
        number = f"ask {self._count}"
        answer = self._answers[number] = Future[Any]()
        self.send({"do": do, "id": number, **facts})
        try:
            return await answer
        finally:
            del self._answers[number]
            if not answer.is_set:
                self.send({"do": "cancel", "order": number})

    def take(self, message: Message) -> None:
        """Called with what the gateway tells: hand answers to those who asked, and all else on."""
        answer = self._answers.get(message.get("done") or message.get("failed") or "")
        if answer is None:
            self.hear(message)
        elif "failed" in message:
            answer.fail(failure_of(message))
        else:
            answer.set(message["value"])

    async def fleet_report(self) -> FleetReport:
        """Query all drones and the ledger; from now on this brain is obeyed."""
        return fleet_report_of(await self.ask("call"))

    async def drone_report(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done; it says so if it does not answer."""
        return drone_report_of(await self.ask("report", drone=drone))

    async def bring_down(self, how: Down) -> None:
        """Abort everything and bring all drones down; return when all that can have landed."""
        await self.ask("down", how=how.value)

    async def goodbye(self) -> None:
        """Allow the gateway to end once all drones have landed."""

    async def close(self) -> None:
        """End this link: the gateway lands all drones unless another brain connects."""


def _ignore(_: Message) -> None:
    """Do nothing with a report: no callback is set."""


def _nothing() -> None:
    """Do nothing: no callback is set."""
