"""The socket through which commands reach a running app.

A command takes effect at once: a request is read and carried out within the kernel in one step,
even while the app waits for other things. Only the answer may have to wait.
"""

from __future__ import annotations

from collections.abc import AsyncIterator, Mapping
from contextlib import AsyncExitStack, asynccontextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from ..jobs.link import MISHAPS
from ..jobs.reports import Down
from ..journal.errors import why
from ..process.ipc import Answer, answering, listening
from ..shared.domain.errors import BadInput

if TYPE_CHECKING:
    from .control import Control


def perform(control: Control, request: Mapping[str, object]) -> str:
    """Carry out a request; raise `BadInput` if it is invalid."""
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
        case {"command": "change-trips", "mission": str(mission), "trips": list(trips), **more}:
            replaces = more.get("replaces")
            if not isinstance(replaces, list | None):
                raise BadInput("change-trips needs replaces: a list of names, or nothing")
            return control.change_trips(mission, trips, replaces)
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
        case {"command": "mishap", "drone": str(drone), "kind": str(kind)} if kind in MISHAPS:
            return control.mishap(drone, kind)
        case {"command": "raise-event", "event": str(event), **facts}:
            return control.raise_event(event, facts)
        case {"command": "join"} if (entry := joining_in(request)) is not None:
            return control.join(entry)
        case _:
            raise BadInput("this app does not know that command")


def joining_in(request: Mapping[str, object]) -> Mapping[str, object] | None:
    """Return the drone that is to join, as in a fleet file; None: it is another request."""
    if request.get("command") != "join":
        return None
    entry = {"id": request.get("drone"), **request}
    return {
        key: one for key, one in entry.items() if one is not None and key not in _NOT_OF_THE_DRONE
    }


_NOT_OF_THE_DRONE = ("command", "drone")


def stop_in(request: Mapping[str, object]) -> Down | None:
    """Return how a Stop request wants all drones to come down; None: it is another request."""
    match request:
        case {"command": "stop", "how": ("rtl" | "land") as how}:
            return Down(how)
    return None


@asynccontextmanager
async def hear_commands(note: Path, answer: Answer) -> AsyncIterator[None]:
    """Serve commands; without this socket nothing may fly, as it could not be stopped."""
    async with AsyncExitStack() as stack:
        try:
            await stack.enter_async_context(listening(note, answering(answer)))
        except OSError as error:
            raise BadInput(
                f"{note}: it cannot be written that commands are heard, and so nothing flies:"
                f" {why(error)}; mend that, then resume"
            ) from None
        yield
