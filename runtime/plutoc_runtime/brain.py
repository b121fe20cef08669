"""The seam: a running app as plain data, without input, output or a clock.

The caller tells the brain what has happened and what time it is, and takes from it what shall be done
(`orders`) and what has happened (`events`). Arguments and results are numbers, texts, lists and
mappings, except for the app, the space and the hooks. Seconds since the app's start, metres.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
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
from .flow.mission import Core
from .flow.restore import Recording, Restorer
from .flow.standing import drone_standing, mission_of, standing_of, whereabouts_of
from .hooks.plain_data import value_data
from .time.hours import Hours
from .time.kernel import FLEET
from .time.told import ONLY_WHAT_IS_READY, HookRunner, ToldTime
from .trips.flight import Limits
from .trips.transitions import Transitions

if TYPE_CHECKING:
    from .domain.airspace import Airspace
    from .domain.app import App
    from .domain.trace import Event
    from .flow.mission import MissionState
    from .time.kernel import Task

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
        With `recorded` in it, the events say all from which a later brain can go on; no drone is free
        before `go_on` has said how it is, and the brain must be told what is `durable`. With `silent`
        nothing is kept for `events`. Without `hooks` they are called at once.
        """
        charges = fleet.get("charges_at_home", True)
        app = moving(app, Motion(**fleet.get("motion", {})), charges=charges)
        self._app, recorded = app, fleet.get("recorded", False)
        of_day = Hours(fleet.get("began", 0.0), fleet.get("zone", "UTC"))
        self._kernel = kernel = ToldTime(hooks, of_day)
        kernel.drift = fleet.get("drift", 0.0)
        self._events: list[Event] = []
        self._states: dict[str, MissionState] = {}
        results = ResultStore()
        self._recording = Recording(app, self._states, results, self._events)
        hear = self._recording.hear if recorded else self._events.append
        trace = Trace(kernel, () if fleet.get("silent") else (hear,))
        self._orders = orders = Orders(kernel)
        status = DroneStatus.OFFLINE if recorded else DroneStatus.FREE
        drones = list[Drone]()
        for one in fleet["drones"]:
            drones.append(orders.drone_of(app, one, status, len(drones)))
        queue = Queue(kernel, Reach(app, space), drones, fleet.get("max_airborne"))
        after_trip = AfterTrip(fleet.get("after_trip", "next"))
        self._core = core = Core(
            app=app,
            kernel=kernel,
            airspace=space,
            orders=orders,
            trace=trace,
            results=results,
            transitions=Transitions(kernel, trace, results),
            queue=queue,
            fleet=Fleet(kernel, trace, orders, drones, queue, after_trip),
            limits=Limits(kernel),
            on_record=self._recording.on_record if recorded else None,
        )
        self._engine = engine = Engine(core, self._states)
        self._restorer = Restorer(engine)
        self._control = Control(engine, self._restorer)
        self._whole: Task[float] | None = None

    def begin(self, missions: Sequence[Mapping[str, Any]], now: float) -> None:
        """Begin missions: each has `trips`, and perhaps `name`, `index` and `fields`."""
        self._kernel.call(now, ONLY_WHAT_IS_READY, self._begin, missions)

    def _begin(self, missions: Sequence[Mapping[str, Any]]) -> None:
        first = len(self._states)
        self._engine.start(
            [mission_of(self._app, one, first + i) for i, one in enumerate(missions)]
        )
        self._see_through()

    def _see_through(self) -> None:
        if self._whole is None or self._whole.is_set:
            self._whole = self._kernel.spawn(self._engine.see_through(), FLEET, "the whole")

    def go_on(self, standing: Mapping[str, Any], drones: Mapping[str, Any], now: float) -> None:
        """Resume missions from their records, after any end, or after one was paused.

        `standing` has the `missions` by name, as in `standing()`; a mission may be `suspended`, a flight
        may have a `report` of its end, and be `heard`: its graph has gone on from that end. Of the
        `results` so far a mission's evaluator has seen those before `judged`; `first_result` is the
        number of the first. Further how many trips each drone has `flown`, which drones are `retired`,
        and why some are `lost`. `drones` are the reports of those that no mission may need: `reached`,
        `landed`, `carrying`, `problems`.
        """
        self._kernel.call(now, ONLY_WHAT_IS_READY, self._go_on, (standing, drones))

    def _go_on(self, told: tuple[Mapping[str, Any], Mapping[str, Any]]) -> None:
        (standing, drones), fleet = told, self._core.fleet
        for drone in fleet.drones:
            if drone.id in standing.get("retired", ()):
                fleet.retired.add(drone)
            if drone.id in standing.get("lost", ()):
                fleet.lost_before[drone] = str(standing["lost"][drone.id])
        self._restorer.go_on(standing, drones)
        self._see_through()

    def command(self, request: Mapping[str, Any], now: float) -> str:
        """Do what a person wants; raise `BadInput` with the reason why it cannot be done.

        `{"command": "pause" or "cancel", "mission": …}`: take it out of its graph, to `go_on` later, or
        never; `skip` a trip that is not the next one; `prioritise` one; `change-trips`, all but the first,
        to other `trips`; `retire` or `bring-back` a drone;
        `join`, a new `drone` with its `category` and `home`, which is free when `go_on` says how it is;
        `probe` whether a flight's action was done: the answer is an order to note what was `probed`.
        """
        return self._kernel.call(now, ONLY_WHAT_IS_READY, self._control.perform, request)

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
            self._kernel.call(now, ONLY_WHAT_IS_READY, self._recording.durable, message)
        elif "drift" in message:
            self._kernel.call(now, ONLY_WHAT_IS_READY, self._kernel.drifted, message["drift"])

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

    def standing(self) -> Mapping[str, Any]:
        """Return where every mission and every drone stands, and all results."""
        core = self._core
        return {
            "missions": {name: standing_of(self._app, one) for name, one in self._states.items()},
            "drones": self.drones(),
            "results": [
                [mission.name, trip and trip.name, round_, attempt, value_data(value)]
                for mission, trip, round_, attempt, value in core.results.results
            ],
            "waiting": core.queue.summary() if core.queue.waiting else "",
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
        whole = self._whole
        return whole.result() if whole is not None and whole.is_set else None

    def whereabouts(self) -> Mapping[str, Any]:
        """Return where each mission that has not ended is in its graph.

        `lives`: whether it is in its graph at all; `block`: the declaration of the block at which it
        waits; its `drone`, whether that is just `allocated`, or `flies`; `until` when it is delayed.
        """
        living = {name: one for name, one in self._states.items() if not one.ended}
        return {name: whereabouts_of(one, self._app.flow) for name, one in living.items()}

    def close(self) -> None:
        """End everything where it is; nothing may be called after that."""
        self._kernel.close()
