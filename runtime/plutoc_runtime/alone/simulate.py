"""An app in virtual time, over drones that fly alone."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ..domain.airspace import Airspace
from ..domain.fleet_data import DroneData, FleetData
from ..flow.session import Listener, Outcome, Session
from ..time.virtual import VirtualTime
from .bound import Bound, see_through
from .ideal import IdealNavigation

if TYPE_CHECKING:
    from ..domain.app import App
    from ..domain.model import Mission
    from ..domain.trace import Event
    from .faults import Faults


def default_fleet(app: App) -> FleetData:
    """Return the fleet where there is no file: five drones on an empty plain."""
    kinds = [category.name for category in app.categories] * 5
    drones = [
        DroneData(id=f"cf{place}", category=kind, home=(float(place), 0.5, 0.0))
        for place, kind in enumerate(kinds[:5], 1)
    ]
    return FleetData(airspace=Airspace(), drones=drones)


def simulate(
    app: App,
    missions: Sequence[Mission[Any]],
    fleet: FleetData,
    *,
    seed: int,
    faults: Faults,
    until: float | None,
    on_event: Listener | None,
) -> Outcome:
    """Fly the missions until the last one has ended or a time is reached.

    Without such a time it is given up where missions set out again and again for nothing.
    """
    kernel, bound = VirtualTime(), Bound(missions)
    navigation = IdealNavigation(kernel, app, fleet, faults, seed)
    events: list[Event] = []

    def listen(event: Event) -> None:
        events.append(event)
        if on_event is not None:
            on_event(event)
        if until is None and (enough := bound.look(event)) is not None:
            kernel.crash(enough)

    session = Session(app, fleet, kernel, navigation, [listen])
    ended, given_up = see_through(session, kernel, missions, bound, until)
    return Outcome(
        duration=ended,
        missions=tuple(missions),
        drones=session.drones,
        flown={drone.id: drone.flown for drone in navigation.drones.values()},
        events=tuple(events),
        given_up=given_up,
    )
