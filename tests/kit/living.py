"""A little world in which one app lives several lives, for tests of what becomes of missions."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Sequence
from typing import Any, TypeVar

from pluto_fleet.app import App
from pluto_fleet.files.fleet import FleetFile, with_joined
from pluto_fleet.flight.offline import decided
from pluto_fleet.flight.recorded_flight import RecordedFlight
from pluto_fleet.gateway.gateway import Gateway
from pluto_fleet.gateway.ledger import Ledger
from pluto_fleet.jobs.controls import fleet_drones
from pluto_fleet.jobs.reports import Down
from pluto_fleet.journal.store import Entry
from pluto_fleet.shared.alone.world import Faults
from pluto_fleet.shared.domain.model import Mission
from pluto_fleet.shared.domain.trace import Event
from pluto_fleet.shared.events.world import MovingWorld
from pluto_fleet.shared.time.kernel import FLEET, Call, EventKind, Future, Kernel, Key, Task, Timer
from pluto_fleet.shared.time.told import VirtualTime
from pluto_fleet.simulation.drones import SimulatedNavigation, WorldAction
from tests.kit import apps
from tests.library.journal.memory import Memory

T = TypeVar("T")


def enterable(**flow: Any) -> App:
    """Return an app that can go on at its Clock and at its DroneAllocator."""
    actions = flow.pop("actions", ())
    app = apps.app(apps.flow(**flow), actions=actions)
    points = ("wait", "allocate") if flow.get("clock") else ("allocate",)
    return apps.changed(app, resumes=points)


class _AtOnce:
    """A disk that takes no time."""

    def __init__(self, memory: Memory) -> None:
        self._memory = memory
        self.life: RecordedFlight | None = None

    def add(self, entry: Entry) -> int:
        """Make an entry durable."""
        number = self._memory.add(entry)
        self._memory.commit()
        if self.life is not None:
            self.life.recorder.durable(number)
        return number


class Mortal(Kernel):
    """Runs everything on its host, at its host's time and in its order, until it is killed."""

    def __init__(self, host: Kernel) -> None:
        # nothing of a kernel's own is needed: everything is the host's
        self._host, self._mine = host, dict[Task[Any], None]()
        self.alive = True
        self.settled: Callable[[], object] | None = None
        host.settled = self._settle

    def kill(self) -> None:
        """Let nothing of it run on, as when a process is killed; not from one of its own events."""
        self.alive = False
        self._host.settled = None
        for task in self._mine:
            if not task.is_set:
                task.drop()
        self._mine.clear()

    def _settle(self) -> None:
        if self.alive and self.settled is not None:
            self.settled()

    @property
    def now(self) -> float:
        """The host's time."""
        return self._host.now

    @now.setter
    def now(self, _: float) -> None:
        raise AttributeError("time is the host's")

    def time(self) -> float:
        """Return the host's time."""
        return self._host.time()

    def at(self, when: float, kind: EventKind, key: Key, call: Call) -> Timer:
        """Call this at a time, unless it is cancelled, or the kernel killed."""
        return self._host.at(when, kind, key, self._while_alive(call))

    def spawn(self, coroutine: Coroutine[Any, Any, T], key: Key, name: str) -> Task[T]:
        """Set a coroutine on its way."""
        task = self._host.spawn(coroutine, key, name)
        self._mine[task] = None
        if len(self._mine) > 2 * len(self._host.tasks) + 100:
            self._mine = {task: None for task in self._mine if not task.is_set}
        return task

    def under_way(self) -> Sequence[Task[Any]]:
        """Return its own coroutines that have not ended."""
        return [task for task in self._mine if not task.is_set]

    def crash(self, error: BaseException) -> None:
        """An error that no coroutine caught stops the host as well: it is a mistake of ours."""
        self._host.crash(error)

    def _while_alive(self, call: Callable[[], object]) -> Call:
        def called() -> None:
            if self.alive:
                call()

        return called


