"""The socket through which commands reach a running app.

Nothing stands between a command and what it does: a request is read and carried out within the
kernel in one go, whatever else the app waits for. Only the answer may have to wait.
"""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from contextlib import asynccontextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from plutoc_runtime.domain.errors import BadInput

from ..jobs.reports import Down
from ..journal.errors import why
from ..process.asking import LONGEST
from ..process.forked import not_for_children
from ..process.private import new_address, publish, withdraw

if TYPE_CHECKING:
    from asyncio import StreamReader, StreamWriter

_AT_ONCE = 32
"""Who may be connected at the same time."""

_PATIENCE = 5.0
"""Seconds within which a request must be there, and an answer be read."""

_LAST_WORDS = 0.5
"""Seconds for answers that are on their way when the app ends."""

Answer = Callable[[Mapping[str, object]], Awaitable[str]]


class Control(Protocol):
    """What can be asked of a running app; each says what it did, or raises `BadInput`."""

    def stop(self, how: Down) -> str:
        """Bring all drones down; every mission can go on later."""
        ...

    def pause(self, mission: str | None) -> str:
        """Take a mission, or all, out of its graph until it is told to go on."""
        ...

    def go_on(self, mission: str | None) -> str:
        """Let a paused mission, or all that are, go on where it was."""
        ...

    def skip(self, mission: str, trip: str | None) -> str:
        """Leave out a trip of a mission; None: its next one."""
        ...

    def cancel(self, mission: str | None) -> str:
        """End a mission, or all, for good."""
        ...

    def prioritise(self, mission: str, trip: str, priority: int) -> str:
        """Fly a trip sooner, or later, than others that wait for a drone."""
        ...

    def retire(self, drone: str) -> str:
        """Let nobody have a drone any more, until it is brought back."""
        ...

    def bring_back(self, drone: str) -> str:
        """Let a drone be handed out again that is retired, or lost and looked after since."""
        ...

    def decide(self, mission: str, answer: str) -> str:
        """Settle what only a person can know: `done`, `not-done`, `go-on` or `cancel`."""
        ...


def perform(control: Control, request: Mapping[str, object]) -> str:
    """Do what was asked; raise `BadInput` if it makes no sense."""
    how = stop_in(request)
    if how is not None:
        return control.stop(how)
    match request:
        case {"command": "pause", "mission": str() | None as mission}:
            return control.pause(mission)
        case {"command": "go-on", "mission": str() | None as mission}:
            return control.go_on(mission)
        case {"command": "skip", "mission": str(mission), "trip": str() | None as trip}:
            return control.skip(mission, trip)
        case {"command": "cancel", "mission": str() | None as mission}:
            return control.cancel(mission)
        case {"command": "decide", "mission": str(mission), "answer": str(answer)}:
            return control.decide(mission, answer)
        case {
            "command": "prioritise",
            "mission": str(mission),
            "trip": str(trip),
            "priority": int(priority),
        }:
            return control.prioritise(mission, trip, priority)
        case {"command": "retire", "drone": str(drone)}:
            return control.retire(drone)
        case {"command": "bring-back", "drone": str(drone)}:
            return control.bring_back(drone)
        case _:
            raise BadInput("this app does not know that command")


def stop_in(request: Mapping[str, object]) -> Down | None:
    """Return how a request wants all drones to come down; None: it wants something else."""
    match request:
        case {"command": "stop", "how": ("rtl" | "land") as how}:
            return Down(how)
    return None


@asynccontextmanager
async def listening(note: Path, answer: Answer) -> AsyncIterator[None]:
    """Answer whoever finds the note; `answer` does what is asked before it waits for anything."""
    address = new_address(note)
    served: set[asyncio.Task[None]] = set()

    def serve(reader: StreamReader, writer: StreamWriter) -> None:
        if len(served) >= _AT_ONCE:
            writer.transport.abort()
            return
        task = asyncio.ensure_future(_serve(reader, writer, answer))
        served.add(task)
        task.add_done_callback(served.discard)

    server = await asyncio.start_unix_server(serve, address, limit=LONGEST)
    for one in server.sockets:
        not_for_children(one.fileno())
    try:
        _publish(note, address)
        yield
    finally:
        server.close()
        withdraw(note)
        if served:  # an answer that is on its way still arrives
            _, idle = await asyncio.wait(list(served), timeout=_LAST_WORDS)
            for task in idle:
                task.cancel()
            await asyncio.gather(*idle, return_exceptions=True)


def _publish(note: Path, address: Path) -> None:
    """Say where commands are heard; nothing flies that nobody could stop."""
    try:
        publish(note, address)
    except OSError as error:
        raise BadInput(
            f"{note}: it cannot be written that commands are heard, and so nothing flies:"
            f" {why(error)}; mend that, then resume"
        ) from None


async def _serve(reader: StreamReader, writer: StreamWriter, answer: Answer) -> None:
    try:
        with suppress(OSError, TimeoutError):
            async with asyncio.timeout(_PATIENCE):
                try:
                    line = await reader.readline()
                except ValueError:  # it is too long
                    line = b""
            writer.write(await _said(line, answer))
            async with asyncio.timeout(_PATIENCE):
                await writer.drain()
    finally:
        with suppress(OSError):
            writer.close()


async def _said(line: bytes, answer: Answer) -> bytes:
    try:
        request = json.loads(line)
    except (ValueError, RecursionError):
        request = None
    if not isinstance(request, dict):
        return _reply(ok=False, said="that is not a line of JSON with an object")
    try:
        return _reply(ok=True, said=await answer(request))
    except BadInput as error:
        return _reply(ok=False, said=str(error))


def _reply(*, ok: bool, said: str) -> bytes:
    return json.dumps({"ok": ok, "said": said}).encode() + b"\n"
