"""Serves brains in other processes, whose orders it passes on; no message can break it.

One connection is one brain's. Without `link`, a client may only send `stop` and `cut-motors`: anyone who may
open the socket may land the drones, whether the brain answers or not.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import suppress
from math import inf
from typing import TYPE_CHECKING

from ..jobs.reports import Down
from ..jobs.telemetry import Subscription
from ..process.ipc import Message, line, message_in
from ..shared.domain.errors import BadInput, Failure
from ..shared.domain.text import quoted
from ..shared.time.kernel import FLEET, Task
from .gateway import Busy
from .wire import MAX_COMMAND, order_of, seen

if TYPE_CHECKING:
    from asyncio import StreamReader, StreamWriter

    from ..jobs.telemetry import Telemetry
    from .gateway import Gateway, Line

_PENDING = 10_000
"""Concurrent commands of one brain."""
_UNREAD = 64 * 1024 * 1024
"""Unread bytes after which a brain is disconnected."""
_EACH = 0.1
"""Seconds of real time between two updates of the telemetry."""
_ALIVE = 1.0
"""Seconds without any change after which an empty update is sent."""

Say = Callable[[str], object]


class Server:
    """All connections."""

    def __init__(self, gateway: Gateway, say: Say, on_goodbye: Callable[[], object]) -> None:
        self.gateway = gateway
        self.say = say
        self.on_goodbye = on_goodbye
        self.connected: list[Connection] = []
        self.pass_at: Callable[[float], object] | None = None
        """Lets time pass at another speed; None: the drones are real."""

    @property
    def has_a_brain(self) -> bool:
        """Whether a brain is in command."""
        return any(one.line is not None and not one.leaves for one in self.connected)

    async def serve(self, reader: StreamReader, writer: StreamWriter) -> None:
        """Serve a connection, until it ends."""
        connection = Connection(self, writer)
        self.connected.append(connection)
        try:
            await connection.serve(reader)
        finally:
            self.connected.remove(connection)

    def hang_up(self) -> None:
        """Disconnect those that have said goodbye: they need not wait for the end."""
        for connection in self.connected:
            if connection.leaves:
                connection.hang_up()


class Connection:
    """The connection of a brain, or of a client that only stops."""

    def __init__(self, server: Server, writer: StreamWriter) -> None:
        self._server, self._writer, self._gateway = server, writer, server.gateway
        self.line: Line | None = None
        """How it commands, if it is a brain's."""
        self._was_cut = False
        self._telemetry: Subscription[tuple[object, ...]] | None = None
        """None: it was never in command."""
        self.leaves = False
        """Whether it has said goodbye."""

    def hang_up(self) -> None:
        """End the connection."""
        with suppress(OSError):
            self._writer.close()

    async def serve(self, reader: StreamReader) -> None:
        """Serve requests, line by line, until the connection ends."""
        try:
            with suppress(OSError):
                while told := await reader.readline():
                    self._gateway.kernel.post(self._hear, told)
        except ValueError:  # the line is too long
            self._refuse(f"a line was longer than {MAX_COMMAND} bytes")
        finally:
            self._tell_no_telemetry()
            self._gateway.kernel.post(self._leave)
            self.hang_up()

    def _leave(self) -> None:
        line = self.line
        self.line = None
        if line is not None:
            line.hear = _ignore
            line.leave()

    def _tell(self, message: Message) -> None:
        """Send a message; a client that does not read is disconnected."""
        transport = self._writer.transport
        if transport.get_write_buffer_size() > _UNREAD:
            self._server.say("the brain reads nothing any more: it is given up")
            transport.abort()
        elif not transport.is_closing():
            self._writer.write(line(message))

    # Telemetry

    def _tell_seen(self, changed: Message, late: float) -> None:
        if self.line is not None:
            self._tell({"seen": changed})

    def _seen(self, drone: str, telemetry: Telemetry) -> tuple[object, ...]:
        return seen(telemetry, self._gateway.executor.moves(drone))

    def _tell_no_telemetry(self) -> None:
        if self._telemetry is not None:
            self._telemetry.cancel()

    def _changed(self) -> Message:
        """Return the telemetry that has changed since it was last sent."""
        return {} if self._telemetry is None else self._telemetry.changed()

    # Requests

    def _hear(self, told: bytes) -> None:
        message = message_in(told)
        try:
            if message is None:
                raise BadInput("that is not a line of JSON with an object")
            self._do(message)
        except BadInput as error:
            self._refuse(str(error))
        except (AttributeError, KeyError, OverflowError, TypeError, ValueError) as error:
            self._refuse(f"that message is not complete: {type(error).__name__}: {error}")

    def _refuse(self, why: str) -> None:
        self._server.say(f"refused: {why}")
        self._tell({"ok": False, "said": why})

    def _do(self, message: Message) -> None:
        match message:
            case {"do": "stop", "how": ("rtl" | "land") as how}:
                self._gateway.fail_safe(Down(how))
                self._server.say(f"told to bring all drones down ({how}), not by the brain")
                self._tell({"ok": True, "said": "the drones come down"})
            case {"do": "cut-motors", "drone": str(drone)}:
                self._cut_motors([self._in_the_fleet(drone)])
            case {"do": "cut-motors", "all": True}:
                self._cut_motors([drone.id for drone in self._gateway.drones])
            case {"do": "link", "epoch": int(epoch)} if self.line is None:
                self._link(epoch)
                self._pass_at(message.get("speed"))
            case {"do": "link"} if self.line is not None:
                raise BadInput("this connection commands already")
            case {"do": str()} if self.line is not None:
                self._obey(self.line, message)
            case {"do": str()} if self._was_cut:
                pass  # it was in transit
            case _:
                raise BadInput("this gateway does not know that message")

    def _cut_motors(self, drones: Sequence[str]) -> None:
        """Switch motors off at once; answer when that is done."""
        self._server.say(f"told to cut the motors of {', '.join(drones)}")
        spawn, cut = self._gateway.kernel.spawn, self._gateway.cut_motors
        tasks = [spawn(cut(drone), FLEET, f"{drone}'s motors are cut") for drone in drones]
        spawn(self._say_what_is_cut(drones, tasks), FLEET, "motors are cut")

    async def _say_what_is_cut(self, drones: Sequence[str], tasks: Sequence[Task[str]]) -> None:
        done, not_done = [], []
        for drone, task in zip(drones, tasks, strict=True):
            why = await task
            if why:
                not_done.append(f"{drone} could not be told to: {why}")
            else:
                done.append(drone)
        said = [f"the motors of {', '.join(done)} are cut"] if done else []
        self._server.say("; ".join((*said, *not_done)))
        self._tell({"ok": not not_done, "said": "; ".join((*said, *not_done))})

    def _in_the_fleet(self, drone: str) -> str:
        names = [one.id for one in self._gateway.drones]
        if drone not in names:
            known = ", ".join(map(quoted, names))
            raise BadInput(f"no drone {quoted(drone)} is in the fleet; there are: {known}")
        return drone

    def _link(self, epoch: int) -> None:
        self.line = self._gateway.link(epoch, self._lost)
        self.line.hear = self._told
        self._tell_no_telemetry()  # this connection may have been in command before
        self._telemetry = Subscription(
            self._gateway.executor.telemetry,
            self._tell_seen,
            every=_EACH,
            view=self._seen,
            unchanged=_ALIVE,
        )
        self._tell({"linked": self._changed()})
        self._server.say(f"a brain commands, number {epoch}")

    def _pass_at(self, speed: object) -> None:
        """Let time pass as fast as for the brain that commands now."""
        change = self._server.pass_at
        if change is not None and isinstance(speed, float) and 0.0 < speed < inf:
            change(speed)

    def _lost(self) -> None:
        if self.line is None:  # it has disconnected
            return
        self._server.say("the brain that commanded is cut off")
        self.line = None
        self._was_cut = True
        self._tell({"lost": True})

    def _obey(self, line: Line, message: Message) -> None:
        if message["do"] == "goodbye":
            self.leaves = True
            self._server.on_goodbye()
            return
        order = order_of(message, self._gateway.executor.telemetry)
        if order.get("id") in line.under_way or len(line.under_way) >= _PENDING:
            raise BadInput("too much is under way")
        try:
            line.send(order)
        except Busy as error:
            self._server.say(f"refused: {error}")
            why = {"failure": Failure.REFUSED.name, "reason": str(error)}
            self._told({"failed": order["id"], **why})

    def _told(self, message: Message) -> None:
        """Pass on what a brain is told, and first what has changed of the drones."""
        self._tell({**message, "seen": self._changed()})


def _ignore(_: Message) -> None:
    """Do nothing with a report: no brain is connected."""
