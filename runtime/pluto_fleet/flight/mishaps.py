"""Mishaps that a person has happen to simulated drones, to rehearse what is to be done then."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from ..jobs.link import UNCERTAIN
from ..shared.domain.errors import BadInput
from ..shared.domain.text import quoted
from ..shared.time.kernel import FLEET, EventKind
from .mission_status import aside
from .reconcile import id_of, in_flight, trip_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..journal.standing import Record
    from ..shared.domain.trace import Event
    from ..shared.time.kernel import Task
    from .recorded_brain import RecordedBrain

_OVER = (
    *("trip.completed", "trip.failed", "trip.interrupted"),
    *("mission.ended", "mission.paused", "mission.uncertain"),
)


class Mishaps:
    """The mishaps of one run."""

    def __init__(self, run: RecordedBrain, look_into: Callable[[str, Record], object]) -> None:
        """`look_into` interrupts a mission, and finds out what came of its flight."""
        self._run, self._look_into = run, look_into
        self._armed: dict[str, Task[None]] = {}
        """By mission, what waits for its action to be done."""

    async def happen(self, drone: str, kind: str) -> str:
        """Let a mishap happen to a drone in the air; return why it cannot, or nothing."""
        return str(await self._run.link.ask("mishap", drone=drone, kind=kind, job=None))

    def arm(self, drone: str) -> str:
        """Let no report come of the action that a drone is about to do; raise `BadInput` if none would ask."""
        run = self._run
        name, record = self._mission_of(drone)
        flight = record["flight"]
        trip = trip_of(record, flight)
        assert trip is not None
        if run.repeat_of(record) == "safe":
            raise BadInput(
                f"{drone} does {trip['action']}, which is safe to do once more: nothing would be asked;"
                " choose a drone with another action"
            )
        if name not in self._armed:
            self._armed[name] = run.kernel.spawn(
                self._forgets(name, drone, id_of(name, flight)), FLEET, f"{drone} will forget"
            )
        return f"{drone}: nothing will be heard of {trip['action']} of trip {quoted(trip['name'])}"

    def _mission_of(self, drone: str) -> tuple[str, Record]:
        for name in self._run.brain.under_way():
            record = self._run.record(name)
            flight = in_flight(record)
            if flight is not None and flight["drone"] == drone and aside(record) is None:
                return name, record
        raise BadInput(f"{drone} flies for no mission: that can happen to one that does")

    async def _forgets(self, name: str, drone: str, id: str) -> None:
        """Wait until a drone has done its job's action and forgotten it."""
        await self._run.link.ask("mishap", drone=drone, kind=UNCERTAIN, job=id)
        del self._armed[name]
        self._look_into(name, self._run.record(name))

    def hear(self, event: Event) -> None:
        """Called with each event: an action of the app's own is done here, and not by the drone."""
        name, kind = str(event.get("mission")), event["event"]
        if name in self._armed and kind in _OVER:
            self._armed.pop(name).cancel()
        elif name in self._armed and kind == "action.begun":
            kernel = self._run.kernel
            kernel.at(kernel.now, EventKind.FLIGHT, FLEET, partial(self._cut_short, name))

    def _cut_short(self, name: str) -> None:
        armed = self._armed.pop(name, None)
        if armed is not None:  # else it has ended at that very instant
            armed.cancel()
            self._look_into(name, self._run.record(name))
