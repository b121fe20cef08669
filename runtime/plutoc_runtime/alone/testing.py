"""A kit for tests of the app's hooks: what they are given, and a clock that a test moves by hand.

Nothing flies here: a test says how trips end, what drones measure and when time passes.
"""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Mapping
from contextlib import suppress
from itertools import count
from math import inf
from typing import Any, Generic, NamedTuple, ParamSpec, TypeVar, cast, overload

from ..domain.actions import Plain
from ..domain.app import App
from ..domain.errors import Failure, FlightFailed
from ..domain.keeper import Keeper, Kept, hand_to, put, reading
from ..domain.model import Drone, Mission, Point, ResultStore, Trip, put_back
from ..domain.status import RUNNING, Status, TripStatus
from ..domain.trace import Trace
from ..flow.transitions import Changes, Transitions
from ..hooks.calls import call_hook, hook_name
from ..hooks.context import Context, LiveDrone, can_wait, results_for
from ..time.kernel import FLEET, EventKind, Future, Task
from ..time.told import Stuck, VirtualTime

P = ParamSpec("P")
R = TypeVar("R")
M = TypeVar("M", bound=Mission[Any])
T = TypeVar("T", bound=Trip)
Given = TypeVar("Given")  # what its evaluators get: `Results`, or with values of the declared types

A_DAY = 86_400.0  # seconds after which a hook that has not ended is taken for one that never will


class Clock:
    """The time of a test: it stands still until the test moves it."""

    def __init__(self) -> None:
        self.kernel = VirtualTime()

    @property
    def now(self) -> float:
        """The time, in seconds since the test began."""
        return self.kernel.now

    def advance(self, seconds: float) -> None:
        """Let time pass; each hook that waits goes on at its instant."""
        if not 0.0 <= seconds < inf:
            raise ValueError(f"time cannot pass by {seconds} seconds")
        over: Future[None] = Future()
        # the last kind of all: all else that is due at that instant is done before
        self.kernel.at(self.now + seconds, EventKind.ALLOCATE, FLEET, lambda: over.set(None))
        self.kernel.run(over)


class HookCall(Generic[R]):
    """A hook that was called: it goes on with the clock, until it has ended."""

    def __init__(self, clock: Clock, task: Task[Any]) -> None:
        self._clock = clock
        self._task = task

    @property
    def done(self) -> bool:
        """Whether it has ended, well or not."""
        return self._task.is_set

    def result(self) -> R:
        """Return what it has returned, or raise what it has raised."""
        if not self.done:
            now = f"{self._task.name} has not ended at {self._clock.now:g} s"
            raise RuntimeError(f"{now}: it waits for the clock, or for the end of a trip")
        return cast("R", self._task.result())

    def finish(self, within: float = A_DAY) -> R:
        """Let time pass until it has ended, and return its result."""
        with suppress(Stuck):  # it waits for what only the test can bring: `result` says so
            self._clock.kernel.run(self._task, until=self._clock.now + within)
        return self.result()

    def cancel(self) -> None:
        """Call it off where it waits, as when its drone fails; what it has as `finally` is run."""
        self._task.cancel()


class Flight(Future[Status]):
    """A trip that is under way, for hooks that wait for its end."""

    def __init__(self, trip: Trip) -> None:
        super().__init__()
        self.trip = trip


class DroneState(NamedTuple):
    """The state of a drone, as a test has it."""

    location: Point
    battery_level: float
    landed: bool = False


class KitContext(Context):
    """A hook's context, with what a test gives to it and reads back."""

    def __init__(self, clock: Clock, results: ResultStore, mission: Mission[Any]) -> None:
        self.lines: list[str] = []  # what the hook has logged
        self.sensors: dict[str, float | Callable[[], float]] = {}
        """What its drone measures, by name; a function is called for each value."""
        self.written: dict[str, float] = {}  # what the hook has set on its drone, by name
        self._given = clock.kernel, results, lambda line, _: self.lines.append(line)
        self.lend(mission, lambda: None, None)

    def lend(
        self, mission: Mission[Any], latest: Callable[[], Flight | None], drone: Drone | None
    ) -> None:
        """Give it to a hook of this mission that begins; without a live drone, if that is None."""
        kernel = self._given[0]
        self._lent = LiveDrone(kernel, _Instruments(self), drone, FLEET) if drone else None
        super().__init__(*self._given, mission, latest, self._lent)

    def take_back(self) -> None:
        """End the access to the live drone: the hook has ended."""
        if self._lent is not None:
            self._lent.release()


class _Instruments:
    """What is built onto the drone of a context."""

    def __init__(self, context: KitContext) -> None:
        self._context = context

    async def ask(self, do: str, drone: str, *, name: str, value: float = 0.0) -> float:
        """Return what it measures under a name, or keep what it measures from now on."""
        if do == "write":
            self._context.sensors[name] = self._context.written[name] = value
            return value
        measured = self._context.sensors.get(name)
        if measured is None:
            raise FlightFailed(Failure.ACTION, f"{drone} has no {name}")
        return measured() if callable(measured) else measured


class _Open(Keeper):
    """Lets a test, and the hooks in it, write everything."""

    __slots__ = ()

    def must_edit(self, what: str) -> None:
        """Let it be done."""

    def written(self, of: Kept, name: str, value: object) -> object:
        """Let it be written."""
        return value