class Living:
    """Drones and their gateway, and one brain after another."""

    def __init__(
        self,
        app: App,
        *missions: Mission[Any],
        on: FleetFile | None = None,
        faults: Faults = apps.NO_FAULTS,
        seed: int = 0,
    ) -> None:
        for index, mission in enumerate(missions):
            mission.index = index
        self.app, self.fleet, self.planned = app, on or apps.fleet(), missions
        self.kernel, self.memory = VirtualTime(), Memory({"event": "journal.begun"})
        drones = fleet_drones(app, self.fleet)
        space = self.fleet.airspace
        world = MovingWorld(seed, space, self.fleet.world)
        self.done_by_drones: list[tuple[str, str]] = []
        """What the drones really did: the action, and the item if there was one."""
        self.navigation = SimulatedNavigation(self.kernel, drones, world, faults, seed, self._see)
        self.gateway = Gateway(
            self.kernel, self.navigation, drones, space, ledger=Ledger(), measures=True
        )
        self.gateway.take_in = self.navigation.join
        self.gateway.rehearse = self.navigation.mishap
        if world.movers:
            self.gateway.tracker = self.navigation.tracks
        self.events: list[Event] = []
        self.done: Future[float] = Future()
        self._epoch = 0
        self._brain = Mortal(self.kernel)
        self.life = self._new_life()
        self.life.start(missions).watch(self._is_done)

    def _new_life(self) -> RecordedFlight:
        self._epoch += 1
        self._brain = Mortal(self.kernel)
        records = self.memory.standing()
        fleet = with_joined(self.app, self.fleet, records.joined)
        disk, link = _AtOnce(self.memory), self.gateway.link(self._epoch)
        life = RecordedFlight(
            self.app,
            fleet,
            self._brain,
            link,
            disk,
            records,
            epoch=self._epoch,
            listeners=[self.events.append],
            charges=fleet.charges_at_home,
        )
        life.in_simulation = True
        disk.life = life
        return life

    def _is_done(self, task: Future[float]) -> None:
        if task.error is None:  # else everything was stopped
            self.done.set(task.result())

    def at(self, when: float, call: Callable[[], object]) -> None:
        """Do something at a time."""
        self.kernel.at(when, EventKind.CLOCK, FLEET, call)

    def die(self) -> None:
        """Kill the brain."""
        self.gateway.cut()
        self._brain.kill()

    @property
    def lives(self) -> bool:
        """Whether a brain lives."""
        return self._brain.alive

    def live_on(self, app: App | None = None) -> None:
        """Begin another life, of the same app or of one that was changed."""
        self.app = app or self.app
        self.memory.reopen()
        self.life = self._new_life()
        self.life.go_on(self.planned).watch(self._is_done)

    def crash(self, when: float, *, down: float = 1.0, app: App | None = None) -> None:
        """Let the brain die at a time, and another begin some seconds later."""
        self.at(when, self.die)
        self.at(when + down, lambda: self.live_on(app))

    def stop(self, when: float, how: Down = Down.HOME, *, rest: float = 1.0) -> None:
        """Stop everything at a time, and go on when all was down for some seconds."""

        def stopped(_: object) -> None:
            self.at(self.kernel.now + 0.001, self.die)  # what was said last is written down
            self.at(self.kernel.now + rest, self.live_on)

        def now() -> None:
            self.life.control.stop(how)
            self.life.control.stopped.watch(stopped)

        self.at(when, now)

    def decide_at_rest(self, mission: str, answer: str) -> None:
        """Write a person's decision into the journal while no brain lives, and begin another life."""
        self.die()
        self.memory.append([decided(self.memory.standing(), mission, answer)])
        self.done = Future()
        self.live_on()

    def run(self, until: float = 100_000.0) -> list[str]:
        """Let time pass until all is done; return how the missions stand."""
        self.kernel.run(self.done, until)
        return self.statuses

    @property
    def statuses(self) -> list[str]:
        """How the missions stand."""
        return [mission.status.value for mission in self.life.missions]

    def named(self, kind: str) -> list[Event]:
        """Return the events of one kind, of all lives."""
        return [event for event in self.events if event["event"] == kind]

    def times(self, kind: str, trip: str | None = None) -> list[float]:
        """Return when events of one kind happened."""
        found = [event for event in self.named(kind) if trip in (None, event.get("trip"))]
        return [float(str(event["t"])) for event in found]

    def _see(self, deed: WorldAction) -> None:
        self.done_by_drones.append((deed.action, deed.item.name if deed.item else ""))


def names(events: Sequence[Event], fact: str) -> list[object]:
    """Return one fact of each event."""
    return [event.get(fact) for event in events]
