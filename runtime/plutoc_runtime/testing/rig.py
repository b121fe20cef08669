"""One trial: a world with its drones and a gateway lives on, and brains come and go.

World and brain have a virtual clock each, and take turns: whatever is due first is taken first, and
at one instant the world goes first. So a brain can die at any moment, and the drones fly on.
"""

from __future__ import annotations

import json
from collections import Counter, deque
from copy import deepcopy
from dataclasses import dataclass
from functools import partial
from random import Random
from typing import TYPE_CHECKING, Any

from ..errors import BadInput
from ..gateway.gateway import Gateway
from ..gateway.ledger import MemoryLedger
from ..journal.fold import Records
from ..kernel import FLEET, Cancelled
from ..kernel import Kind as When
from ..life import Life
from ..simulation.drones import SimulatedDrone, SimulatedNavigation
from ..simulation.faults import Faults
from ..simulation.world import World
from ..standing import Down
from ..virtual import VirtualTime
from .acts import Act, Once
from .blows import BY_HAND, DEATHS, STOPS, Blow, Kind
from .brain import BrainTime
from .invariants import ENDS, Invariants, items_of
from .survival import Known, forgotten, known_of
from .wire import Wire

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..app import App
    from ..simulation.deeds import Deed
    from ..trace import Event
    from .case import Case

