"""Finding out the outcome of an interrupted flight, and resuming its mission accordingly.

A flight is interrupted when the app stops or dies, or when the user suspends its mission. Then the ledger
and the drone are queried; what they cannot tell, only the user can.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from enum import Enum
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.actions import PICK, RELEASE
from plutoc_runtime.domain.errors import ANY_ERROR, Cancelled
from plutoc_runtime.domain.status import STANDBY, UNEXECUTED, Status
from plutoc_runtime.hooks.calls import trace_of
from plutoc_runtime.trips.flight import Flight

from ..jobs.reports import Entry, JobState, reported_result
from . import interventions
from .live_fleet import live_fleet

if TYPE_CHECKING:
    from plutoc_runtime.domain.actions import Action
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.flow.mission import Core, MissionState

    from ..jobs.job import CommandLink
    from .live_engine import LiveEngine


class Outcome(Enum):
    """The outcome of an interrupted flight."""

    FLIES_ON = "flies on"  # or has ended, and its report is still available
    NOT_DONE = "again"  # its action was not done: it counts as no attempt
    DONE = "done"  # its action was done, according to the app's own probe
    UNKNOWN = "unknown"


def outcome_of(entry: Entry | None, action: Action, begun: bool) -> Outcome:
    """Return the outcome of a flight; `begun`: the app's own action had begun when it ended."""
    repeatable = action.repeat == "safe"
    if entry is not None and entry.flies:
        return Outcome.FLIES_ON
    if begun:
        return Outcome.NOT_DONE if repeatable else Outcome.UNKNOWN
    if entry is None or entry.state is JobState.BROKEN_OFF:
        return Outcome.NOT_DONE
    if entry.state is JobState.BEGUN:
        return Outcome.NOT_DONE if repeatable else Outcome.UNKNOWN
    return Outcome.FLIES_ON


async def find_outcome(core: Core, flight: Flight, entry: Entry | None, begun: bool) -> Outcome:
    """Return the outcome of a flight, if needed with the app's own probe."""
    action = core.app.actions[flight.trip.action]
    what = outcome_of(entry, action, begun)
    probe = probe_of(core.app, action) if what is Outcome.UNKNOWN else None
    if probe is None:
        return what
    try:
        answer = await core.kernel.call_hook(probe, flight.flier, flight.trip)
    except (Cancelled, GeneratorExit, KeyboardInterrupt):
        raise
    except ANY_ERROR as error:  # it cannot tell: the user must
        core.log(trace_of(error), flight.mission.name)
        return what
    return _PROBED[answer] if type(answer) is bool else what


_PROBED = {True: Outcome.DONE, False: Outcome.NOT_DONE}


def probe_of(app: App, action: Action) -> Callable[..., Any] | None:
    """Return the hook that can tell whether an action was done: `pollinate` has `pollinate_done`."""
    name, hook = f"{action.name}_done", action.hook
    if hook is None or name in app.actions or name in app.evaluators:
        return None  # something else has this name
    return getattr(sys.modules.get(hook.__module__), name, None)


def fly_on(state: MissionState, flight: Flight, link: CommandLink, entry: Entry) -> None:
    """Continue a flight that was not interrupted after all; if it has ended, report that now."""
    state.goes_on = True
    state.mission.status = Status.RUNNING
    live_fleet(state.core).flies_on(flight.flier)
    hear_end(flight, link, entry)


def hear_end(flight: Flight, link: CommandLink, entry: Entry) -> None:
    """Register for the end of a flight; if it has ended, report it at once, before any time-out."""
    if entry.flies:
        link.attach(flight.id, flight.report)
    else:
        flight.report(reported_result(entry))


def fly_again(state: MissionState, flight: Flight, link: CommandLink) -> None:
    """Reset an interrupted trip: it has not been flown."""
    link.forget(flight.id)  # it is to be flown, even if its id is known already
    state.flight, state.goes_on, state.interrupted = None, False, True
    interventions.interrupt(state.core, state.mission, flight.trip)


def was_done(state: MissionState, flight: Flight) -> None:
    """Complete an interrupted trip whose action was done; its result is unknown."""
    state.record_done(flight, None)
    flight.set(state.mission.status)
    state.goes_on = True


def doubt(state: MissionState, flight: Flight) -> None:
    """Suspend the mission: it is unknown whether the action was done. A drone that may have the item waits."""
    trip, drone = flight.trip, flight.flier
    interventions.doubt(
        state.core,
        state.mission,
        trip,
        drone.id,
        f"was {trip.action} of trip {trip.name} done by {drone.id}? It could not be seen",
    )
    if trip.action in (PICK, RELEASE):
        state.keep_carrier(drone)


def settle_doubt(state: MissionState, engine: LiveEngine, link: CommandLink, done: bool) -> None:
    """Resume the mission: the user has said whether the action was done."""
    flight = state.flight
    if flight is None:
        raise RuntimeError(f"nothing is in doubt about mission {state.mission.name}")
    kept = flight.trip.action in (PICK, RELEASE)
    if done:
        was_done(state, flight)
    else:
        fly_again(state, flight, link)
    if kept and state.carrier is None:
        state.core.fleet.recover(flight.flier)
    engine.resume(state, resume_status(state))


def resume_status(state: MissionState) -> Status:
    """Return the status with which an interrupted mission resumes."""
    return STANDBY if state.mission.attempts or state.interrupted else UNEXECUTED
