"""One run of an app with a journal, from its start or from where an earlier run ended.

A run ends when its last mission has ended, when it is stopped, or when its process dies. The next one
begins with the journal's records and a report of the drones, however the last one ended.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any

from plutoc_runtime.brain import Brain
from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.status import Status
from plutoc_runtime.domain.text import place, quoted
from plutoc_runtime.flow.standing import drones_of, fleet_data, mission_data, update
from plutoc_runtime.time.future import Future
from plutoc_runtime.time.kernel import FLEET, Kernel, Task

from ..files.reading import shortened
from ..jobs.reports import reported_result
from ..journal.recorder import Recorder, Sink
from ..process.signal_guard import guard_hooks
from ..process.text import of
from .control import Control
from .driver import Driver, Message, Order
from .mission_status import aside, in_order
from .orders import Dispatcher, outcome
from .reconcile import Outcome, outcome_of
from .recovery import Recovery

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Drone, Mission
    from plutoc_runtime.domain.trace import Event
    from plutoc_runtime.time.told import HookRunner

    from ..files.fleet import FleetFile
    from ..jobs.job import CommandLink
    from ..jobs.reports import FleetReport
    from ..journal.fold import Records

Listener = Callable[["Event"], object]

HELPLESS = 12.0
"""Seconds after which a drone on the ground would have begun to fly home, if it could."""


class RecordedFlight:
    """A brain whose events are durable before they have any effect outside."""

    def __init__(
        self,
        app: App,
        fleet: FleetFile,
        kernel: Kernel,
        link: CommandLink,
        sink: Sink,
        records: Records,
        *,
        epoch: int,
        listeners: Sequence[Listener] = (),
        watcher: Listener | None = None,
        hooks: HookRunner | None = None,
        midnight: float = 0.0,
    ) -> None:
        """`watcher` is called with an event only when it is durable, `listeners` at once.

        `midnight`: the seconds between the midnight before the app's start and the start.
        """
        guard_hooks()
        self.app, self.fleet, self.kernel, self.link = app, fleet, kernel, link
        self.recorder = Recorder(kernel, sink, records)
        self.brain = Brain(
            app,
            {**fleet_data(fleet), "recorded": True, "midnight": midnight},
            space=fleet.airspace,
            hooks=hooks,
        )
        self._epoch, self._listeners, self._watcher = epoch, tuple(listeners), watcher
        keys = {drone.id: FLEET + 1 + index for index, drone in enumerate(fleet.drones)}
        self._dispatcher = Dispatcher(kernel, link, keys)
        self.driver = Driver(
            kernel, self.brain, obey=self._obey, motions=self._news, hear=self._hear
        )
        self._dispatcher.tell = self.driver.tell
        self.driver.pumped = self.look_for_the_end
        self._seen: dict[str, tuple[object, ...]] = {}
        """The telemetry that the brain was told last, by drone."""
        self._heard = 0
        """How many events the brain has said."""
        self._held: dict[str, Order] = {}
        """The flights that wait for the journal, by drone."""
        self.carried_home = True
        """Whether drones that need a person are waited for when all missions have ended."""
        self.patient = False
        """Whether the flight goes on while missions wait for the user's decision."""
        self._over: Future[float] = Future()
        self._ended_at: float | None = None
        self._stands_since: dict[str, float] = {}
        self._helpless: Task[None] | None = None
        self.is_set_out = False
        """Whether the brain has its missions."""
        self.control = Control(self)

    @property
    def records(self) -> Records:
        """Where everything stands."""
        return self.recorder.records

    @property
    def missions(self) -> tuple[Mission[Any], ...]:
        """All missions as they stand, also those that ended in earlier runs; none before they are known."""
        return self._as_missions() if self.is_set_out else ()

    def _as_missions(self) -> tuple[Mission[Any], ...]:
        missions = []
        for name, record in in_order(self.records):
            mission = self.app.mission(name=name, trips=[], index=record["index"])
            with suppress(KeyError, TypeError, ValueError):  # it may not fit the app any more
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

    # Starting and resuming

    def start(self, missions: Sequence[Mission[Any]]) -> Task[float]:
        """Fly these missions from the beginning; the task returns when the last one ended."""
        return self._set_out(self._started(missions))

    def go_on(self, planned: Sequence[Mission[Any]]) -> Task[float]:
        """Resume from the records; if the journal has no mission yet, fly the planned ones."""
        if not self.records.missions:
            return self.start(planned)
        return self._set_out(self._went_on())

    def add(self, missions: Sequence[Mission[Any]]) -> None:
        """Start more missions while others fly; raise `BadInput` if they cannot be flown."""
        if not self.is_set_out:
            raise BadInput("the drones are just being asked where they are: try again in a moment")
        known = self.records.missions
        for mission in missions:
            if mission.name in known:
                name = quoted(mission.name)
                raise BadInput(f"a mission {name} has been started already: rename the new one")
        first = 1 + max(record["index"] for record in known.values())
        for index, mission in enumerate(missions, start=first):
            mission.index = index
        self._begin(missions)

    def _begin(self, missions: Sequence[Mission[Any]]) -> None:
        data = [mission_data(self.app, one) for one in missions]
        self.driver.call(partial(self.brain.begin, data))

    def _set_out(self, whole: Coroutine[Any, Any, float]) -> Task[float]:
        self.control.whole = task = self.kernel.spawn(whole, FLEET, "the session")
        return task

    async def _started(self, missions: Sequence[Mission[Any]]) -> float:
        records = self.records
        fleet_report = await self.link.fleet_report()
        if fleet_report.drones.keys().isdisjoint(
            records.mended
        ):  # else one of them is queried again
            lost = {name: one["reason"] for name, one in records.lost.items()}
            _refuse_if_none_is_ready(fleet_report, lost)
        self.note("brain.began", epoch=self._epoch)
        recovery = Recovery(self, fleet_report)
        recovery.ask_the_mended()
        self.driver.call(partial(self.brain.go_on, recovery.standing(), recovery.drones))
        self._begin(missions)
        self.is_set_out = True
        return await self._over

    async def _went_on(self) -> float:
        fleet_report = await self.link.fleet_report()
        self.note("brain.began", epoch=self._epoch)
        recovery = Recovery(self, fleet_report)
        recovery.ask_the_mended()
        await recovery.find_out()
        recovery.settle()
        self.driver.call(partial(self.brain.go_on, recovery.standing(), recovery.drones))
        self.is_set_out = True
        self.look_for_the_end()
        return await self._over

    def halt(self) -> None:
        """Let the brain do nothing more: a later run goes on from the records."""
        self.driver.halt()
        self.brain.close()
        self._held.clear()

    def close(self) -> None:
        """End this run where it is."""
        self.driver.halt()
        self.brain.close()

    # The end

    def look_for_the_end(self) -> None:
        """End the run if every mission has ended and every drone is down; missions may wait for people."""
        if self._over.is_set or not self.is_set_out or self.driver.halted:
            return
        if self.brain.living or self.control.waits:
            self._ended_at = None
        elif self._ended_at is None:
            self._ended_at = self.kernel.now
        if self._ended_at is None:
            return
        if self.brain.over is not None:
            self._over.set(self._ended_at)
        elif not self.carried_home and self._helpless is None:
            self._helpless = self.kernel.spawn(
                self._wait_for_people(), FLEET, "drones need a person"
            )

    async def _wait_for_people(self) -> None:
        """End the run, too, if all that keeps it are drones that stand on the ground and need a person."""
        since: dict[str, float] = {}
        while self._ended_at is not None and not self._over.is_set:
            now, drones = self.kernel.now, self.brain.drones()
            under_way = {id for id, one in drones.items() if one["status"] in _UNDER_WAY}
            for id in drones:
                stands = drones[id]["status"] == "RECOVERING" and drones[id]["landed"]
                if id in under_way and stands:
                    since.setdefault(id, now)
                else:
                    since.pop(id, None)
            if under_way and all(now - since.get(id, now) >= HELPLESS for id in under_way):
                for id in drones:
                    if id in under_way:
                        where = place(drones[id]["at"])
                        text = f"{id} stands at {where} and needs a person: go and look"
                        self.note("log", mission=None, text=text)
                self._over.set(self._ended_at)
                break
            await self.kernel.sleep(1.0)
        self._helpless = None

    # What happens

    def note(self, event: str, **facts: object) -> None:
        """Record an event of this run that the brain does not know."""
        self.take({"event": event, **facts})

    def take(self, event: Event) -> None:
        """Record such an event, given as a mapping."""
        self._take({"t": round(self.kernel.now, 6), **event})

    def _hear(self, event: Event) -> None:
        self._heard += 1
        self._take(event)
        self.recorder.when_durable(partial(self._tell_durable, self._heard))

    def hook_ended(self, number: int) -> None:
        """Called within the kernel when a hook that took its time has ended."""
        self.driver.tell({"hook": number})

    def _tell_durable(self, number: int) -> None:
        self.driver.tell({"durable": number})

    def _take(self, event: Event) -> None:
        if not self.recorder.take(event):
            return
        if event["event"] in ("trip.completed", "trip.failed"):
            # it is durable in the journal: the gateway's ledger need not remember it
            mission, trip = event["mission"], event["trip"]
            id = f"{mission}/{trip}/{event['round']}/{event['attempt']}"
            self.recorder.when_durable(partial(self.link.forget, id))
        for listener in self._listeners:
            listener(event)
        if self._watcher is not None:
            if event["event"] == "trip.completed":
                event = {**event, "did": self.records.flown_last(str(event["mission"]))}
            self.recorder.when_durable(partial(self._watcher, event))

    # What the brain orders

    def _obey(self, order: Order) -> None:
        """Carry out an order; a flight only once its launch is durable."""
        drone = order["drone"]
        match order["do"]:
            case "fly":
                self._held[drone] = order
                self.recorder.when_durable(partial(self._let_fly, order))
            case "break_off":
                held = self._held.pop(drone, None)
                self.link.break_off(drone)
                if order.get("settle") is not None:
                    self.kernel.spawn(
                        self._settle(order, held is not None),
                        FLEET,
                        f"{order['flight']} is called off",
                    )
            case "probed":
                self.control.probed(order["flight"], order["value"])
            case _:
                self._dispatcher.obey(order)

    def _let_fly(self, order: Order) -> None:
        if self._held.get(order["drone"]) is order:
            del self._held[order["drone"]]
            self._dispatcher.obey(order)

    async def _settle(self, order: Order, was_held: bool) -> None:
        """Report what came of a flight that was called off: its action may be done by now."""
        number, id = order["settle"], order["flight"]
        entry = None if was_held else (await self.link.fleet_report()).jobs.get(id)
        mission = id.rsplit("/", 3)[0]
        record = self.records.missions[mission]
        what = outcome_of(entry, self.repeat_of(record), begun=False)
        if what is Outcome.UNKNOWN:
            self.control.doubt_in_flight(mission, id)
        elif what is Outcome.FLIES_ON and entry is not None:
            if entry.flies:
                self.link.attach(id, lambda result: self.driver.tell(outcome(number, result)))
            else:
                self.driver.tell(outcome(number, reported_result(entry)))
        else:
            failed: Message = {
                "failed": number,
                "failure": "REFUSED",
                "reason": "it was broken off",
            }
            self.driver.tell(failed)

    def repeat_of(self, record: Mapping[str, Any]) -> str:
        """Return whether the action of a mission's flight may be repeated: `safe`, `once` or `ask`."""
        flight = record["flight"]
        for which in ("todo", "done", "gone"):
            for trip in record[which]:
                if trip["name"] == flight["trip"] and trip["action"] in self.app.actions:
                    return self.app.actions[trip["action"]].repeat
        return "ask"

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


_UNDER_WAY = ("RETURNING", "RECOVERING", "BUSY")


def _refuse_if_none_is_ready(fleet_report: FleetReport, lost: Mapping[str, str]) -> None:
    """Raise `BadInput` if no drone may fly: nothing has begun."""
    reasons = {
        drone: (
            f"it is lost, and was not brought back ({lost[drone]})"
            if drone in lost
            else "; ".join(one.problems)
        )
        for drone, one in fleet_report.drones.items()
    }
    problems = [of(drone, reason) for drone, reason in reasons.items()]
    if problems and all(reasons.values()):
        whole = shortened(["no drone is ready to fly", *problems])
        raise BadInput(f"{whole}\nnothing has begun: mend that, and begin anew, with a new journal")