class AppKit(Generic[M, T, Given]):
    """What the hooks of an app are given, for one test."""

    def __init__(self, app: App, mission: Any = None, trip: Any = None) -> None:
        self._mission = mission or {}  # what must be filled in
        self._trip = trip or {}
        self._app = app
        self._store = ResultStore()
        self.clock = Clock()
        kernel = self.clock.kernel
        self._keeper = _Open(kernel.time)
        self._transitions = Transitions(
            app, kernel, Trace(kernel, ()), self._store, Changes({}, kept=False)
        )
        self._flights: dict[Mission[Any], Flight] = {}
        self._none = app.mission(name="no mission", trips=[], **self._mission)
        self._drones = count(1)
        self._trips = count(1)
        self._missions = count(1)

    def drone(
        self, category: str | None = None, *, at: Point = (0.0, 0.0, 0.0), battery: float = 1.0
    ) -> Drone:
        """Return a drone of a category, by default of the app's first."""
        kinds = {kind.name: kind for kind in self._app.categories}
        kind = kinds[category or next(iter(kinds))]
        number = next(self._drones)
        return Drone(
            id=f"{kind.name} {number}",
            category=kind,
            home=at,
            telemetry=DroneState(at, battery),
            index=number - 1,
        )

    def move(self, drone: Drone, *, to: Point | None = None, battery: float | None = None) -> None:
        """Change where a drone is, or what is left in its battery."""
        level = drone.battery_level if battery is None else battery
        put(drone, telemetry=DroneState(to or drone.location, level))

    def trip(
        self,
        action: str | None = None,
        *,
        target: Point = (3.0, 4.0, 1.0),
        parameters: Mapping[str, Plain] | None = None,
        **fields: Any,
    ) -> T:
        """Return a trip, by default with the first action that the app's drones can do."""
        able = (one for one in self._app.actions if any(k.can(one) for k in self._app.categories))
        declared = self._app.actions[action or next(able)]
        values = {p.name: p.default for p in declared.parameters if p.default is not None}
        trip = self._app.trip(
            action=declared.name,
            target=target,
            parameters={**values, **(parameters or {})},
            **{"name": f"trip {next(self._trips)}", **self._trip, **fields},
        )
        hand_to(self._keeper, trip)
        return cast("T", trip)

    def mission(self, *trips: T, **fields: Any) -> M:
        """Return a mission with these trips, by default with one."""
        for index, trip in enumerate(trips):
            trip.index = index
        given = {"name": f"mission {next(self._missions)}", **self._mission, **fields}
        return cast("M", self._app.mission(trips=list(trips or (self.trip(),)), **given))

    def launch(self, mission: M, drone: Drone | None = None) -> None:
        """Have a drone leave for the mission's next trip; one that flew before is put back."""
        trip = mission.trips[0]
        flier = drone or self.drone()
        if trip.status is TripStatus.EXECUTING:
            raise ValueError(f"trip {trip.name} is in flight: it can be reset when it has ended")
        put_back(trip)
        put(trip, drone=flier)
        self._transitions.launch(mission, trip, flier)
        self._flights[mission] = Flight(trip)

    def complete(self, mission: M, value: object = None) -> None:
        """Complete the mission's trip, whose action has given this value."""
        self._transitions.complete(mission, self._flown(mission), value)
        self._tell(mission)

    def fail(self, mission: M, reason: str = "the test has failed it") -> None:
        """Fail the mission's trip for this reason."""
        self._transitions.fail(mission, self._flown(mission), reason)
        self._tell(mission)

    def _flown(self, mission: M) -> Trip:
        """Return the mission's trip in flight; one that was not launched is by now."""
        if mission.status is not RUNNING:
            self.launch(mission)
        return cast("Trip", mission.trips[0])

    def _tell(self, mission: M) -> None:
        self._flights[mission].set(mission.status)
        self.clock.advance(0.0)

    def results(self, mission: M) -> Given:
        """Return what the mission's evaluator gets now; it is new only once."""
        return cast(Given, results_for(self._store, mission))

    def context(self) -> KitContext:
        """Return a context, for the actions and modifiers that it is handed to."""
        return KitContext(self.clock, self._store, self._none)

    @overload
    def start(
        self, hook: Callable[P, Coroutine[Any, Any, R]], /, *given: P.args, **named: P.kwargs
    ) -> HookCall[R]: ...
    @overload
    def start(self, hook: Callable[P, R], /, *given: P.args, **named: P.kwargs) -> HookCall[R]: ...
    def start(self, hook: Callable[..., Any], /, *given: Any, **named: Any) -> HookCall[Any]:
        """Call a hook, and let it run until it waits."""
        passed = (*given, *named.values())
        drone = next((one for one in passed if isinstance(one, Drone) and can_wait(hook)), None)
        mission = next((one for one in passed if isinstance(one, Mission)), self._none)
        contexts = [one for one in passed if isinstance(one, KitContext)]

        def over(_: object) -> None:  # what the hook has raised is kept for `result`
            for context in contexts:
                context.take_back()

        for context in contexts:
            context.lend(mission, lambda: self._flights.get(mission), drone)
        call = call_hook(self.clock.kernel, reading(), hook, *given, **named)
        task = self.clock.kernel.spawn(call, FLEET, hook_name(hook))
        task.over = over
        self.clock.advance(0.0)
        return HookCall(self.clock, task)

    @overload
    def call(
        self, hook: Callable[P, Coroutine[Any, Any, R]], /, *given: P.args, **named: P.kwargs
    ) -> R: ...
    @overload
    def call(self, hook: Callable[P, R], /, *given: P.args, **named: P.kwargs) -> R: ...
    def call(self, hook: Callable[..., Any], /, *given: Any, **named: Any) -> Any:
        """Call a hook, let time pass until it has ended, and return its result."""
        return self.start(hook, *given, **named).finish()