PATIENCE = 3.0
"""Seconds without a brain after which the gateway lands everything."""
STOPPED = 45.0
"""Seconds for which an app that was stopped stays so."""
THINKS = 20.0
"""Seconds after which a person looks, and decides."""
MOST_LIVES = 40
LONGEST = 7 * 86_400.0
"""Seconds. A mission that has not ended by then never will."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """What came of a case."""

    violations: tuple[str, ...]
    fired: Counter[str]
    """How often each thing really struck."""
    rows: int
    """Of the journal, over all lives."""
    lives: int
    ends: dict[str, str]
    """By mission, how it ended."""
    events: tuple[Event, ...]
    """All that is on record."""


def tried(app: App, case: Case) -> Trial:
    """Fly a case to its end, and say what no run may do and this one did."""
    return _Rig(app, case).run()


class _Rig:
    def __init__(self, app: App, case: Case) -> None:
        self.app, self.case = app, case
        self.fired: Counter[str] = Counter()
        self.chance = Random(f"{case.seed}/trial")
        self.world = world = VirtualTime()
        self.acts: list[Act] = []
        categories = {category.name: category for category in app.categories}
        self.drones = [
            SimulatedDrone(
                id=each.id, category=categories[each.category], home=each.home, index=place
            )
            for place, each in enumerate(case.fleet.drones)
        ]
        airspace = case.fleet.airspace
        self.navigation = SimulatedNavigation(
            world,
            self.drones,
            World(case.seed, airspace, case.fleet.world),
            Faults(
                crash=case.weather.crash,
                link=case.weather.link,
                action=case.weather.action,
                battery=case.weather.battery,
            ),
            case.seed,
            airspace,
            self.done,
        )
        self.ledger = MemoryLedger()
        self.gateway = self.new_gateway()
        self.brain: _Brain | None = None
        self.rows: list[str] = []
        """What is durable."""
        self.count = self.lives = 0
        self.skew = 0.0
        """How far the brain's clock is ahead of the world's."""
        self.events: list[Event] = []
        self.known: dict[str, Known] = {}
        self.ends: dict[str, str] = {}
        items = items_of(case.missions)
        self.invariants = Invariants(items)
        self.once = Once({name: action.repeat for name, action in app.actions.items()})
        self.found: list[str] = []
        self.over = False

    # The whole

    def run(self) -> Trial:
        self.be_born()
        while not self.over:
            if not self.turn():
                break
        whole = all(self.ends.get(mission.name) in ENDS for mission in self.case.missions)
        found = self.invariants.over() if whole or not self.found else self.invariants.found
        violations = [*self.found, *found, *self.once.violations(self.acts)]
        self.forget_all()
        return Trial(
            violations=tuple(violations),
            fired=self.fired,
            rows=self.count,
            lives=self.lives,
            ends=self.ends,
            events=tuple(self.events),
        )

    def turn(self) -> bool:
        """Take whatever is due next; False: nothing ever will be."""
        world, brain = self.world, self.brain
        at = world.next_time()
        due = None if brain is None else brain.kernel.next_time()
        if due is not None and (at is None or due - self.skew < at):
            assert brain is not None
            brain.kernel.now, world.now = due, max(world.now, due - self.skew)
        elif at is not None:
            world.now = at
            if brain is not None:
                brain.kernel.now = max(brain.kernel.now, at + self.skew)
        else:
            self.found.append(f"nothing will ever happen again; waiting: {self.waiting()}")
            return False
        if world.now > LONGEST:
            self.found.append(f"it goes on for ever; waiting: {self.waiting()}")
            return False
        world.drain()
        self.raise_from(world)
        if brain is not None and brain is self.brain:
            brain.take_turn()
        return True

    def waiting(self) -> str:
        brain = self.brain
        tasks = [] if brain is None else [task.name for task in brain.kernel.tasks]
        return ", ".join(sorted(tasks)) or "nobody"

    def raise_from(self, kernel: VirtualTime) -> None:
        """An error that nobody caught is a mistake of ours: the trial ends with it."""
        if kernel.crashed is not None:
            error, kernel.crashed = kernel.crashed, None
            self.blame(error)

    def blame(self, error: BaseException) -> None:
        """Nobody has caught it."""
        self.found.append(f"{self.world.now:g} s: {type(error).__name__}: {error}")
        self.over = True

    def later(self, seconds: float, call: Callable[[], object]) -> None:
        self.world.schedule(self.world.now + seconds, When.FLIGHT, FLEET, call)

    def forget_all(self) -> None:
        if self.brain is not None:
            self.brain.die()
        self.world.close()

    # Lives

    def new_gateway(self) -> Gateway:
        fleet = self.case.fleet
        return Gateway(
            self.world,
            self.navigation,
            self.drones,
            fleet.airspace,
            ledger=self.ledger,
            apart=fleet.apart,
        )

    def be_born(self) -> None:
        """A brain begins, or goes on."""
        if self.brain is not None or self.over:
            return
        self.lives += 1
        if self.lives > MOST_LIVES:
            self.found.append(f"it was started {MOST_LIVES} times, and is not done")
            self.over = True
            return
        if self.lives > 1 and self.case.weather.jump:
            self.fired["clock jump"] += 1
            self.skew += self.case.weather.jump
        self.brain = _Brain(self, self.records())

    def records(self) -> Records:
        """Read the journal, from a snapshot of half of it if that is asked for."""
        records, rows = Records(), iter(self.rows)
        if self.rows and self.chance.random() < self.case.weather.snapshot:
            for _ in range(self.chance.randrange(len(self.rows)) + 1):
                for event in json.loads(next(rows)):
                    records.take(event)
            self.fired["snapshot"] += 1
            records = Records(json.loads(json.dumps(records.data)))
        for row in rows:
            for event in json.loads(row):
                records.take(event)
        return records

    def lose_brain(self, down: float) -> None:
        """The brain is dead; the gateway notices at once, or when the heartbeat is missing."""
        brain, self.brain = self.brain, None
        if brain is None:
            return
        if self.lives > 1 and brain.added <= 1:
            self.fired["death in recovery"] += 1
        gateway = self.gateway
        brain.wire.alive = False
        if self.chance.random() < 0.5:
            gateway.cut()
            brain.die()
        else:
            brain.corpse()

        def land() -> None:
            if self.brain is None and self.gateway is gateway and gateway.flies:
                self.fired["failsafe"] += 1
                gateway.fail_safe(Down.LAND)

        if down > PATIENCE:
            self.later(PATIENCE, land)
        self.later(down, self.be_born)

    def ended(self, brain: _Brain) -> None:
        """A life came to its end by itself: everything has ended, or waits for a person."""
        self.brain = None
        brain.wire.alive = False
        self.gateway.cut()
        brain.die()
        waits = [m for m in self.case.missions if self.ends.get(m.name) not in ENDS]
        if not waits:
            self.over = True
        elif self.decide_at_rest(brain):
            self.later(THINKS, self.be_born)
        else:
            names = ", ".join(mission.name for mission in waits)
            self.found.append(f"{self.world.now:g} s: it ended, and {names} had not")
            self.over = True

    # On record

    def commit(self, row: str, events: list[Event], known: dict[str, Known]) -> None:
        """A row is durable."""
        self.rows.append(row)
        self.known.update(known)
        for event in events:
            self.events.append(event)
            self.invariants.take(event)
            self.once.take(event)
            if event["event"] == "mission.ended":
                self.ends[str(event["mission"])] = str(event["status"])

    def decide_at_rest(self, brain: _Brain) -> bool:
        """A person decides what waits, on the journal of an app that does not run."""
        decided = False
        for name, record in brain.life.recorder.records.missions.items():
            if record["ended"] or not (record["question"] or record["held"]):
                continue
            answer = self.answer(brain, name)
            event = {
                "t": brain.life.recorder.records.time,
                "event": "mission.decided",
                "mission": name,
                "answer": answer,
            }
            self.fired["decision at rest"] += 1
            self.commit(json.dumps([event]), [event], {})
            decided = True
        return decided

    def answer(self, brain: _Brain, name: str) -> str:
        """Say the truth: the person looks whether it was done."""
        record = brain.life.recorder.records.missions[name]
        if record["held"]:
            return "cancel"
        flight = record["flight"]
        job = f"{name}/{flight['trip']}/{flight['round']}/{flight['attempt']}"
        done = any(act.job == job for act in self.acts)
        return "done" if done else "not-done"

    def done(self, deed: Deed) -> None:
        """A drone has done something to the world."""
        if deed.job is not None:
            self.acts.append(Act(job=deed.job, action=deed.action, time=self.world.now))

    def hook_done(self, hook: Callable[..., object], args: tuple[object, ...]) -> None:
        """An action of the app's own was done: that is seen in the world."""
        for name, action in self.app.actions.items():
            if action.hook is hook:
                context: Any = args[2]
                job = context._state.flight.id
                self.acts.append(Act(job=job, action=name, time=self.world.now))


