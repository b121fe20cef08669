"""The user's commands to a running app: stop, pause, go on, skip, cancel, decide, …

Each is called within the kernel, and returns a sentence for the user; `BadInput` says why it cannot be
done. Nothing here waits before the drones are told.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from ..files.fleet import with_joined
from ..jobs.link import UNCERTAIN
from ..jobs.reports import Down
from ..shared.domain.errors import BadInput
from ..shared.domain.status import Status
from ..shared.domain.text import counted, quoted
from ..shared.time.kernel import FLEET, Future, Task
from .changing import TripChange, refuse_if_stale
from .kept_events import (
    events_of,
    given_of,
    has_happened,
    is_kept,
    is_known,
    kept_one,
    noted,
)
from .mishaps import Mishaps
from .mission_status import ANSWERS, aside
from .reconcile import ANSWERS as DONE_OR_NOT
from .reconcile import (
    CANCELLED,
    drone_told,
    in_flight,
    unheard,
)
from .suspending import Suspending

if TYPE_CHECKING:
    from ..files.fleet import FleetFile
    from ..journal.standing import Record
    from .recorded_brain import RecordedBrain

PRIORITY = "priority"
"""The field of trips with the priority in the queue, in apps whose graph has one."""


class Control(Suspending):
    """The commands of one running app."""

    def __init__(self, run: RecordedBrain) -> None:
        super().__init__(run)
        self.stopped: Future[Down] = Future()
        """Set when everything was stopped and all drones are down."""
        self.whole: Task[float] | None = None
        """The task that starts or resumes all missions, and waits for their end."""
        self._stops: Task[None] | None = None
        self.mishaps = Mishaps(run, self._look_into)
        """What happens to simulated drones to rehearse it."""
        self._joining: dict[str, Task[None]] = {}
        """The tasks that ask drones how they are that are joining."""

    def stop(self, how: Down) -> str:
        """Suspend every mission and bring all drones down; all can be resumed later."""
        if self._stops is None and self.whole is not None and self.whole.is_set:
            return "all missions have ended, and all drones are down"
        if self._stops is None:
            self._run.halt()
            for work in (*self._steps_out.values(), *self._joining.values()):
                work.cancel()
            if self.whole is not None:
                self.whole.cancel()  # it may still be querying drones: nothing may begin after that
            self._run.recorder.fact("stopped", self._run.kernel.now)
            self._run.note("stopped", how=how.value)
        else:
            self._stops.cancel()
        self._stops = self._run.kernel.spawn(self._bring_down(how), FLEET, "everything stops")
        return "stopping: " + _HOW[how]

    async def _bring_down(self, how: Down) -> None:
        await self._link.bring_down(how)
        self.stopped.set(how)

    def pause(self, mission: str | None = None) -> str:
        """Suspend a mission, or all, until it is told to go on."""
        those = self._those(mission, lambda status: status not in _ASIDE, "can be paused")
        for name, record in those:
            self._step_out(name, record, self._paused)
        return f"{_named(those)}: paused"

    def go_on(self, mission: str | None = None) -> str:
        """Resume a paused mission, or all paused ones."""
        those = self._those(mission, lambda status: status is Status.PAUSED, "is paused")
        for name, _ in those:
            self._refuse_while_it_steps_out(name)
        for name, record in those:
            self._resume(name, record)
        return f"{_named(those)}: going on"

    def skip(self, mission: str, trip: str | None = None) -> str:
        """Skip a trip, the next one or the one named; if it flies, its drone comes home."""
        record = self.record(mission)
        if self._status(mission, record) in (Status.UNCERTAIN, Status.HELD):
            raise BadInput(f"mission {quoted(mission)} waits for a decision: decide that first")
        unwanted = _trip_to_skip(mission, record, trip)
        if unwanted is record["todo"][0]:  # it may fly, or be waited for
            self._step_out(mission, record, partial(self._skip, unwanted["name"]))
        else:
            self._run.command("skip", mission=mission, trip=unwanted["name"])
        return f"mission {quoted(mission)}: trip {quoted(unwanted['name'])} is skipped"

    def cancel(self, mission: str | None = None) -> str:
        """End a mission, or all, for good: CANCELLED."""
        those = self._those(mission, lambda _: True, "can be cancelled")
        for name, _ in those:
            self._cancel(name)
        return f"{_named(those)}: cancelled"

    def decide(self, mission: str, answer: str) -> str:
        """Answer an open question: `done`, `not-done`, `go-on` or `cancel`."""
        record = self.record(mission)
        status = self._status(mission, record)
        fitting = ANSWERS.get(status, ())
        if answer not in fitting:
            asked = f"fitting answers are {', '.join(fitting)}" if fitting else "it asks nothing"
            raise BadInput(f"mission {quoted(mission)} is {status.value}: {asked}")
        if answer == "go-on" and not (record["todo"] or record["done"]):
            raise BadInput(f"mission {quoted(mission)} cannot go on in this app: cancel it")
        self._run.command("decide", mission=mission, answer=answer)
        if answer == "cancel":
            self._cancel(mission)
        elif answer == "go-on":
            self._step_out(mission, record, self._resume)
        else:
            with self._half_done():
                self._settle(mission, record, DONE_OR_NOT[answer])
                self._go_on(mission)
        return f"mission {quoted(mission)}: {answer}"

    def change_trips(
        self, mission: str, trips: Sequence[object], replaces: Sequence[object] | None
    ) -> str:
        """Replace the trips of a mission that have not flown; `replaces`: what those were, by name."""
        self.changed(mission, trips, replaces)()
        return f"mission {quoted(mission)}: what has not flown is changed"

    def changed(
        self, mission: str, trips: Sequence[object], replaces: Sequence[object] | None = None
    ) -> Callable[[], None]:
        """Return what makes that change, checked; raise `BadInput` if it cannot be made."""
        record = self.record(mission)
        if self._status(mission, record) in (Status.UNCERTAIN, Status.HELD):
            raise BadInput(f"mission {quoted(mission)} waits for a decision: decide that first")
        self._refuse_while_it_steps_out(mission)
        if replaces is not None:
            refuse_if_stale(mission, record, replaces)
        change = TripChange(self._run.app, self._run.fleet, mission, record, trips)
        drone = record["carrier"] or (in_flight(record) or {}).get("drone")
        if drone is not None:
            change.refuse_too_little_battery(drone, self._link.telemetry(drone))
        return partial(self._change, mission, record, change)

    def _change(self, mission: str, record: Record, change: TripChange) -> None:
        if aside(record) is not None:
            self._run.command("change-trips", mission=mission, trips=change.todo)
        elif change.in_place:
            self._run.command("change-trips", mission=mission, trips=change.todo[1:])
        else:
            self._step_out(mission, record, partial(self._change_and_resume, change.todo))

    def _change_and_resume(self, todo: Sequence[Record], name: str, record: Record) -> None:
        self._run.command("change-trips", mission=name, trips=todo)
        self._resume(name, record)

    def prioritise(self, mission: str, trip: str, priority: int) -> str:
        """Change the priority of a trip that has not been flown."""
        record = self.record(mission)
        if not any(field.name == PRIORITY for field in self._run.app.fields):
            raise BadInput("the trips of this app have no priority")
        _trip_to_do(mission, record, trip)
        self._run.command("prioritise", mission=mission, trip=trip, priority=priority)
        return f"mission {quoted(mission)}: trip {quoted(trip)} has priority {priority}"

    def raise_event(self, event: str, facts: Mapping[str, object]) -> str:
        """Raise an event of the app, or keep it after a Stop; one whose id has happened does not happen again."""
        run = self._run
        events_of(run.app)
        given = given_of(facts)
        if "id" in given and is_known(run.records, str(given["id"])):
            return has_happened(str(given["id"]))
        if self._stops is not None:
            return self._keep(kept_one(run.app, run.fleet, run.records, event, facts))
        run.command("raise", event=event, **given)
        return f"event {quoted(event)} has happened"

    def _keep(self, one: Record) -> str:
        """Keep an event until everything goes on."""
        self._run.recorder.fact("kept", [*self._run.records.kept, one])
        self._run.take(noted(one, round(self._run.kernel.now, 6)))
        return is_kept(one)

    def retire(self, drone: str) -> str:
        """Allocate a drone to no further trip, until it is brought back."""
        known = self.check_drone(drone)
        if drone in self._run.records.retired:
            return f"{drone} is retired already"
        self._run.note("drone.retired", drone=drone)
        self._run.command("retire", drone=drone)
        return f"{drone} is retired" + (
            ", once its trip is over" if known["status"] == "BUSY" else ""
        )

    def fleet_with(self, entry: Mapping[str, object]) -> FleetFile:
        """Return the fleet with a drone that joins; raise `BadInput` if it cannot."""
        self._refuse_after_stop()
        if not self._run.is_set_out:
            raise BadInput("the drones are just being asked where they are: try again in a moment")
        return with_joined(self._run.app, self._run.fleet, [entry])

    def join(self, entry: Mapping[str, object]) -> str:
        """Have a drone join the fleet, which the gateway has taken in already."""
        fleet = self.fleet_with(entry)
        drone = fleet.drones[-1].id
        self._run.join(fleet, entry)
        self._joining[drone] = self._run.kernel.spawn(self._ask(drone), FLEET, f"{drone} joins")
        return f"{drone} joins the fleet"

    async def _ask(self, drone: str) -> None:
        """Ask a drone that joins how it is; before that it gets no trip."""
        report = await self._link.drone_report(drone)
        del self._joining[drone]
        told = {drone: drone_told(report)}
        self._run.driver.call(partial(self._run.brain.go_on, {}, told))

    def mishap(self, drone: str, kind: str) -> str:
        """Have a mishap happen to a simulated drone in flight, to rehearse it."""
        self.check_drone(drone)
        said = f"{drone}: {kind}"
        if kind == UNCERTAIN:
            said = self.mishaps.arm(drone)
        self._run.note("drone.mishap", drone=drone, kind=kind)
        return said

    def bring_back(self, drone: str) -> str:
        """Make a drone available again that was retired, or lost and repaired since."""
        known = self.check_drone(drone)
        lost = known["status"] == "LOST"
        asked = lost or bool(known.get("unready"))
        if not asked and drone not in self._run.records.retired:
            return f"{drone} is neither retired nor lost"
        self._run.note("drone.brought_back", drone=drone, lost=lost)
        self._run.command("bring-back", drone=drone)
        return f"{drone} is asked whether it is well" if asked else f"{drone} is back"

    def remember(self, id: str, command: str) -> None:
        """Record that a command is carried out, so that it is never carried out twice."""
        self._run.recorder.remember(id)
        self._run.note("commanded", id=id, command=command)

    async def carried_out(self) -> None:
        """Wait until a command has taken effect and is durable."""
        for work in list(self._steps_out.values()):
            await work.ended()
        await self._run.recorder.on_record()

    @property
    def waits(self) -> bool:
        """Whether missions that are in no graph keep the app running."""
        if self._busy or self._steps_out or self._joining:
            return True
        waiting = [aside(record) for _, record in self._under_way()]
        paused = any(one is not None and one[0] is Status.PAUSED for one in waiting)
        return paused or (self._run.patient and any(one is not None for one in waiting))

    def _paused(self, name: str, _: Record) -> None:
        self._run.command("pause", mission=name)

    def _skip(self, unwanted: str, name: str, record: Record) -> None:
        if any(trip["name"] == unwanted for trip in record["todo"]):
            self._run.command("skip", mission=name, trip=unwanted)
            record = self._run.record(name)
        if not record["todo"] and unheard(record) is None:
            self._run.command("cancel", mission=name, status=Status.COMPLETED.value, reason="")
        elif record["paused"] is None:
            self._resume(name, record)

    def _cancel(self, name: str) -> None:
        work = self._steps_out.pop(name, None)
        if work is not None:
            work.cancel()
        self._run.command("cancel", mission=name, status=Status.CANCELLED.value, reason=CANCELLED)
        self._run.look_for_the_end()

    # Which missions and drones

    def check_drone(self, id: str) -> Mapping[str, Any]:
        """Return where a drone stands; raise `BadInput` if it is not in the fleet."""
        self._refuse_after_stop()
        drones = self._run.brain.drones()
        if id in drones:
            found: Mapping[str, Any] = drones[id]
            return found
        names = ", ".join(quoted(drone) for drone in drones)
        raise BadInput(f"no drone {quoted(id)} is in the fleet; there are: {names}")

    def _under_way(self) -> list[tuple[str, Record]]:
        names = self._run.brain.under_way() if self._run.is_set_out else ()
        return [(name, self._run.record(name)) for name in names]

    def record(self, mission: str) -> Record:
        """Return the record of a mission that is under way; raise `BadInput` if it is not."""
        self._refuse_after_stop()
        living = self._run.brain.under_way() if self._run.is_set_out else ()
        if mission in living:
            return self._run.record(mission)
        names = ", ".join(map(quoted, living))
        raise BadInput(f"no mission {quoted(mission)} is under way; there are: {names or 'none'}")

    def _status(self, name: str, record: Record) -> Status:
        if name in self._steps_out:
            return Status.PAUSED
        waits = aside(record)
        return Status(record["status"]) if waits is None else waits[0]

    def _refuse_after_stop(self) -> None:
        if self._stops is not None:
            raise BadInput("everything was stopped: resume the journal first")

    def _those(
        self, mission: str | None, fits: Callable[[Status], bool], what: str
    ) -> Sequence[tuple[str, Record]]:
        self._refuse_after_stop()
        if mission is not None:
            record = self.record(mission)
            status = self._status(mission, record)
            if not fits(status):
                raise BadInput(f"mission {quoted(mission)} is {status.value}")
            return ((mission, record),)
        those = [(name, one) for name, one in self._under_way() if fits(self._status(name, one))]
        if not those:
            raise BadInput(f"no mission {what}")
        return those


def _trip_to_skip(mission: str, record: Record, name: str | None) -> Record:
    """Return the trip to skip; raise `BadInput` if it cannot be skipped."""
    who = f"mission {quoted(mission)}"
    if not record["todo"]:
        raise BadInput(f"{who} has no trip left to skip")
    unwanted: Record = record["todo"][0] if name is None else _trip_to_do(mission, record, name)
    if unwanted.get("item") is not None:
        raise BadInput(
            f"{who}: trip {quoted(unwanted['name'])} picks or releases {unwanted['item']['name']}, and "
            "what is picked must be released: cancel the mission instead"
        )
    return unwanted


def _trip_to_do(mission: str, record: Record, name: str) -> Record:
    trips: dict[str, Record] = {trip["name"]: trip for trip in record["todo"]}
    if name not in trips:
        left = ", ".join(quoted(one) for one in trips) or "none"
        raise BadInput(f"mission {quoted(mission)} has no trip {quoted(name)} to do; it has {left}")
    return trips[name]


def _named(those: Sequence[tuple[str, Record]]) -> str:
    if len(those) == 1:
        return f"mission {quoted(those[0][0])}"
    return counted(len(those), "mission")


_ASIDE = (Status.PAUSED, Status.UNCERTAIN, Status.HELD)

_HOW = {
    Down.HOME: "all drones fly home and land",
    Down.LAND: "all drones land where they are",
}
