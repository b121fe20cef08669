"""One trial: a world with its drones and a gateway lives on, and brains come and go.

World and brain have a virtual clock each, and take turns: whatever is due first is taken first, and
at one instant the world goes first. So a brain can die at any moment, and the drones fly on.
"""

from __future__ import annotations

import json
import re
from collections import Counter
from dataclasses import dataclass
from random import Random
from typing import TYPE_CHECKING, Any

from ..gateway.gateway import Gateway
from ..gateway.ledger import MemoryLedger
from ..gateway.line import LOST, Line
from ..journal.fold import Records
from ..kernel import FLEET
from ..kernel import Kind as When
from ..simulation.drones import SimulatedDrone, SimulatedNavigation
from ..simulation.faults import Faults
from ..simulation.radio import Radio
from ..simulation.world import World
from ..standing import Down
from ..virtual import VirtualTime
from .acts import Act, Once
from .blows import Blow, Kind
from .brain import BrokenHook
from .invariants import ENDS, Invariants, items_of
from .living import THINKS, Living
from .rule import at
from .survival import Known

if TYPE_CHECKING:
    from collections.abc import Callable

    from ..app import App
    from ..navigation import Navigation
    from ..simulation.deeds import Deed
    from ..trace import Event
    from .case import Case

PATIENCE = 3.0
"""Seconds without a brain after which the gateway lands everything."""
PULSES = 20
"""Seconds for which a brain goes on after another has taken over."""
MOST_LIVES = 40
LONGEST = 7 * 86_400.0
"""Seconds. A mission that has not ended by then never will."""

_IN_A_HOOK = re.compile(
    r"(hook|policy|evaluator|modifier) \w+ "
    r"(raised|must|changed|asks|adds|declares|returned|made|took|left)\b"
)
"""How the reason begins for which a mission fails when the app's own code is at fault."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """What came of a case."""

    violations: tuple[str, ...]
    """What no run may do, whatever the app's own code does."""
    faults: tuple[str, ...]
    """What the app's own code did wrong without being made to."""
    fired: Counter[str]
    """How often each thing really struck."""
    rows: int
    """Of the journal, over all lives."""
    lives: int
    ends: dict[str, str]
    """By mission, how it ended."""
    events: tuple[Event, ...]
    """All that is on record."""
    times: tuple[float, ...]
    """When each row was written, by the world's clock."""
    acts: tuple[Act, ...]
    """What the world has seen."""

    @property
    def wrong(self) -> tuple[str, ...]:
        """All that should not be."""
        return (*self.violations, *self.faults)


def tried(app: App, case: Case) -> Trial:
    """Fly a case to its end, and say what no run may do and this one did."""
    return Rig(app, case).run()


class Rig:
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
        self.loses_report = False
        """Whether the next report is lost, and the line with it."""
        self.gateway = self.new_gateway()
        self.brain: Living | None = None
        self.rows: list[str] = []
        """What is durable."""
        self.times: list[float] = []
        """When each row was written, durable or not."""
        self.count = self.lives = 0
        self.skew = 0.0
        """How far the brain's clock is ahead of the world's."""
        self.events: list[Event] = []
        self.known: dict[str, Known] = {}
        self.ends: dict[str, str] = {}
        items = items_of(case.missions)
        self.invariants = Invariants(items)
        self.once = Once({name: action.repeat for name, action in app.actions.items()})
        self.strikes: dict[int, list[Blow]] = {}
        """By row, what strikes there."""
        for blow in case.blows:
            self.strikes.setdefault(blow.row, []).append(blow)
        self.found: list[str] = []
        self.faults: list[str] = []
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
            faults=tuple(self.faults),
            fired=self.fired,
            rows=self.count,
            lives=self.lives,
            ends=self.ends,
            events=tuple(self.events),
            times=tuple(self.times),
            acts=tuple(self.acts),
        )

    def turn(self) -> bool:
        """Take whatever is due next; False: nothing ever will be."""
        world, brain = self.world, self.brain
        at = world.next_time()
        if brain is not None:
            due = brain.kernel.next_time()
            if due is not None and (at is None or due - brain.skew < at):
                brain.kernel.now, world.now = due, max(world.now, due - brain.skew)
                brain.take_turn()
                return self.has_time()
            if at is not None:
                brain.kernel.now = max(brain.kernel.now, at + brain.skew)
        if at is None:
            self.found.append(f"nothing will ever happen again; waiting: {self.waiting()}")
            return False
        world.now = at
        world.drain()
        if world.crashed is not None:
            self.raise_from(world)
        if brain is not None and brain is self.brain:
            brain.take_turn()
        return self.has_time()

    def has_time(self) -> bool:
        """Whether a mission that has not ended may still do so."""
        if self.world.now > LONGEST:
            self.found.append(f"it goes on for ever; waiting: {self.waiting()}")
            return False
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
        fleet, radio = self.case.fleet, self.case.weather.radio
        navigation: Navigation = self.navigation
        if radio:
            navigation = Radio(self.world, self.navigation, self.radio_delay)
        gateway = Gateway(
            self.world,
            navigation,
            self.drones,
            fleet.airspace,
            ledger=self.ledger,
            apart=fleet.apart,
        )
        if any(blow.kind is Kind.REPORT for blow in self.case.blows):
            gateway.line = Line(gateway, self.fate)
        return gateway

    def radio_delay(self, _: str) -> float:
        self.fired["slow radio"] += 1
        return self.case.weather.radio

    def fate(self) -> float:
        """Say whether a report is heard."""
        lost, self.loses_report = self.loses_report, False
        return LOST if lost else 0.0

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
        self.brain = Living(self, self.records())

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
        brain.remember()
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

    def freeze(self) -> None:
        """The brain stands still; another takes over; then the first goes on, none the wiser."""
        brain, self.brain = self.brain, None
        if brain is not None:
            brain.remember()
            self.later(self.case.weather.down, self.be_born)
            for pulse in range(PULSES):
                self.later(self.case.weather.down + 1.0 + pulse, brain.haunt)
            self.later(self.case.weather.down + 1.0 + PULSES, brain.die)

    def ended(self, brain: Living) -> None:
        """A life came to its end by itself: everything has ended, or waits for a person."""
        self.brain = None
        brain.remember()
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

    def commit(self, row: str, events: list[Event]) -> None:
        """A row is durable."""
        self.rows.append(row)
        for event in events:
            self.events.append(event)
            self.invariants.take(event)
            self.once.take(event)
            if event["event"] == "mission.ended":
                self.ends[str(event["mission"])] = str(event["status"])
                reason = str(event["reason"])
                if _IN_A_HOOK.match(reason) and BrokenHook.__name__ not in reason:
                    self.faults.append(f"{at(event)}: {event['mission']} failed: {reason}")

    def decide_at_rest(self, brain: Living) -> bool:
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
            self.commit(json.dumps([event]), [event])
            decided = True
        return decided

    def answer(self, brain: Living, name: str) -> str:
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
