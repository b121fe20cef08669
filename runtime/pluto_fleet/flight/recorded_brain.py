"""The durability layer of a flight: what a brain says is on the disk before it has any effect outside.

An order to fly waits until its launch is on the disk; orders that bring drones down do not.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any

from ..jobs.flown import BESIDE, FLEW
from ..jobs.reports import result_data
from ..journal.facts import TRACKED
from ..journal.recorder import Recorder, Sink
from ..shared.domain.errors import Failure, FlightFailed
from ..shared.domain.status import Status
from ..shared.events.declared import CompanyDeclared
from ..shared.flow.record import fleet_data, update
from ..shared.time.hours import Hours
from ..shared.time.kernel import FLEET, Kernel
from .driver import Driver
from .mission_status import aside, in_order
from .outcome import drones_of
from .reconcile import Outcome, id_of, outcome_of, trip_of
from .tracked import TrackedObjects

if TYPE_CHECKING:
    from ..app import App
    from ..files.fleet import FleetFile
    from ..jobs.flown import Flown
    from ..jobs.link import Link, Message, Order
    from ..journal.standing import Record, Standing
    from ..process.wall_clock import WallClock
    from ..shared.domain.model import Drone, Mission
    from ..shared.domain.trace import Event
    from ..shared.time.told import HookRunner

Listener = Callable[["Event"], object]


class RecordedBrain:
    """A brain whose events are durable before they have any effect outside."""

    def __init__(
        self,
        app: App,
        fleet: FleetFile,
        kernel: Kernel,
        link: Link,
        sink: Sink,
        records: Standing,
        *,
        listeners: Sequence[Listener] = (),
        watcher: Listener | None = None,
        hooks: HookRunner | None = None,
        clock: WallClock | None = None,
        charges: bool = True,
    ) -> None:
        """`watcher` is called with an event only when it is durable, `listeners` at once.

        By `clock` it is which hour it is; without one the hours are the fleet's. `charges`: whether drones
        may have more in their batteries than they say now.
        """
        self.app, self.fleet, self.kernel, self.link = app, fleet, kernel, link
        self.clock = {} if clock is None else clock.data
        data = {**fleet_data(fleet), "charges_at_home": charges, "recorded": True, **self.clock}
        self.hours = Hours(data["began"], data["zone"])
        self.brain = app.new_brain(data, space=fleet.airspace, hooks=hooks)
        self.recorder = Recorder(kernel, sink, records, self.brain.rows)
        self.tracked = TrackedObjects()
        """What moves beside the drones."""
        self.told_to: dict[str, str] = {}
        """What each drone was ordered last: `fly`, `land`, `home` or `recover`."""
        self.to_land: set[str] = set()
        """The drones that were ordered to land where they are; who looks at them takes out those that fly again."""
        self._listeners, self._watcher = tuple(listeners), watcher
        keys = {drone.id: FLEET + 1 + index for index, drone in enumerate(fleet.drones)}
        self._keys = keys
        self.driver = Driver(
            kernel, self.brain, obey=self._obey, motions=self._news, hear=self._hear
        )
        link.hear = self.told
        self.driver.pumped = self.look_for_the_end
        self._seen: dict[str, tuple[object, ...]] = {}
        """The telemetry that the brain was told last, by drone."""
        self._heard = 0
        self._waited_for = ["action.begun", "event.raised"]
        """All that a brain waits for until it is durable."""
        if any(isinstance(part, CompanyDeclared) for part in app.parts):
            self._waited_for.append("trip.launched")
        """How many events the brain has said."""
        self._held: dict[str, dict[str, Any]] = {}
        """The flights that wait for the journal, by drone."""
        self.patient = False
        """Whether the flight goes on while missions wait for the user's decision."""
        self.is_set_out = False
        """Whether the brain has its missions."""
        self.probed: Callable[[str, bool | None], object] = _ignore
        """Called with a flight, and what the app's hook says: whether its action was done."""
        self.doubted: Callable[[str, str], object] = _ignore
        """Called with a mission and its flight that was called off, and whose action may be done."""

    @property
    def records(self) -> Standing:
        """Where everything stands, as of the last instant that is over."""
        return self.recorder.standing

    def record(self, mission: str) -> Record:
        """Return where a mission stands now, as its row says."""
        return dict(self.brain.mission(mission))

    def command(self, command: str, **request: Any) -> None:
        """Have the brain carry out a command; raise `BadInput` if it cannot be done."""
        told = {"command": command, **request}
        self.driver.call(partial(self.app.perform, self.brain, told))

    @property
    def missions(self) -> tuple[Mission[Any], ...]:
        """All missions as they stand, also those that ended in earlier runs; none before they are known."""
        return self._as_missions() if self.is_set_out else ()

    def _as_missions(self) -> tuple[Mission[Any], ...]:
        missions = []
        for name, record in in_order(self.records):
            mission = self.app.mission(name=name, trips=[], index=record["index"])
            with suppress(
                KeyError, TypeError, ValueError, AttributeError
            ):  # it may not fit the app any more
                update(self.app, mission, record)
            mission.status, mission.reason = Status(record["status"]), record["reason"]
            if (waits := aside(record)) is not None:
                mission.status, mission.reason = waits
            missions.append(mission)
        return tuple(missions)

    @property
    def drones(self) -> tuple[Drone, ...]:
        """The drones as they stand."""
        return drones_of(self.app, self.fleet, self.brain.drones(), self.link.telemetry)

    def join(self, fleet: FleetFile, entry: Mapping[str, object]) -> None:
        """Go on with a fleet that has one more drone, the last; `entry` is that as it was given."""
        drone = fleet.drones[-1]
        self._keys[drone.id] = FLEET + len(fleet.drones)
        self.recorder.fact("joined", [*self.records.joined, dict(entry)])
        self.note("drone.joined", drone=drone.id, entry=entry)
        self.command("join", drone=drone.id, category=drone.category, home=drone.home)
        self.fleet = fleet

    def halt(self) -> None:
        """Let the brain do nothing more: a later run goes on from the records."""
        self.driver.halt()
        self.brain.close()
        self._held.clear()

    def look_for_the_end(self) -> None:
        """Called when missions may have ended."""

    # What happens

    def note(self, event: str, **facts: object) -> None:
        """Record an event of this run that the brain does not know."""
        self.take({"event": event, **facts})

    def take(self, event: Event) -> None:
        """Record such an event, given as a mapping."""
        self._take({"t": round(self.kernel.now, 6), **event})

    def told(self, message: Message) -> None:
        """Called with what the gateway tells."""
        if "flown" in message:
            self.flown(message["flown"])
            return
        if "tracks" in message:
            self._track(message["tracks"])
        self.driver.tell(message)

    def _track(self, reports: Mapping[str, Any]) -> None:
        """Record where what moves is: nothing follows from it but what the brain says."""
        now = self.kernel.now
        if news := self.tracked.take(reports, round(now, 3)):
            # to the same digits as all else, or time would go back to the next event
            self.recorder.measure({"t": round(now, 6), "event": TRACKED, "tracks": news})

    def flown(self, command: Flown) -> None:
        """Record how a command went that a drone has flown: nothing follows from it."""
        if command["what"] == BESIDE:
            facts = {name: command[name] for name in ("flight", "target", "at")}
            self.command("acts-beside", **facts)
            return
        self.recorder.measure({"t": round(self.kernel.now, 6), "event": FLEW, **command})

    def interrupted(self, mission: str, flight: Record) -> None:
        """Take back a flight whose action was not done: its trip is flown again, under the same id."""
        self._forget(id_of(mission, flight))
        self.command("settle", mission=mission)

    def _hear(self, event: Event) -> None:
        self._heard += 1
        self._take(event)
        if event["event"] in self._waited_for:
            self.recorder.when_durable(partial(self._tell_durable, self._heard))

    def hook_ended(self, number: int) -> None:
        """Called within the kernel when a hook that took its time has ended."""
        self.driver.tell({"hook": number})

    def _tell_durable(self, number: int) -> None:
        self.driver.tell({"durable": number})

    def _take(self, event: Event) -> None:
        self.recorder.take(event)
        if event["event"] in ("trip.completed", "trip.failed", "trip.handed_over"):
            self.recorder.when_durable(partial(self._forget, self._flight_before(event)))
        for listener in self._listeners:
            listener(event)
        if self._watcher is not None:
            self.recorder.when_durable(partial(self._watcher, event))

    # What the brain orders

    def _obey(self, order: Order) -> None:
        """Carry out an order; a flight only once its launch is durable."""
        drone = order["drone"]
        if order["do"] not in _BESIDE:
            self.told_to[drone] = order["do"]
        if order["do"] == "land":
            self.to_land.add(drone)
        match order["do"]:
            case "fly":
                self._held[drone] = waits = dict(order)
                self.recorder.when_durable(partial(self._let_fly, waits))
            case "redirect" if drone in self._held:
                self._held[drone].update(stops=order["stops"])
            case "break_off":
                held = self._held.pop(drone, None)
                self.link.send(order)
                if order.get("settle") is not None:
                    self.kernel.spawn(
                        self._settle(order, held is not None),
                        FLEET,
                        f"{order['flight']} is called off",
                    )
            case "probed":
                self.probed(order["flight"], order["value"])
            case _:
                self.link.send(order)

    def _let_fly(self, order: Order) -> None:
        if self._held.get(order["drone"]) is order:
            del self._held[order["drone"]]
            self.link.send(order)

    async def _settle(self, order: Order, was_held: bool) -> None:
        """Report what came of a flight that was called off: its action may be done by now."""
        number, id = order["settle"], order["flight"]
        entry = None if was_held else (await self.link.fleet_report()).jobs.get(id)
        mission = id.rsplit("/", 3)[0]
        what = outcome_of(entry, self.repeat_of(self.record(mission)), begun=False)
        if what is Outcome.UNKNOWN:
            self.doubted(mission, id)
        elif what is Outcome.FLIES_ON:
            self.link.send({"do": "attach", "id": number, "flight": id})
        else:
            failed = FlightFailed(Failure.REFUSED, "it was broken off")
            self.driver.tell({"failed": number, **result_data(failed)})

    def _flight_before(self, event: Event) -> str:
        """Return the id of the flight that an event ends, or hands over."""
        mission = str(event["mission"])
        record = self.records.missions.get(mission)
        flight = None if record is None else record["flight"]
        same = ("trip", "round", "attempt")
        if flight is not None and all(flight[one] == event[one] for one in same):
            return id_of(mission, flight)  # whichever drone has taken it over
        return id_of(mission, event)

    def _forget(self, flight: str) -> None:
        """Have the gateway forget a flight: it is durable in the journal, or its id is used again."""
        self.link.send({"do": "forget", "flight": flight})

    def repeat_of(self, record: Record) -> str:
        """Return whether the action of a mission's flight may be repeated: `safe`, `once` or `ask`."""
        trip = trip_of(record, record["flight"])
        action = None if trip is None else self.app.actions.get(trip["action"])
        return "ask" if action is None else action.repeat

    def _news(self) -> Mapping[str, Any]:
        """Return the telemetry of the drones that has changed since the brain was told."""
        news = {}
        for entry in self.fleet.drones:
            known = self.link.telemetry(entry.id)
            now = (known.location, known.battery_level, known.landed)
            if self._seen.get(entry.id) != now:
                self._seen[entry.id] = now
                news[entry.id] = {"at": now[0], "battery": now[1], "landed": now[2]}
        return news


_BESIDE = frozenset({"read", "write", "sees", "act", "redirect", "cancel"})
"""Orders that a drone obeys beside what it does."""


def _ignore(*_: object) -> None:
    """Do nothing: no callback is set."""
