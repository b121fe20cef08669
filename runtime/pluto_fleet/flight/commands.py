"""The socket through which commands reach a running app.

A command takes effect at once: a request is read and carried out within the kernel in one step,
even while the app waits for other things. Only the answer may have to wait.
"""

from __future__ import annotations

from collections.abc import AsyncIterator, Mapping, Sequence
from contextlib import AsyncExitStack, asynccontextmanager
from pathlib import Path
from typing import Protocol

from ..jobs.link import MISHAPS
from ..jobs.reports import Down
from ..journal.errors import why
from ..process.ipc import Answer, answering, listening
from ..shared.domain.errors import BadInput


class Control(Protocol):
    """The commands of a running app; each returns what it did, or raises `BadInput`."""

    def stop(self, how: Down) -> str:
        """Bring all drones down; every mission can be resumed later."""
        ...

    def pause(self, mission: str | None) -> str:
        """Suspend a mission, or all, until it is told to go on."""
        ...

    def go_on(self, mission: str | None) -> str:
        """Resume a paused mission, or all paused ones."""
        ...

    def skip(self, mission: str, trip: str | None) -> str:
        """Skip a trip of a mission; None: its next one."""
        ...

    def cancel(self, mission: str | None) -> str:
        """End a mission, or all, for good."""
        ...

    def change_trips(
        self, mission: str, trips: Sequence[object], replaces: Sequence[object] | None
    ) -> str:
        """Replace the trips of a mission that have not flown."""
        ...

    def prioritise(self, mission: str, trip: str, priority: int) -> str:
        """Change a trip's priority in the queue for a drone."""
        ...

    def retire(self, drone: str) -> str:
        """Allocate a drone to no further trip, until it is brought back."""
        ...

    def join(self, entry: Mapping[str, object]) -> str:
        """Have a drone join the fleet, given as in a fleet file."""
        ...

    def mishap(self, drone: str, kind: str) -> str:
        """Have a mishap happen to a simulated drone, to rehearse it."""
        ...

    def bring_back(self, drone: str) -> str:
        """Make a drone available again that was retired, or lost and repaired since."""
        ...

    def decide(self, mission: str, answer: str) -> str:
        """Answer an open question: `done`, `not-done`, `go-on` or `cancel`."""
        ...


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
        case {"command": "join"} if (entry := joining_in(request)) is not None:
            return control.join(entry)
        case _:
            raise BadInput("this app does not know that command")


def joining_in(request: Mapping[str, object]) -> Mapping[str, object] | None:
    """Return the drone that is to join, as in a fleet file; None: it is another request."""
    if request.get("command") != "join":
        return None
    given = {key: one for key, one in request.items() if key not in ("command", "drone")}
    return {
        "id": request.get("drone"),
        **{key: one for key, one in given.items() if one is not None},
    }


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
