"""The brain's end of the line to a gateway in another process: a link like any other."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable, Sequence
from contextlib import suppress
from math import inf
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.time.future import Future

from ..process.ipc import Message, line, message_in
from .wire import drone_report_of, fleet_report_of, job_data, result_of

if TYPE_CHECKING:
    from asyncio import StreamReader, StreamWriter

    from plutoc_runtime.domain.model import Point, Telemetry
    from plutoc_runtime.time.kernel import Kernel

    from ..jobs.job import Job, Report
    from ..jobs.reports import Down, DroneReport, FleetReport

GATEWAY_TIMEOUT = 5.0
"""Seconds on the wall without a word from the gateway after which it is lost."""


class RemoteTelemetry:
    """What was heard of a drone last."""

    __slots__ = ("_silent_since", "battery_level", "landed", "location")

    def __init__(self) -> None:
        self.location: Point = (0.0, 0.0, 0.0)
        self.battery_level, self.landed = 0.0, True
        self._silent_since: float | None = 0.0

    def take(self, told: Sequence[Any]) -> None:
        """Hear something new of it."""
        x, y, z, self.battery_level, self.landed, *since = told
        self.location = x, y, z
        self._silent_since = since[0] if since else None

    @property
    def silence(self) -> float:
        """Seconds since the gateway last heard of it; infinite: it never has."""
        since = self._silent_since
        return 0.0 if since is None else inf if not since else max(0.0, time.time() - since)


class RemoteLink:
    """Commands drones through a gateway in another process.

    When that cannot be reached any more, `lost` is told, once, and no command ever returns.
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
        """What was given, by the jobs' ids: it is told when its action begins."""
        self._reports: dict[int, tuple[str, Report]] = {}
        """The listener for how a job ends, by the number of the request."""
        self._asks: dict[str, int] = {}
        """The number under which each job was asked for last: no other is heard."""
        self._asked: dict[int, Future[Any]] = {}
        self._count = 0
        self._is_lost = False
        self._heard = 0.0
        self._watcher: Callable[[], object] | None = None
        self._tasks: list[asyncio.Task[None]] = []

    async def link(self, epoch: int, patience: float) -> None:
        """Become the one who commands; `BadInput` if another does, since."""
        self._say({"do": "link", "epoch": epoch})
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
        """Take what the gateway tells, until it tells nothing more."""
        loop = asyncio.get_running_loop()
        self._heard = loop.time()
        with suppress(Exception):  # a message that cannot be read: the line is broken
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
        """Say again and again that the brain is alive, and notice when the gateway is not."""
        loop, late = asyncio.get_running_loop(), 0
        while not self._is_lost:
            self._say({"do": "heartbeat"})
            await asyncio.sleep(each)
            late = late + 1 if loop.time() - self._heard > GATEWAY_TIMEOUT else 0
            if late > 1:  # not the first time: what it said may be waiting to be read
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
            case {"n": number, "failure": _}:
                error = result_of(message)
                asked = self._asked.get(number)
                if asked is not None and isinstance(error, BaseException):
                    asked.fail(error)
            case {"n": number, "value": value} if number in self._asked:
                self._asked[number].set(value)

    def _report(self, number: int, result: object) -> None:
        """Tell the listener, unless the job was asked for again since."""
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
        """Set the only listener for how a job ends; return the number to ask with."""
        self._drop(id)
        self._asks[id] = number = self._number()
        self._reports[number] = id, report
        return number

    def _drop(self, id: str) -> None:
        self._jobs.pop(id, None)
        self._reports.pop(self._asks.pop(id, 0), None)

    async def _ask(self, **message: Any) -> Any:
        """Ask for what takes its time; cancelling this cancels it over there, too."""
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
        """Return what a drone measures under this name."""
        return float(await self._ask(do="read", drone=drone, name=name))

    async def write(self, drone: str, name: str, value: float) -> None:
        """Set what a drone has under this name."""
        await self._ask(do="write", drone=drone, name=name, value=value)

    async def takeoff(self, drone: str, height: float) -> None:
        """Rise to a height."""
        await self._ask(do="takeoff", drone=drone, height=height)

    async def go_to(self, drone: str, target: Point) -> None:
        """Fly straight to a point."""
        await self._ask(do="go_to", drone=drone, target=target)

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

    # What only a gateway does

    async def fleet_report(self) -> FleetReport:
        """Ask all drones and the ledger how everything stands."""
        return fleet_report_of(await self._ask(do="call"))

    def attach(self, id: str, report: Report) -> None:
        """Hear of a job that was given before: when it ends, or now if it has."""
        self._say({"do": "attach", "n": self._expect(id, report), "id": id})

    def forget(self, id: str) -> None:
        """Forget a job: its id may be given again."""
        self._drop(id)
        self._say({"do": "forget", "id": id})

    async def bring_down(self, how: Down) -> None:
        """Break off everything and bring all drones down; return when all that can are down."""
        await self._ask(do="down", how=how.value)

    def on_telemetry(self, watcher: Callable[[], object]) -> None:
        """Call this whenever something was heard of the drones."""
        self._watcher = watcher

    # How it ends

    async def goodbye(self) -> None:
        """Let the gateway end, once all drones are down; nothing is lost by that."""
        self._lost = None
        self._say({"do": "goodbye"})
        if self._tasks:
            await asyncio.wait(self._tasks[:1])
        await self.close()

    async def close(self) -> None:
        """Hang up: the gateway goes on, and lands everything if no other brain comes."""
        self._lost = None
        self._end()
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)
        with suppress(OSError):
            await self._writer.wait_closed()
