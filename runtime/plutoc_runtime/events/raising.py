"""The occurrences of events: each happens once, wakes who waits for it, and may make a mission.

An occurrence is a row, like a mission: it is durable before its creator is asked, and the mission that comes of it
changes that row at the same instant. So after any end of the app each has happened once.
"""

from __future__ import annotations

from collections.abc import Awaitable, Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from ..domain.errors import BadInput, HookFault
from ..domain.guard import NOT_ITS_OWN
from ..domain.keeper import put, put_anew, reading, trips_of
from ..domain.status import DroneStatus, Status
from ..domain.text import LONGEST_REASON, bounded, duration, quoted
from ..domain.values import point, point_on
from ..flow.own_action import while_it_suffices
from ..hooks.calls import call_hook, fault_of, hook_name
from ..hooks.plain_data import keepable
from ..hooks.soundness import taken_in
from ..time.kernel import FLEET, EventKind, Future
from .changes import keep
from .context import Context, Outside
from .declared import (
    FACTS,
    LATE,
    LOST,
    Creator,
    Event,
    EventsDeclared,
    EventType,
    event_of,
    facts_of,
    read_occurrence,
)
from .interruption import Interruption
from .made import wrong_mission
from .part import Part

if TYPE_CHECKING:
    from ..domain.model import Drone, Mission, Point
    from ..domain.trace import Row
    from ..flow.engine import Engine
    from ..flow.flight import Flight
    from ..flow.mission import MissionState
    from ..flow.run import Run
    from .interruption import Whose


class Happening:
    """One occurrence, and what has come of it."""

    __slots__ = ("answered", "event", "made", "open", "why")

    def __init__(self, event: Event, blocks: Sequence[str]) -> None:
        self.event = event
        self.open = [*blocks]  # those whose creators have not answered yet
        self.answered = Future[None]()  # set when all have
        self.made: list[str] = []  # the missions that came of it
        self.why = ""  # why none did, of the last creator that made none


class EventsOf(EventsDeclared):
    """Makes the events of an app: those that it declares, and the built-in ones that it uses."""

    def __call__(self, engine: Engine) -> Events:
        """Return what handles them in a running app."""
        return Events(engine, (*self.types, *BUILT_IN), self.creators)


