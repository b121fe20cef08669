"""The seam: a running app as plain data, without input, output or a clock.

Whatever flies the app tells the brain what has happened and what time it is, and takes from it what
shall be done (`orders`) and what has happened (`events`). Arguments and results are numbers, texts, lists
and mappings, except for the app, the space and the hooks. Seconds since the app's start, metres.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, Protocol

from .domain.fleet_data import DroneData, FleetData
from .domain.model import AfterTrip
from .flow.engine import Session
from .flow.standing import drone_standing, mission_of, standing_of
from .orders import Order, Orders
from .time.told import AT_ONCE, HookRunner, ToldTime

if TYPE_CHECKING:
    from .domain.app import App
    from .domain.model import Point
    from .domain.trace import Event
    from .fleet.telemetry import KnownState
    from .flow.mission import MissionState
    from .time.kernel import Task

SEAM = (3, 0)
"""The first number changes when earlier data would be misread, the second when more is said."""


class Space(Protocol):
    """The map: where drones may be, and how they get there."""

    def problem(self, point: Point) -> str | None:
        """Return why no drone may be at a point, or None."""
        ...

    def route(self, start: Point, end: Point) -> Sequence[Point] | None:
        """Return the points to fly through, the end included and the start not; None: there is no way."""
        ...


class Brain:
    """One running app. It does nothing by itself and waits for nobody."""

    def __init__(
        self, app: App, fleet: Mapping[str, Any], *, space: Any, hooks: HookRunner | None = None
    ) -> None:
        """`fleet` has the `drones` (`id`, `category`, `home`), and perhaps `after_trip`, `max_airborne`.

        With `silent` in it nothing is kept for `events`. Without `hooks` they are called at once.
        """
        drones = [_drone(one, app) for one in fleet["drones"]]
        self._app, self._kernel = app, ToldTime(hooks, fleet.get("midnight", 0.0))
        self._orders = Orders(self._kernel, {drone.id: drone for drone in drones})
        self._events: list[Event] = []
        self._session = Session(
            app,
            FleetData(
                airspace=space,
                drones=drones,
                after_trip=AfterTrip(fleet.get("after_trip", "home")),
                max_airborne=fleet.get("max_airborne"),
            ),
            self._kernel,
            self._orders,
            () if fleet.get("silent") else (self._events.append,),
        )
        self._states: dict[str, MissionState] = {}
        self._whole: Task[float] | None = None

    def begin(self, missions: Sequence[Mapping[str, Any]], now: float) -> None:
        """Begin missions: each has `trips`, and perhaps `name`, `index` and `fields`."""
        self._kernel.call(now, AT_ONCE, partial(self._begin, missions))

    def _begin(self, missions: Sequence[Mapping[str, Any]]) -> None:
        first = len(self._states)
        begun = [mission_of(self._app, one, first + i) for i, one in enumerate(missions)]
        self._states.update((state.mission.name, state) for state in self._session.set_out(begun))
        if self._whole is None:
            self._whole = self._session.see_through_task()

    def tell(self, message: Mapping[str, Any], now: float) -> None:
        """Take over what has happened outside; what is unknown is ignored.

        `{"done": id, "value": …}` or `{"failed": id, "failure": …, "reason": …}` for an order,
        `{"telemetry": {drone: {"leg" or "at", "battery", "landed"}}}` for drones, `{"hook": number}`
        for a hook that took its time.
        """
        if "telemetry" in message:
            self._kernel.now = now
            for drone, told in message["telemetry"].items():
                if drone in self._orders.drones:
                    self._orders.drones[drone].take(told)
        match message:
            case {"done": order}:
                call = partial(self._orders.done, order, message.get("value"))
            case {"failed": order}:
                call = partial(self._orders.failed, order, message)
            case {"hook": number}:
                call = partial(self._kernel.hook_ended, number)
            case _:
                return
        self._kernel.call(now, AT_ONCE, call)

    def advance(self, now: float) -> None:
        """Let everything happen that is due, up to the first orders: take those, and call it again."""
        self._kernel.call(now, self._orders.pending)

    @property
    def due(self) -> float | None:
        """When `advance` must be called next; None: only something outside can make it go on."""
        return self._kernel.next_time()

    def orders(self) -> list[Order]:
        """Return what shall be done, and was not returned before."""
        return self._orders.take()

    def events(self) -> list[Event]:
        """Return what has happened, and was not returned before."""
        events = self._events[:]
        self._events.clear()
        return events

    def standing(self) -> Mapping[str, Any]:
        """Return where every mission and every drone stands."""
        return {
            "missions": {name: standing_of(self._app, one) for name, one in self._states.items()},
            "drones": {drone.id: drone_standing(drone) for drone in self._session.drones},
            "waiting": (
                self._session.core.queue.summary() if self._session.core.queue.waiting else ""
            ),
        }

    @property
    def over(self) -> float | None:
        """When the last mission ended, once all have and every drone has landed; None: not yet."""
        whole = self._whole
        return whole.result() if whole is not None and whole.is_set else None

    def telemetry(self, drone: str) -> KnownState:
        """Return what is known of a drone; it stays current."""
        return self._orders.drones[drone]

    def close(self) -> None:
        """End everything where it is; nothing may be called after that."""
        self._kernel.close()


def _drone(data: Mapping[str, Any], app: App) -> DroneData:
    x, y, *z = data["home"]
    category = data.get("category", app.categories[0].name)
    return DroneData(id=data["id"], category=category, home=(x, y, z[0] if z else 0.0))
