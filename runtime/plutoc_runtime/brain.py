"""The seam: a running app as plain data, without input, output or a clock.

The caller tells the brain what has happened and what time it is, and takes from it what shall be done
(`orders`) and what has happened (`events`). Arguments and results are numbers, texts, lists and
mappings, except for the app, the space and the hooks. Seconds since the app's start, metres.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from .domain.app import SEAM, about, moving
from .domain.errors import BadInput
from .domain.guard import put_guard
from .domain.model import AfterTrip, Drone, ResultStore
from .domain.motion import Motion
from .domain.status import DroneStatus
from .domain.trace import Trace
from .fleet.fleet import Fleet
from .fleet.orders import Order, Orders
from .fleet.queue import Queue
from .fleet.reach import Reach
from .flow.control import Control
from .flow.engine import Engine
from .flow.flight import Limits
from .flow.mission import Core
from .flow.record import (
    changed_rows,
    drone_standing,
    result_row,
    standing_of,
    whereabouts_of,
)
from .flow.transitions import Changes, Transitions
from .time.hours import Hours
from .time.kernel import Future
from .time.told import ONLY_WHAT_IS_READY, HookRunner, ToldTime

if TYPE_CHECKING:
    from .domain.airspace import Airspace
    from .domain.app import App
    from .domain.trace import Event, Row
    from .flow.mission import MissionState

__all__ = ["SEAM", "BadInput", "Brain", "about", "put_guard"]


class Brain:
    """One running app. It does nothing by itself and never blocks."""

    def __init__(
        self,
        app: App,
        fleet: Mapping[str, Any],
        *,
        space: Airspace,
        hooks: HookRunner | None = None,
    ) -> None:
        """`fleet` has the `drones` (`id`, `category`, `home`), and perhaps `after_trip`, `max_airborne`.

        `motion` is how they move, `charges_at_home` whether they are charged there; `began` is when the app has
        started, in seconds since 1970, `zone` says which hour that is, and `drift` is as `tell` takes it.
        With `recorded` in it, `rows` says all from which a later brain can go on; no drone is free
        before `go_on` has said how it is, and the brain must be told what is `durable`. With `silent`
        nothing is kept for `events`. Without `hooks` they are called at once.
        """
        charges = fleet.get("charges_at_home", True)
        app = moving(app, Motion(**fleet.get("motion", {})), charges=charges)
        recorded = fleet.get("recorded", False)
        self._app = app
        of_day = Hours(fleet.get("began", 0.0), fleet.get("zone", "UTC"))
        self._kernel = kernel = ToldTime(hooks, of_day)
        kernel.drift = fleet.get("drift", 0.0)
        self._events: list[Event] = []
        self._states: dict[str, MissionState] = {}
        results = ResultStore()
        self._disk = Disk()
        self._changes = changes = Changes(self._states, kept=recorded)
        trace = Trace(kernel, () if fleet.get("silent") else (self._hear,))
        self._orders = orders = Orders(kernel)
        status = DroneStatus.OFFLINE if recorded else DroneStatus.FREE
        drones = list[Drone]()
        for one in fleet["drones"]:
            drones.append(orders.drone_of(app, one, status, len(drones)))
        homes = [drone.home for drone in drones]
        queue = Queue(kernel, Reach(app, space, homes), drones, fleet.get("max_airborne"))
        after_trip = AfterTrip(fleet.get("after_trip", "next"))
        self._core = core = Core(
            app=app,
            kernel=kernel,
            airspace=space,
            orders=orders,
            trace=trace,
            results=results,
            transitions=Transitions(app, kernel, trace, results, changes),
            queue=queue,
            fleet=Fleet(kernel, trace, orders, drones, queue, after_trip),
            limits=Limits(kernel),
            changes=changes,
            on_record=self._disk.on_record if recorded else None,
        )
        core.fleet.changed = changes.drone
        self._engine = engine = Engine(core, self._states)
        self._parts = [make(engine) for make in app.parts]
        core.parts.update((type(part), part) for part in self._parts)
        self._control = Control(engine)

    def begin(self, missions: Sequence[Mapping[str, Any]], now: float) -> None:
        """Begin missions: each has `trips`, and perhaps `name`, `index` and `fields`."""
        self._kernel.call(now, ONLY_WHAT_IS_READY, self._engine.start, missions)

    def restore(self, standing: Mapping[str, Any], now: float) -> None:
        """Have missions, drones and results as their rows say, after any end: as in `standing()`.

        Every mission is out of its graph: what came of its flight can be found out, and told by commands, until
        `go_on`. One that does not fit the app as it is now has `unfit`, the fields without which it cannot be.
        """
        self._kernel.call(now, ONLY_WHAT_IS_READY, self._restore, standing)

    def _restore(self, standing: Mapping[str, Any]) -> None:
        self._engine.restore(standing)
        for part in self._parts:
            part.restore(standing)

    def go_on(self, missions: Mapping[str, Any], drones: Mapping[str, Any], now: float) -> None:
        """Let missions that are out of their graphs go on, by their names.

        Each may have the `report` of how its flight ended; without one, a flight that was not settled flies
        on. `drones` are the reports of those that no mission may need: `reached`, `landed`, `carrying`, `problems`.
        """
        self._kernel.call(now, ONLY_WHAT_IS_READY, partial(self._go_on, missions), drones)

    def _go_on(self, missions: Mapping[str, Any], drones: Mapping[str, Any]) -> None:
        self._engine.go_on(missions, drones)
        for part in self._parts:
            part.go_on()

    def command(self, request: Mapping[str, Any], now: float) -> None:
        """Do what a person wants, or what was found out; raise `BadInput` with the reason why it cannot be done.

        `{"command": "leave" or "cancel", "mission": …}`: take it out of its graph, to `go_on` later, or never.
        Of one that has left: `pause`, `resume`; `doubt` whether its action was done, with a `reason`; `hold`, as it
        does not fit the app; `decide`, with a person's `answer`; `settle` its flight: `done` with a `value`,
        a `failure` with a `reason`, or neither; `probe` whether its action was done: the answer is an order
        to note what was `probed`. `skip` a `trip` that is not the next one; `prioritise` one; `change-trips`, all
        but the first, to other `trips`; `acts-beside`: where a `flight` does its action.
        `retire` or `bring-back` a drone; `join`, a new `drone` with its `category` and `home`, which is
        free when `go_on` says how it is.
        """
        self._kernel.call(now, ONLY_WHAT_IS_READY, self._perform, request)

    def _perform(self, request: Mapping[str, Any]) -> None:
        for part in self._parts:
            if request["command"] in part.commands:
                part.commands[request["command"]](request)
                return
        self._control.perform(request)

    def tell(self, message: Mapping[str, Any], now: float) -> None:
        """Take over what has happened outside; what is unknown is ignored.

        `{"done": id, "value": …}` or `{"failed": id, "failure": …, "reason": …}` for an order,
        `{"telemetry": {drone: {"legs" or "at", "battery", "landed"}}}` for drones, `{"hook": number}`
        for a hook that took its time, `{"durable": count}` for events that are on the disk, `{"drift":
        seconds}` when the clock of the hours has gone on so much more than `now` since the app began.
        """
        if "telemetry" in message:
            self._kernel.now = now
            for drone, told in message["telemetry"].items():
                if drone in self._orders.drones:
                    self._orders.drones[drone].take(told)
        if "done" in message or "failed" in message:
            self._kernel.call(now, ONLY_WHAT_IS_READY, self._orders.answered, message)
        elif "hook" in message:
            self._kernel.call(now, ONLY_WHAT_IS_READY, self._kernel.hook_ended, message)
        elif "durable" in message:
            self._kernel.call(now, ONLY_WHAT_IS_READY, self._disk.durable, message["durable"])
        elif "drift" in message:
            self._kernel.call(now, ONLY_WHAT_IS_READY, self._kernel.drifted, message["drift"])
        for part in self._parts:
            self._kernel.call(now, ONLY_WHAT_IS_READY, part.tell, message)

    def advance(self, now: float) -> None:
        """Let everything happen that is due, up to the first orders: take those, and call it again."""
        self._kernel.call(now, self._orders.pending, lambda _: None)

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

    def rows(self) -> list[Row]:
        """Return the rows that have changed since they were asked for, if this run is recorded.

        Ask between two instants: then they fit to the events.
        """
        core = self._core
        rows = changed_rows(self._app, self._changes, self._states, core.results, core.fleet)
        for part in self._parts:
            rows += part.rows()
        return rows

    def mission(self, name: str) -> Mapping[str, Any]:
        """Return the row of a mission with those of its trips: `todo`, `done`, `gone`."""
        return standing_of(self._app, self._states[name])

    def under_way(self) -> tuple[str, ...]:
        """Return the names of the missions that have not ended, in their order."""
        living = [state.mission for state in self._states.values() if not state.ended]
        return tuple(one.name for one in sorted(living, key=lambda mission: mission.index))

    def standing(self) -> Mapping[str, Any]:
        """Return all rows: where every mission and every drone stands, and all results."""
        core = self._core
        return {
            "missions": {name: standing_of(self._app, one) for name, one in self._states.items()},
            "drones": self.drones(),
            "results": [result_row(result) for result in core.results.results],
            "waiting": core.queue.summary() if core.queue.waiting else "",
            **{table: rows for part in self._parts for table, rows in part.standing().items()},
        }

    def drones(self) -> Mapping[str, Any]:
        """Return where every drone stands; one that is `aside` is too low for every trip that waits."""
        fleet = self._core.fleet
        low = {*fleet.queue.too_low()}
        return {one.id: drone_standing(one, fleet, one in low) for one in fleet.drones}

    @property
    def living(self) -> int:
        """How many missions are on their way through their graphs, and not waiting for others."""
        return self._engine.living

    @property
    def over(self) -> float | None:
        """When the last mission ended, once all have and every drone has landed; None: not yet."""
        return None if self._core.fleet.errands else self._engine.ended_at

    def whereabouts(self) -> Mapping[str, Any]:
        """Return where each mission that has not ended is in its graph.

        `lives`: whether it is in its graph at all; `block`: the name of the block at which it waits, several
        in a fork; its `drone`, whether that is just `allocated`, or `flies`; `until` when it is delayed.
        """
        states = self._states.items()
        return {name: whereabouts_of(state) for name, state in states if not state.ended}

    def _hear(self, event: Event) -> None:
        self._disk.said += 1
        self._events.append(event)

    def close(self) -> None:
        """End everything where it is; nothing may be called after that."""
        self._kernel.close()


class Disk:
    """How many events there were, and how many of them are durable."""

    def __init__(self) -> None:
        self.said = 0
        self._durable = 0
        self._waiting: deque[tuple[int, Future[None]]] = deque()

    def on_record(self) -> Future[None]:
        """Return what is set once everything up to now is durable."""
        durable: Future[None] = Future()
        if self._durable < self.said:
            self._waiting.append((self.said, durable))
        else:
            durable.set(None)
        return durable

    def durable(self, count: int) -> None:
        """Called when so many events are durable."""
        self._durable = max(self._durable, count)
        while self._waiting and self._waiting[0][0] <= self._durable:
            self._waiting.popleft()[1].set(None)
