"""The brain's link to a gateway in another process."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from math import inf
from typing import TYPE_CHECKING, Any

from ..process.ipc import Message, line, message_in
from ..shared.domain.errors import BadInput
from ..shared.time.future import Future
from .wire import drone_report_of, fleet_report_of, job_data, result_of

if TYPE_CHECKING:
    from asyncio import StreamReader, StreamWriter

    from ..jobs.flown import Flown
    from ..jobs.job import Job, Report
    from ..jobs.reports import Down, DroneReport, FleetReport
    from ..jobs.telemetry import Telemetry
    from ..shared.domain.model import Point
    from ..shared.time.kernel import Kernel

GATEWAY_TIMEOUT = 5.0
"""Seconds of real time without a message after which the gateway is lost."""


class RemoteTelemetry:
    """A drone's latest telemetry."""

    __slots__ = ("_silent_since", "battery_level", "landed", "location", "moves")

    def __init__(self) -> None:
        self.location: Point = (0.0, 0.0, 0.0)
        self.battery_level, self.landed = 0.0, True
        self.moves = False
        """Whether it carries out a command."""
        self._silent_since: float | None = 0.0

    def take(self, told: Sequence[Any]) -> None:
        """Take over new telemetry."""
        x, y, z, self.battery_level, self.landed, self.moves, *since = told
        self.location = x, y, z
        self._silent_since = since[0] if since else None

    @property
    def silence(self) -> float:
        """Seconds since the drone's last message to the gateway; infinite: it has sent none."""
        since = self._silent_since
        return 0.0 if since is None else inf if not since else max(0.0, time.time() - since)


