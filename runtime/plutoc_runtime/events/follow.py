"""The built-in action `follow`: a drone stays within reach of what moves, and takes pictures of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ..domain.actions import PHOTO, Action, Parameter
from ..domain.errors import Failure, FlightFailed
from ..domain.keeper import put
from ..domain.quantities import Type
from ..domain.text import duration, quoted
from ..time.kernel import mission_key
from .company import track_of
from .tracks import Tracks

if TYPE_CHECKING:
    from ..flow.flight import Flight
    from ..flow.mission import MissionState

STEP = 0.5
"""Seconds from one look at where it is to the next."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FollowAction(Action):
    """Stays within reach of the trip's target for a time, and takes a picture each time that so much has passed."""

    async def act(self, state: MissionState, flight: Flight) -> None:
        """Follow it, and complete or fail the flight."""
        try:
            await self._follow(state, flight)
        except FlightFailed as error:
            state.fail(flight, str(error))
        else:
            state.complete(flight, None)

    async def _follow(self, state: MissionState, flight: Flight) -> None:
        core = state.core
        trip: Any = flight.trip
        kernel, key = core.kernel, mission_key(state.mission.index)
        tracks: Tracks = core.parts[Tracks]
        id = track_of(trip)
        ends = kernel.now + trip.parameters["for"]
        picture = kernel.now
        while True:
            now = kernel.now
            if now >= picture:
                photo = await core.orders.ask("act", flight.drone, action=PHOTO, parameters={})
                core.transitions.keep(state.mission, trip, photo)
                picture += trip.parameters["every"]
            if now >= ends:
                return
            track = None if id is None else tracks.known.get(id)
            if id is not None:
                if track is None or now - track.time > trip.lost_after:
                    since = duration(trip.lost_after)
                    raise FlightFailed(
                        Failure.ACTION, f"track {quoted(id)} has had no news for {since}"
                    )
                point = tracks.meeting(track, flight.flier, core.airspace.cruise_height)
                put(trip, target=point)
                await core.orders.ask("go", flight.drone, stops=[point])
            wait = min(picture, ends, now + STEP) - kernel.now
            if wait > 0.0:
                await kernel.sleep(wait, key=key)


async def _nothing(*_: object) -> None:
    """Stand for the hook of an action that the brain does itself."""


FOLLOW = FollowAction(
    name="follow",
    parameters=(
        Parameter(name="for", type=Type.TIME),
        Parameter(name="every", type=Type.TIME, default=1.0),
    ),
    repeat="safe",
    takes="for",
    hook=_nothing,
)
"""`follow(for: time, every: time)`."""