class Events(Part):
    """The events of one running app."""

    def __init__(
        self, engine: Engine, types: Sequence[EventType], creators: Sequence[Creator]
    ) -> None:
        self._engine = engine
        self._core = engine.core
        self._types = {one.name: one for one in types}
        self._creators: dict[str, dict[str, Creator]] = {}
        """By the names of their events, and of their blocks."""
        for creator in creators:
            self._creators.setdefault(creator.event, {})[creator.block] = creator
        self.happenings: dict[str, Happening] = {}
        """By their ids."""
        self._unasked: list[Happening] = []
        """Those of an earlier run."""
        self._changed: dict[str, None] = {}
        self.reserved: dict[str, Drone] = {}
        """The drones that hover for their missions, by the names of these, since an event broke a flight off."""
        self._interrupted: dict[str, dict[Flight, list[Interruption]]] = {}
        """By the names of events, the flights that they break off."""
        self._counted_since = 0.0
        self._counted = 0  # the events that hooks have raised since then
        self.commands = {"raise": self._raise}
        self._core.trace.listen(self._hear)
        self._core.transitions.noted = True
        self._core.context = partial(Context, self)
        self._core.queue.entered = self.release

    # What happens

    def tell(self, message: Mapping[str, Any]) -> None:
        """Have happen what happens in a simulated world: each once `after` so many seconds."""
        for one in message.get("happens", ()):
            if one["id"] not in self.happenings:
                self._engine.expect()
                when = max(self._core.kernel.now, one["after"])
                self._core.kernel.at(when, EventKind.CLOCK, FLEET, partial(self._in_world, one))

    def _in_world(self, one: Mapping[str, Any]) -> None:
        given = {name: fact for name, fact in one.items() if name not in ("name", "after")}
        try:
            self.happen(one["name"], given)
        except BadInput as error:
            self._core.log(str(error))
        self._engine.expect_no_more()

    def emit(self, name: str, given: Mapping[str, Any]) -> None:
        """Note an occurrence that a hook raises; raise `ValueError` if it cannot be."""
        now = self._core.kernel.now
        if now - self._counted_since >= WITHIN:
            self._counted_since = now
            self._counted = 0
        self._counted += 1
        if self._counted > MOST:
            raise ValueError(
                f"hooks have raised {MOST:,} events within {duration(WITHIN)}: what an event leads to "
                "raises events again, without an end"
            )
        self.happen(name, given, ValueError)

    def happen(
        self, name: str, given: Mapping[str, Any], wrong: Callable[[str], Exception] = BadInput
    ) -> str:
        """Note an occurrence, and let come of it what comes; return its id.

        `given` may have `id`, `at`, `track`, `mission`, `trip`, `drone` and the event's own `fields`.
        """
        facts = self._read(name, given, wrong)
        id = facts["id"]
        if id in self.happenings:
            return str(id)
        kind = self._types[name]
        event = event_of(kind, {**facts, "name": name, "time": round(self._core.kernel.time(), 6)})
        happening = Happening(event, (*self._creators.get(name, ()),))
        self.happenings[id] = happening
        self._changed[id] = None
        self._note("event.raised", **_as_noted(event, kind))
        on_record = self._core.on_record
        recorded = None if on_record is None else on_record()  # not what is noted after it
        if happening.open:
            self._ask_creators(happening, recorded)
            work = self._interrupt_later(happening)
            self._core.kernel.spawn(work, FLEET, f"event {id} interrupts")
        else:
            self._interrupt(event)
        return str(id)

    def _interrupt(self, event: Event) -> None:
        """Break off the flights that an event concerns."""
        for flight, interruptions in tuple(self._interrupted.get(event.name, {}).items()):
            for each in interruptions:
                if each.concerns(event):
                    each.soon(flight, event)

    async def _interrupt_later(self, happening: Happening) -> None:
        """Break them off once the missions that the event makes wait for drones: these may be theirs."""
        kernel = self._core.kernel
        until = kernel.now + PATIENCE
        await kernel.within(happening.answered, until, EventKind.READY, FLEET)
        self._interrupt(happening.event)

    def _raise(self, request: Mapping[str, Any]) -> None:
        """Raise an event as a person, or another program, wants."""
        if request.get("event") in (LATE, LOST):
            raise BadInput(f"{request['event']} is raised by the app itself")
        given = {name: value for name, value in request.items() if name not in ("command", "event")}
        self.happen(str(request.get("event")), given)

    def _read(
        self, name: str, given: Mapping[str, Any], wrong: Callable[[str], Exception]
    ) -> dict[str, Any]:
        """Return the facts of an occurrence, checked; raise what is `wrong` with them."""
        space = self._core.airspace

        def on_the_map(value: object) -> Point:
            x, y, z = point_on(space, space.cruise_height, point, value)
            return round(x, 3), round(y, 3), round(z, 3)  # no camera sees more exactly

        facts = read_occurrence(self._types, name, given, on_the_map, wrong)
        for what, known in (("mission", self._engine.states), ("drone", self._core.orders.drones)):
            if what in facts and facts[what] not in known:
                raise wrong(f"event {name}: there is no {what} {quoted(facts[what])}")
        facts.setdefault("id", f"{name}-{len(self.happenings) + 1}")
        return facts

    def _hear(self, noted: Mapping[str, Any]) -> None:
        """Raise the built-in events when what they are about is noted."""
        match noted:
            case {"event": "mission.late", "mission": mission, "t": when}:
                self._soon(LATE, id=f"late/{mission}/{when}", mission=mission)
            case {"event": "mission.ended", "mission": mission}:
                self._end(self._engine.states[mission])
            case {"event": "drone.lost", "drone": drone, "at": at, "t": when}:
                flown = self._flown_by(drone)
                origin = {} if flown is None else {"mission": flown}
                self._soon(LOST, id=f"lost/{drone}/{when}", drone=drone, at=at, **origin)

    def _end(self, state: MissionState) -> None:
        """Forget a mission that has ended: not every flight is set by then."""
        self.release(state.mission)
        if state.flight is not None:
            for flights in self._interrupted.values():
                flights.pop(state.flight, None)

    def _soon(self, name: str, **given: Any) -> None:
        """Raise a built-in event once what has just been noted is complete."""
        kernel = self._core.kernel
        kernel.at(kernel.now, EventKind.READY, FLEET, lambda: self.happen(name, given))

    def _flown_by(self, drone: str) -> str | None:
        """Return the mission that a drone has flown for last, if that has not ended."""
        flights = [
            state.flight
            for state in self._engine.states.values()
            if not state.ended and state.flight is not None and state.flight.drone == drone
        ]
        latest = max(flights, key=lambda flight: flight.launched_at, default=None)
        return None if latest is None else latest.mission.name

    def interrupt(self, run: Run[Any], event: str, of: Whose) -> None:
        """Have an event break the flight of this moment off, unless that or its branch has ended."""
        flight = run.state.flight
        if flight is None or flight.is_set:
            return
        flights = self._interrupted.setdefault(event, {})
        if flight not in flights:
            flights[flight] = []
            flight.watch(lambda _: flights.pop(flight, None))
        flights[flight].append(Interruption(run, of, self))

    def reserve(self, mission: str, drone: Drone) -> None:
        """Have a drone hover for a mission until its next allocation decides."""
        self.reserved[mission] = drone
        fleet = self._core.fleet
        fleet.send(drone, DroneStatus.BUSY, partial(self._hover, mission), "waits for its mission")

    async def _hover(self, mission: str, drone: Drone) -> None:
        """Hover as long as the battery suffices, and then go home."""
        core = self._core
        hover = core.kernel.spawn(core.orders.ask("hold", drone.id), FLEET, f"{drone.id} hovers")
        rest = core.kernel.spawn(
            while_it_suffices(core, drone, FLEET), FLEET, f"{drone.id}'s battery"
        )
        either = Future[None]()
        hover.watch(either.set)
        rest.watch(either.set)
        try:
            await either
        finally:
            hover.cancel()
            rest.cancel()
        del self.reserved[mission]
        if hover.is_set and hover.error is not None:
            await core.fleet.rescue(drone, str(hover.error))
        else:
            await core.fleet.fly_home(drone)

    def release(self, mission: Mission[Any]) -> None:
        """Let the drone go that hovers for a mission: the next allocation decides whose it is."""
        core = self._core
        drone = self.reserved.pop(mission.name, None)
        if drone is None:
            return
        core.fleet.engage(drone)
        put(drone, status=DroneStatus.FREE)  # for this instant alone, without an event
        core.queue.moved(drone)

        def look() -> None:
            if drone.status is DroneStatus.FREE and not drone.telemetry.landed:
                core.fleet.dismiss(drone)  # no mission has taken it

        core.kernel.at(core.kernel.now, EventKind.ALLOCATE, FLEET, look)

    # What is made of it

    @property
    def living(self) -> tuple[Mission[Any], ...]:
        """The missions that have not ended, in their order."""
        missions = [one.mission for one in self._engine.states.values() if not one.ended]
        return tuple(sorted(missions, key=lambda mission: mission.index))

    def _ask_creators(self, happening: Happening, recorded: Awaitable[None] | None) -> None:
        """Ask those that have not answered yet, once the event is recorded; None: it is already."""
        event = happening.event
        for block in happening.open:
            self._engine.expect()
            work = self._create(happening, self._creators[event.name][block], recorded)
            self._core.kernel.spawn(work, FLEET, f"event {event.id} at {block}")

    async def _create(
        self, happening: Happening, creator: Creator, recorded: Awaitable[None] | None
    ) -> None:
        """Ask a creator of an event for a mission, and begin that."""
        core = self._core
        event = happening.event
        if recorded is not None:
            await recorded
        none: dict[str, Any] = {"why": f"{creator.block} made no mission of it"}
        try:
            mission = await self._mission_of(creator, event)
        except HookFault as fault:
            if fault.detail:
                core.log(fault.detail)
            none = {"why": str(fault), "fault": True}
            mission = None
        happening.open.remove(creator.block)
        self._changed[event.id] = None
        if mission is None:
            happening.why = none["why"]
            self._note("event.over", id=event.id, **none)
        else:
            happening.made.append(mission.name)
            self._note("event.over", id=event.id, made=mission.name)
            self._engine.begin([mission], at=creator.block)
        if not happening.open:
            happening.answered.set(None)
        self._engine.expect_no_more()

    async def _mission_of(self, creator: Creator, event: Event) -> Mission[Any] | None:
        """Return the mission that a creator makes, checked; raise its fault."""
        hook = creator.hook
        core = self._core
        outside = Outside(self._next_index())
        context = Context(self, core.kernel, core.results, core.log, outside, lambda: None)
        try:
            made: Any = await call_hook(core.kernel, reading(), hook, event, context)
        except NOT_ITS_OWN:
            raise
        except BaseException as error:
            raise fault_of(hook, error) from error
        if made is None:
            return None
        if (wrong := wrong_mission(core, made) or self._take_in(made)) is not None:
            raise HookFault(f"creator {hook_name(hook)} made a mission that cannot be: {wrong}")
        put(made, index=self._next_index(), name=self._free_name(made.name))
        return made  # type: ignore[no-any-return]  # its class was checked

    def _take_in(self, made: Mission[Any]) -> str | None:
        """Make a creator's mission one of the app, with trips of its own; return why that cannot be."""
        put_anew(made)
        self._engine.keep(made, ())
        whys = (taken_in(made, trip, added=False) for trip in trips_of(made))
        return next(filter(None, whys), None)

    def _next_index(self) -> int:
        states = self._engine.states.values()
        return max((state.mission.index for state in states), default=-1) + 1

    def _free_name(self, name: str) -> str:
        """Return a mission's name, with a number if there is such a mission already."""
        free = name
        number = 1
        while free in self._engine.states:
            number += 1
            free = f"{name} {number}"
        return free

    def cancel(self, mission: Mission[Any], why: str) -> None:
        state = self._engine.states.get(getattr(mission, "name", ""))
        if state is None or state.mission is not mission:
            raise ValueError("only a mission of this app can be cancelled")
        if not state.ended:
            self._engine.cancel(state, Status.CANCELLED, bounded(str(why), LONGEST_REASON))

    def store(self, flight: Flight, value: object) -> None:
        """Keep a result of a flight that goes on."""
        keep(self._core, flight.mission, flight.trip, keepable(value))

    def _note(self, what: str, **facts: Any) -> None:
        if self._core.trace.live:
            self._core.trace.note(what, **facts)

    # Rows

    def rows(self) -> list[Row]:
        """Return the rows of what has happened, or come of it, since the last call."""
        changed: list[Row] = [
            ("happening", (id,), _row(self.happenings[id])) for id in self._changed
        ]
        self._changed.clear()
        return changed

    def standing(self) -> dict[str, Any]:
        """Return the rows of all that has happened, by its id."""
        return {"happenings": {id: _row(one) for id, one in self.happenings.items()}}

    def restore(self, standing: Mapping[str, Any]) -> None:
        """Take over what has happened in an earlier run."""
        for id, row in standing.get("happenings", {}).items():
            kind = self._types.get(row["event"]["name"], EventType(name=row["event"]["name"]))
            known = {one.name for one in kind.fields} | {*_OF_ALL}
            facts = {name: value for name, value in row["event"].items() if name in known}
            creators = self._creators.get(kind.name, {})
            blocks = [block for block in row.get("open", ()) if block in creators]
            self.happenings[id] = happening = Happening(event_of(kind, facts), blocks)
            happening.made = [*row.get("made", ())]
            happening.why = row.get("why", "")
            self._unasked.append(happening)

    def go_on(self) -> None:
        """Ask the creators that had not answered at the end of an earlier run."""
        for happening in self._unasked:
            self._ask_creators(happening, None)
        self._unasked.clear()  # missions go on one by one, too


def _row(happening: Happening) -> dict[str, Any]:
    row: dict[str, Any] = {"event": facts_of(happening.event), "open": [*happening.open]}
    if happening.made:
        row["made"] = [*happening.made]
    if happening.why:
        row["why"] = happening.why
    return row


def _as_noted(event: Event, kind: EventType) -> dict[str, Any]:
    """Return what the trace says of an occurrence; its own fields apart, as they may have any name."""
    facts = facts_of(event)
    fields = {one.name: facts.pop(one.name) for one in kind.fields if one.name in facts}
    noted = {"kind": facts.pop("name"), "raised": facts.pop("time"), **facts}
    return {**noted, "fields": fields} if fields else noted


MOST = 1_000
WITHIN = 10.0
"""So many events, within so many seconds, are those of hooks that raise each other's for ever."""
PATIENCE = 1.0
"""Seconds for which a flight that an event interrupts goes on, at most, until its creators have answered."""
BUILT_IN = (EventType(name=LATE), EventType(name=LOST))
_OF_ALL = (*FACTS, "name", "time", "at")