class RemoteLink:
    """Commands drones through a gateway in another process.

    When that cannot be reached any more, `lost` is called, once, and no command ever returns.
    """

    def __init__(
        self,
        kernel: Kernel,
        reader: StreamReader,
        writer: StreamWriter,
        lost: Callable[[], object] | None,
    ) -> None:
        self._kernel, self._reader, self._writer, self._lost = kernel, reader, writer, lost
        self._drones: dict[str, RemoteTelemetry] = {}
        self._jobs: dict[str, Job] = {}
        """The jobs by their ids, to call `begins`."""
        self._reports: dict[int, tuple[str, Report]] = {}
        """The listeners for the ends of jobs, by the numbers of their requests."""
        self._asks: dict[str, int] = {}
        """The number of the latest request for each job: others are ignored."""
        self._asked: dict[int, Future[Any]] = {}
        self._count = 0
        self._is_lost = False
        self._heard = 0.0
        self._watcher: Callable[[], object] | None = None
        self._flown: Callable[[Flown], object] | None = None
        self._tasks: list[asyncio.Task[None]] = []

    async def link(self, epoch: int, patience: float, speed: float = 1.0) -> None:
        """Take command; raise `BadInput` if another brain has done so meanwhile.

        `speed`: how fast time passes from now on, if the drones are simulated.
        """
        self._say({"do": "link", "epoch": epoch, "speed": float(speed)})
        told = message_in(await self._reader.readline())
        match told:
            case {"linked": dict(drones)}:
                self._see(drones)
            case {"ok": False, "said": str(why)}:
                raise BadInput(why)
            case _:
                raise ConnectionError("the gateway ended before it had answered")
        self._tasks = [
            asyncio.ensure_future(self._read()),
            asyncio.ensure_future(self._live(patience / 6)),
        ]

    async def _read(self) -> None:
        """Read messages of the gateway until the connection ends."""
        loop = asyncio.get_running_loop()
        self._heard = loop.time()
        with suppress(Exception):  # an invalid message: the line is broken
            while told := await self._reader.readline():
                self._heard = loop.time()
                message = message_in(told)
                if message is None or "lost" in message:
                    break
                self._see(message.get("seen", {}))
                if self._watcher is not None:
                    self._watcher()
                if set(message) != {"seen"}:
                    self._kernel.post(self._hear, message)
        self._end()

    async def _live(self, each: float) -> None:
        """Send heartbeats, and notice when the gateway is silent."""
        loop, late = asyncio.get_running_loop(), 0
        while not self._is_lost:
            self._say({"do": "heartbeat"})
            await asyncio.sleep(each)
            late = late + 1 if loop.time() - self._heard > GATEWAY_TIMEOUT else 0
            if late > 1:  # only if late twice in a row: its messages may be waiting to be read
                self._writer.transport.abort()

    def _end(self) -> None:
        if self._is_lost:
            return
        self._is_lost = True
        with suppress(OSError):
            self._writer.close()
        if self._lost is not None:
            self._kernel.post(self._lost)

    def _see(self, drones: Message) -> None:
        for drone, told in drones.items():
            self._drones.setdefault(drone, RemoteTelemetry()).take(told)

    def _hear(self, message: Message) -> None:
        match message:
            case {"report": number}:
                self._report(number, result_of(message))
            case {"begins": id} if id in self._jobs:
                self._jobs[id].begins()
            case {"flown": dict(command)} if self._flown is not None:
                self._flown(command)
            case {"n": number, "failure": _}:
                error = result_of(message)
                asked = self._asked.get(number)
                if asked is not None and isinstance(error, BaseException):
                    asked.fail(error)
            case {"n": number, "value": value} if number in self._asked:
                self._asked[number].set(value)

    def _report(self, number: int, result: object) -> None:
        """Call the listener, unless the job was requested again since."""
        if number in self._reports:
            id, report = self._reports[number]
            self._drop(id)
            report(result)

    def _say(self, message: Message) -> None:
        if not self._is_lost and not self._writer.transport.is_closing():
            self._writer.write(line(message))

    def _number(self) -> int:
        self._count += 1
        return self._count

    def _expect(self, id: str, report: Report) -> int:
        """Set the only listener for a job's end; return the number for the request."""
        self._drop(id)
        self._asks[id] = number = self._number()
        self._reports[number] = id, report
        return number

    def _drop(self, id: str) -> None:
        self._jobs.pop(id, None)
        self._reports.pop(self._asks.pop(id, 0), None)

    async def _ask(self, **message: Any) -> Any:
        """Send a request and await its answer; cancelling this cancels the request."""
        number = self._number()
        answer: Future[Any] = Future()
        self._asked[number] = answer
        self._say({"n": number, **message})
        try:
            return await answer
        finally:
            del self._asked[number]
            if not answer.is_set:
                self._say({"do": "cancel", "n": number})

    # What every navigation does

    def telemetry(self, drone: str) -> Telemetry:
        """Return what is known of a drone; the value stays current."""
        return self._drones[drone]

    def moves(self, drone: str) -> bool:
        """Return whether a drone is carrying out a command, as far as the gateway has told."""
        return self._drones[drone].moves

    def fly(self, job: Job, report: Report) -> None:
        """Give a drone its job. One that was done already is not flown, but reported once more."""
        number = self._expect(job.id, report)
        self._jobs[job.id] = job
        self._say({"do": "fly", "n": number, "job": job_data(job)})

    def break_off(self, drone: str) -> None:
        """Stop what a drone does, and hover."""
        self._say({"do": "break_off", "drone": drone})

    async def hold(self, drone: str) -> None:
        """Hover, for as long as an action of the app's own takes."""
        await self._ask(do="hold", drone=drone)

    async def read(self, drone: str, name: str) -> float:
        """Return a sensor or variable of a drone."""
        return float(await self._ask(do="read", drone=drone, name=name))

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set a parameter of a drone."""
        await self._ask(do="write", drone=drone, name=name, value=value)

    async def takeoff(self, drone: str, height: float) -> None:
        """Rise to a height."""
        await self._ask(do="takeoff", drone=drone, height=height)

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        await self._ask(do="go_to", drone=drone, target=target)

    async def join(self, joining: Mapping[str, Any]) -> str:
        """Take a drone into the fleet; return why that cannot be, or nothing."""
        return str(await self._ask(do="join", joining=joining))

    async def mishap(self, drone: str, kind: str, job: str | None) -> str:
        """Have a mishap happen to a simulated drone; return why it cannot, or nothing."""
        return str(await self._ask(do="mishap", drone=drone, kind=kind, job=job))

    async def home(self, drone: str) -> None:
        """Fly to its dock, and land there."""
        await self._ask(do="home", drone=drone)

    async def land(self, drone: str) -> None:
        """Land here."""
        await self._ask(do="land", drone=drone)

    def mended(self, drone: str) -> None:
        """A person has looked after a lost drone: it can be recovered once more."""
        self._say({"do": "mended", "drone": drone})

    async def recover(self, drone: str) -> bool:
        """Bring a drone home after a failed flight."""
        return bool(await self._ask(do="recover", drone=drone))

    async def drone_report(self, drone: str) -> DroneReport:
        """Ask a drone where it is and what it has done."""
        return drone_report_of(await self._ask(do="roll_call", drone=drone))

    # Beyond the navigation protocol

    async def fleet_report(self) -> FleetReport:
        """Query all drones and the ledger."""
        return fleet_report_of(await self._ask(do="call"))

    def attach(self, id: str, report: Report) -> None:
        """Register for the report of an earlier job: called when it ends, or now if it has."""
        self._say({"do": "attach", "n": self._expect(id, report), "id": id})

    def forget(self, id: str) -> None:
        """Forget a job: its id may be given again."""
        self._drop(id)
        self._say({"do": "forget", "id": id})

    async def bring_down(self, how: Down) -> None:
        """Abort everything and bring all drones down; return when all that can have landed."""
        await self._ask(do="down", how=how.value)

    def on_telemetry(self, watcher: Callable[[], object]) -> None:
        """Call this at each update of the telemetry."""
        self._watcher = watcher

    def on_flown(self, hear: Callable[[Flown], object]) -> None:
        """Call this with each command that a drone has flown."""
        self._flown = hear

    # The end

    async def goodbye(self) -> None:
        """Allow the gateway to exit once all drones have landed."""
        self._lost = None
        self._say({"do": "goodbye"})
        if self._tasks:
            await asyncio.wait(self._tasks[:1])
        await self.close()

    async def close(self) -> None:
        """Close the connection: the gateway goes on, and lands all drones unless another brain connects."""
        self._lost = None
        self._end()
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        with suppress(OSError):
            await self._writer.wait_closed()
