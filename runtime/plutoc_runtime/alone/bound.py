"""A simulation that nothing bounds ends all the same: a graph may try for ever what can never succeed.

Flights are counted and not hours: a plan may well last for months.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ..domain.errors import BadInput
from ..domain.model import Mission
from ..domain.text import counted, duration, quoted
from ..domain.trace import Event
from ..time.virtual import Stuck, VirtualTime

if TYPE_CHECKING:
    from ..flow.session import Session

FLIGHTS = 1_000
"""So many flights a planned trip, in one planned round of its mission, and no more."""
IDLE = 366 * 86_400.0
"""Seconds for which nothing at all sets out."""


MORE = "to fly on, say how long with --until, such as --until 2h"


class Enough(Exception):
    """The simulation is given up; the message says why."""


class Bound:
    """Counts the flights of each mission, and says when it is enough."""

    def __init__(self, missions: Sequence[Mission[Any]]) -> None:
        self._most = {one.name: FLIGHTS * max(1, len(one.trips)) for one in missions}
        self._flights = dict.fromkeys(self._most, 0)
        self._rounds = {one.name: getattr(one, "repeat", 0) for one in missions}
        """How many are planned; a hook may ask for more, again and again."""
        self.last = 0.0
        """When the last flight set out, or is to do so after a delay."""

    def look(self, event: Event) -> Enough | None:
        """Hear of an event; return why there is no end to be expected, once there is none."""
        what = event["event"]
        if what == "trip.launched":
            name = str(event["mission"])
            self.last = max(self.last, float(str(event["t"])))
            self._flights[name] = flights = self._flights[name] + 1
            if flights >= self._most[name]:
                trips = counted(self._most[name] // FLIGHTS, "trip")
                return Enough(
                    f"mission {quoted(name)} has set out {flights} times for {trips}, and nothing"
                    f" ends that; {MORE}"
                )
        elif what == "trip.delayed":
            self.last = max(self.last, float(str(event["until"])))
        elif what == "mission.repeated":
            name = str(event["mission"])
            if int(str(event["round"])) <= self._rounds[name]:
                self._flights[name] = 0
        return None

    def idle(self) -> str:
        """Return what is said where nothing has set out for too long."""
        return f"nothing has set out for {IDLE / 86_400:.0f} days, and missions are not at their end; {MORE}"


def see_through(
    session: Session,
    kernel: VirtualTime,
    missions: Sequence[Mission[Any]],
    bound: Bound,
    until: float | None,
) -> tuple[float, str]:
    """Fly the missions until the last one has ended or a time is reached.

    Return when that was, and why it was given up, if it was: without such a time a bound holds.
    """
    over = session.start(missions)
    last = bound.last + IDLE if until is None else until
    try:
        while not kernel.run(over, last) and until is None:
            if bound.last + IDLE <= last:
                raise Enough(bound.idle())
            last = bound.last + IDLE
        return (over.result() if over.is_set else kernel.now), ""
    except Enough as enough:
        return kernel.now, str(enough)
    except Stuck:
        queue, name = session.core.queue, session.core.app.name
        if not queue.waiting:
            raise
        raise BadInput(
            f"{name}: the simulation stops at {duration(kernel.now)}: missions wait for ever, "
            f"because the policy gives them none of the drones ({queue.standing()})"
        ) from None
    finally:
        kernel.close()
