"""Looks at every drone ten times a second: silence, the permitted area, the battery, the ground."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from math import inf
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import Failure, FlightFailed
from plutoc_runtime.domain.text import duration, percent, place

from .coming_down import come_down
from .stray import strayed
from .vehicle import LAND, RISE

if TYPE_CHECKING:
    from plutoc_runtime.domain.airspace import Airspace

    from .vehicle import Member

EACH = 0.1
"""Seconds between two looks."""
SILENCE, ON_GROUND = 1.0, 3.0
"""Seconds after which a silent drone has lost its link: in the air, and on the ground."""
EMPTY, LOW_FOR = 0.03, 3.0
"""A battery is empty when it has had no more than this share in it for so many seconds."""
FALLEN = 1.0
"""Seconds on the ground in the midst of a flight after which it must have fallen."""
LATE = 0.3
"""Seconds by which a look may be late before the log says so: nobody watches meanwhile."""


class Watch:
    """All drones, for as long as the team flies."""

    def __init__(
        self,
        members: Sequence[Member],
        airspace: Airspace,
        say: Callable[[str], object],
        clock: Callable[[], float],
    ) -> None:
        self._members, self._airspace = members, airspace
        self._say, self._clock = say, clock
        self._low_since = {member.id: inf for member in members}
        self._fallen_since = {member.id: inf for member in members}
        self._landings: dict[str, asyncio.Task[None]] = {}

    def hear(self, late: float) -> None:
        """Look at all drones; `late`: seconds after the look was due."""
        if late > LATE:
            self._say(f"the gateway was kept from watching its drones for {duration(late)}")
        for member in self._members:
            self.look(member, late)

    def stop(self) -> list[asyncio.Task[None]]:
        """Bring nobody down any more; return what ends now."""
        landings = list(self._landings.values())
        for task in landings:
            task.cancel()
        return landings

    def look(self, member: Member, late: float) -> None:
        """Look at one drone; what it told while nobody could hear counts as told now."""
        seen = member.seen
        if not member.linked:
            return
        landed, busy = seen.landed, member.lane.doing
        if seen.silence > (ON_GROUND if landed and not busy else SILENCE) + late:
            member.lost(f"it has told nothing for {duration(seen.silence)}")
        elif landed:
            self._stands(member, busy)
        elif member.must_land:
            self._bring_down(member)
        else:
            self._flies(member)

    def _stands(self, member: Member, busy: str) -> None:
        where = place(member.seen.location)
        self._low_since[member.id] = inf
        if member.must_land:
            member.must_land = False
            self._say(f"{member.id} has landed at {where}")
        elif busy in ("", LAND, RISE):
            self._fallen_since[member.id] = inf
        elif self._lasts(self._fallen_since, member, FALLEN):
            why = f"{member.id} is on the ground at {where}: it fell, or was switched off"
            member.crashed(why)

    def _flies(self, member: Member) -> None:
        seen = member.seen
        self._fallen_since[member.id] = inf
        where = strayed(self._airspace, seen.location)
        if where is not None:
            why = f"{member.id} left the permitted area at {where}: it lands"
            member.must_come_down(FlightFailed(Failure.REFUSED, why))
        elif (blind := member.blind()) is not None:
            member.loses_its_place(blind)
        elif seen.battery_level > EMPTY:
            self._low_since[member.id] = inf
        elif self._lasts(self._low_since, member, LOW_FOR):
            left = percent(seen.battery_level)
            why = f"{member.id} has {left} in its battery: it lands at {place(seen.location)}"
            member.must_come_down(FlightFailed(Failure.BATTERY, why))

    def _lasts(self, since: dict[str, float], member: Member, seconds: float) -> bool:
        """Say whether something has been so for long enough; it is so now."""
        now = self._clock()
        since[member.id] = min(since[member.id], now)
        return now - since[member.id] >= seconds

    def _bring_down(self, member: Member) -> None:
        """See to it that a drone comes down, again and again until it has."""
        task = self._landings.get(member.id)
        if task is None or task.done():
            others = [other.seen.location for other in self._members if other is not member]
            self._landings[member.id] = asyncio.ensure_future(
                come_down(member, self._airspace, others)
            )
