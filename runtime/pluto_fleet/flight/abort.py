"""Aborting a trip by a gateway: its action may be done by the time that the drone is told.

So an action that is not safe to repeat is looked up first.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from plutoc_runtime.time.kernel import mission_key
from plutoc_runtime.trips.flight import Flight

from .live_engine import LiveEngine
from .reconcile import Outcome, doubt, hear_end, outcome_of

if TYPE_CHECKING:
    from plutoc_runtime.flow.mission import MissionState

    from ..jobs.job import CommandLink


class DeferredAbort:
    """Fails trips once the gateway has confirmed that their actions were not done."""

    def __init__(self, link: CommandLink) -> None:
        self._link = link

    def __call__(self, state: MissionState, flight: Flight, reason: str) -> None:
        """Fail the trip of an aborted flight, unless its action was done, or may have been."""
        state.core.kernel.spawn(
            self._fail_unless_done(state, flight, reason),
            mission_key(state.mission.index),
            f"{flight.id} is called off",
        )

    async def _fail_unless_done(self, state: MissionState, flight: Flight, reason: str) -> None:
        fleet_report = await self._link.fleet_report()
        if state.in_flight is not flight or state.task is None:
            return  # it has ended, or its mission was suspended
        entry = fleet_report.jobs.get(flight.id)
        what = outcome_of(entry, state.core.app.actions[flight.trip.action], begun=False)
        if what is Outcome.UNKNOWN:
            assert isinstance(state.supervisor, LiveEngine)
            state.supervisor.waits(state)
            doubt(state, flight)
        elif what is Outcome.FLIES_ON and entry is not None:
            hear_end(flight, self._link, entry)
        else:
            state.fail(flight, reason)