class _Brain:
    """One life, in the rig."""

    def __init__(self, rig: _Rig, records: Records) -> None:
        self.rig, case = rig, rig.case
        now = max(rig.world.now + rig.skew, records.time)
        rig.skew = now - rig.world.now
        self.kernel = BrainTime(now, case.weather, rig.chance, rig.fired, rig.hook_done)
        link = rig.gateway.link(rig.lives, self.lost)
        self.wire = Wire(link, rig.gateway, self.kernel, case.weather.slow, rig.fired)
        self.added = self.committed = 0
        self.unwritten: deque[tuple[int, str, list[Event], dict[str, Known]]] = deque()
        self.full = False
        fresh = not records.missions
        self.before = {} if fresh else dict(rig.known)
        self.life = Life(
            rig.app,
            case.fleet,
            self.kernel,
            self.wire,
            self,
            records,
            epoch=rig.lives,
        )
        self.life.control.stopped.watch(self.stopped)
        self.task = self.life.go_on(deepcopy(case.missions))
        self.due: list[Callable[[], object]] = []
        rig.later(THINKS, self.person)

    def take_turn(self) -> None:
        """Let it do what is due."""
        kernel, rig = self.kernel, self.rig
        kernel.drain()
        if kernel.settled is not None:
            kernel.settled()
        rig.raise_from(kernel)
        due, self.due = self.due, []
        for call in due:
            call()
        error = self.task.error
        if rig.brain is not self or not self.task.is_set or isinstance(error, Cancelled):
            return
        if error is not None:
            rig.blame(error)
        elif self.committed == self.added:  # else what happened last is not durable yet
            rig.ended(self)

    # The journal

    def add(self, row: str) -> int:
        """Take the row of an instant."""
        rig = self.rig
        self.added += 1
        rig.count += 1
        events: list[Event] = json.loads(row)
        touched = {str(event["mission"]) for event in events if "mission" in event}
        known = {
            mission.name: known_of(rig.app, mission)
            for mission in self.life.recorder.missions.values()
            if mission.name in touched
        }
        self.look_back(events)
        struck = [blow for blow in rig.case.blows if blow.row == rig.count]
        kinds = {blow.kind for blow in struck if not blow.after}
        if Kind.DISK in kinds:
            self.full = True
            rig.fired["disk full"] += 1
            rig.later(0.5, partial(self.die_of, "disk full"))
        lost = self.full or Kind.LOST in kinds
        if not lost:
            self.unwritten.append((self.added, row, events, known))
            commit = partial(self.commit, self.added, Kind.KEPT not in kinds)
            if kinds & {Kind.KEPT, Kind.CRASH} or not rig.case.weather.disk:
                self.due.append(commit)
            else:
                rig.fired["slow disk"] += 1
                rig.later(rig.case.weather.disk, commit)
        for blow in struck:
            if blow.kind is not Kind.DISK:
                self.due.append(partial(self.plan, blow, events))
        return self.added

    def commit(self, number: int, told: bool) -> None:
        """All rows up to this one are durable, if the disk was as fast as the brain's death."""
        if self.rig.brain is not self or self.full or number <= self.committed:
            return
        while self.unwritten and self.unwritten[0][0] <= number:
            self.committed, row, events, known = self.unwritten.popleft()
            self.rig.commit(row, events, known)
        if told:
            self.kernel.post(self.life.recorder.durable, number)

    def look_back(self, events: list[Event]) -> None:
        """See, once it is known again, what has been forgotten since the last life."""
        now = {mission.name: mission for mission in self.life.missions}
        if not now:
            return
        before, self.before = self.before, {}
        for name, known in before.items():
            if name not in now:
                self.rig.found.append(f"{name} was forgotten")
            elif self.rig.ends.get(name) not in ENDS:
                after = known_of(self.rig.app, now[name])
                said = forgotten(name, known, after, events)
                self.rig.found += [f"{self.kernel.now:g} s: {sentence}" for sentence in said]

    # What strikes

    def plan(self, blow: Blow, events: list[Event]) -> None:
        if blow.after:
            self.rig.later(blow.after, partial(self.strike, blow, events))
        else:
            self.strike(blow, events)

    def strike(self, blow: Blow, events: list[Event]) -> None:
        """Something strikes: the brain that wrote the row, or whichever lives by now."""
        rig, kind = self.rig, blow.kind
        brain = rig.brain
        if kind is Kind.GATEWAY:
            rig.fired[kind.value] += 1
            self.lose_gateway()
        elif kind is Kind.REBOOT:
            named = [str(event["drone"]) for event in events if event.get("drone")]
            rig.fired[kind.value] += 1
            rig.navigation.reboot((named or [rig.drones[0].id])[-1])
        elif brain is None:
            return
        elif kind in DEATHS:
            rig.fired[kind.value] += 1
            rig.lose_brain(rig.case.weather.down)
        elif kind is Kind.CUT:
            rig.fired[kind.value] += 1
            rig.gateway.cut()
        elif kind in STOPS:
            rig.fired[kind.value] += 1
            how = Down.HOME if kind is Kind.RTL else Down.LAND
            brain.kernel.post(brain.life.control.stop, how)
        elif kind in BY_HAND:
            brain.by_hand(kind, events)

    def by_hand(self, kind: Kind, events: list[Event]) -> None:
        named = [str(event["mission"]) for event in events if event.get("mission")]
        mission = (named or [mission.name for mission in self.rig.case.missions])[-1]
        control = self.life.control
        tell: dict[Kind, Callable[[str], str]] = {
            Kind.PAUSE: control.pause,
            Kind.SKIP: control.skip,
            Kind.CANCEL: control.cancel,
        }
        if self.told(partial(tell[kind], mission)):
            self.rig.fired[kind.value] += 1
            if kind is Kind.PAUSE:
                self.rig.later(THINKS, self.person)

    def told(self, command: Callable[[], object]) -> bool:
        try:
            command()
        except BadInput:
            return False
        return True

    def person(self) -> None:
        """Somebody looks, lets go on what is paused, and decides what waits."""
        rig = self.rig
        if rig.brain is not self:
            return
        if self.told(self.life.control.go_on):
            rig.fired["go on"] += 1
        for name, record in list(self.life.recorder.records.missions.items()):
            if not record["ended"] and (record["question"] or record["held"]):
                decide = partial(self.life.control.decide, name, rig.answer(self, name))
                if self.told(decide):
                    rig.fired["decision"] += 1
        if any(record["paused"] for record in self.life.recorder.records.missions.values()):
            rig.later(THINKS, self.person)

    def lost(self) -> None:
        """Brain and gateway have lost one another: the brain begins anew from its own journal."""
        if self.rig.brain is self:
            self.rig.lose_brain(0.5)

    def lose_gateway(self) -> None:
        rig = self.rig
        rig.gateway.crash()
        rig.gateway = rig.new_gateway()

    def die_of(self, _: str) -> None:
        if self.rig.brain is self:
            self.rig.lose_brain(self.rig.case.weather.down)

    def stopped(self, _: object) -> None:
        """Everything is down: somebody goes on later."""
        self.due.append(self.rest)

    def rest(self) -> None:
        if self.rig.brain is self:
            self.rig.brain = None
            self.wire.alive = False
            self.rig.gateway.cut()
            self.die()
            self.rig.later(STOPPED, self.rig.be_born)

    def corpse(self) -> None:
        """Nobody has noticed yet: what it was doing in the air goes on to its end."""

    def die(self) -> None:
        """Nothing of it goes on."""
        self.kernel.over = True
        self.kernel.close()
