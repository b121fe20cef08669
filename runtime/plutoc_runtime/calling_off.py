"""Failing the trip that flies now: its limit is over, or a hook wants it so.

Where the drones are elsewhere, its action may be done by the time that they hear of it. So an action
that must not be repeated is looked up first: at one instant the trip's own end wins.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from .flight import Flight, fail
from .interruption import Fate, doubt, fate, hear_end
from .kernel import mission_key

if TYPE_CHECKING:
    from .navigation import Commanding
    from .state import State


def abort(state: State, reason: str) -> None:
    """Fail the trip that flies now, now or as soon as it is known that its action was not done."""
    flight = state.in_flight
    if flight is None or flight.called_off:
        return
    flight.break_off()
    core = state.core
    if (
        core.link is None
        or flight.action is None
        or core.app.actions[flight.action].repeat == "safe"
    ):
        fail(state, flight, reason)
        return
    core.kernel.spawn(
        _fail_unless_done(state, flight, reason, core.link),
        mission_key(state.mission.index),
        f"{flight.id} is called off",
    )


async def _fail_unless_done(state: State, flight: Flight, reason: str, link: Commanding) -> None:
    roll = await link.call()
    if state.in_flight is not flight or state.task is None:
        return  # it has ended, or somebody else sees to it
    core, entry = state.core, roll.jobs.get(flight.id)
    what = fate(entry, core.app.actions[flight.trip.action], begun=False)
    if what is Fate.UNKNOWN:
        state.wait_for_a_person()
        doubt(state, flight)
    elif what is Fate.FLIES_ON and entry is not None:
        hear_end(flight, link, entry)
    else:
        fail(state, flight, reason)


def abort_now(state: State, reason: str) -> None:
    """Fail the trip that flies now: its mission has ended, and nobody will try it again."""
    flight = state.in_flight
    if flight is not None:
        flight.break_off()
        fail(state, flight, reason)
