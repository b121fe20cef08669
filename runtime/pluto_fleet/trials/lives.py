"""The runs of an app in a trial: their journals, their faults, and their ends."""

from __future__ import annotations

import gc
import json
from collections import deque
from collections.abc import Callable, Mapping
from functools import partial
from random import Random

from ..app import App
from ..flight.recorded_flight import RecordedFlight
from ..gateway.gateway import Gateway
from ..gateway.ledger import Ledger
from ..jobs.controls import Controls, fleet_drones
from ..jobs.reports import Down
from ..journal.standing import Record, Standing
from ..journal.store import Entry
from ..process.signal_guard import by_a_person
from ..shared.alone.world import FAULTS, Faults
from ..shared.domain.errors import ANY_ERROR, BadInput, Cancelled, Failure
from ..shared.domain.trace import Event
from ..shared.events.world import MovingWorld
from ..shared.time.kernel import FLEET, EventKind
from ..shared.time.told import VirtualTime
from ..simulation.drones import SimulatedNavigation, WorldAction
from ..simulation.radio import Radio
from .case import (
    BY_HAND,
    DEATHS,
    STOPS,
    Case,
    Strike,
    StrikeKind,
    fresh,
)
from .record import Memory, TrialRecord, TrialResult, forgotten, memory_of
from .rules import ENDS
from .unreliable import UnreliableHooks, UnreliableLink, UnreliableTime

HEARTBEAT_WITHIN = 3.0
"""Seconds without a heartbeat after which the gateway lands everything."""
UNAWARE_FOR = 20
"""Seconds for which a stale brain goes on after another has taken over."""
MOST_LIVES = 40
LONGEST_TRIAL = 7 * 86_400.0
"""Seconds, without delays, after which a mission counts as endless."""
PERSON_LOOKS_AFTER = 20.0
"""Seconds after which the simulated user answers questions."""
STOPPED_FOR = 45.0
"""Seconds after which a stopped app is resumed."""

_read = json.JSONDecoder().raw_decode
"""Parses a row, which is exactly one JSON list."""

_NONE: frozenset[StrikeKind] = frozenset()


class TrialLife:
    """One run of the app within a trial."""

    def __init__(self, run: TrialRun, records: Standing) -> None:
        self.run, case = run, run.case
        now = max(run.world.now + run.skew, records.time)
        self.skew = run.skew = now - run.world.now
        self.kernel = UnreliableTime(now, case.weather, run.chance, run.fired)
        hooks = UnreliableHooks(
            self.kernel, case.weather, run.chance, run.fired, self.hook_returned
        )
        line = run.gateway.link(run.lives, self.lost)
        self.wire = UnreliableLink(
            line, self.kernel, case.weather.slow, run.fired, self.sent, run.report_is_lost
        )
        self.added = self.committed = 0
        self.unwritten: deque[tuple[int, Entry, list[Event]]] = deque()
        self.named = dict.fromkeys(run.record.known)
        """The missions that the journal has heard of: one begun as the app dies is in no entry yet."""
        self.unknown: dict[str, None] = {}
        """The missions with events that are not durable."""
        self.full = False
        planned = () if records.missions else tuple(map(fresh, case.missions))
        self.before: dict[str, Memory] = {} if planned else dict(run.record.known)
        self.life = RecordedFlight(
            run.app, case.fleet, self.kernel, self.wire, self, records, epoch=run.lives, hooks=hooks
        )
        self.life.in_simulation = True
        hooks.ended = self.life.hook_ended
        self.life.control.stopped.watch(self.stopped)
        self.task = self.life.go_on(planned)
        self.due: list[Callable[[], object]] = []
        run.later(PERSON_LOOKS_AFTER, self.person)

    def take_turn(self) -> None:
        """Process what is due."""
        kernel, run = self.kernel, self.run
        kernel.drain()
        if kernel.settled is not None:
            kernel.settled()
        if kernel.crashed is not None:
            run.raise_from(kernel)
        if self.due:
            due, self.due = self.due, []
            for call in due:
                call()
        if not self.task.is_set:
            return
        error = self.task.error
        if run.brain is not self or isinstance(error, Cancelled):
            return
        if error is not None:
            run.blame(error)
        elif self.committed == self.added:  # else the last events are not durable yet
            run.ended(self)

    def hook_returned(self, hook: Callable[..., object], args: tuple[object, ...]) -> None:
        """Apply an action of the app's own to the world, if its drone is still there."""
        if self.run.brain is self:
            self.run.record.hook_did(hook, args, self.run.world.now)

    def go_on_unaware(self) -> None:
        """Continue as a stale brain after another has taken over."""
        self.kernel.now = max(self.kernel.now, self.run.world.now + self.skew)
        self.kernel.drain()
        if self.kernel.settled is not None:
            self.kernel.settled()

    def sent(self, job: str) -> None:
        """Called when a job is given to a drone."""
        if self.run.brain is self and not self.run.record.once.knows(job):
            self.run.found.append(f"{self.kernel.now:g} s: {job} set out before that was on record")

    # The journal

    def add(self, entry: Entry) -> int:
        """Add the entry of an instant."""
        run = self.run
        self.added += 1
        if run.brain is not self:  # another run has the journal by now
            return self.added
        run.record.times.append(run.world.now)
        events: list[Event] = _read(entry.events)[0]
        self.named.update((str(event["mission"]), None) for event in events if "mission" in event)
        if self.before:
            self.look_back(events)
        struck = run.strikes.get(len(run.record.times))
        kinds = {strike.kind for strike in struck if not strike.after} if struck else _NONE
        if StrikeKind.DISK in kinds:
            self.full = True
            run.fired[StrikeKind.DISK.value] += 1
            run.later(0.5, partial(self.lost, run.case.weather.down))
        if self.full or StrikeKind.LOST in kinds:
            self.forget(events)
        else:
            self.unwritten.append((self.added, entry, events))
            commit = partial(self.commit, self.added, StrikeKind.KEPT not in kinds)
            if kinds & {StrikeKind.KEPT, StrikeKind.CRASH} or not run.case.weather.disk:
                self.due.append(commit)
            else:
                run.fired["slow disk"] += 1
                run.later(run.case.weather.disk, commit)
        for strike in struck or ():
            if strike.kind is not StrikeKind.DISK:
                self.due.append(partial(self.plan, strike, events))
        return self.added

    def commit(self, number: int, told: bool) -> None:
        """Make all rows up to this one durable, unless the brain dies first."""
        if self.run.brain is not self or self.full or number <= self.committed:
            return
        while self.unwritten and self.unwritten[0][0] <= number:
            self.committed, entry, events = self.unwritten.popleft()
            self.run.record.commit(entry, events)
        if told:
            self.life.recorder.durable(number)

    def forget(self, events: list[Event]) -> None:
        """Exclude what is not durable from the comparison with the next run."""
        self.unknown.update((str(event["mission"]), None) for event in events if "mission" in event)

    def remember(self) -> None:
        """Note at the end of this run what the next one must restore."""
        for _, _, events in self.unwritten:
            self.forget(events)
        for name, record in self.standing().items():
            if name in self.unknown or name not in self.named:
                self.run.record.known.pop(name, None)
            else:
                self.run.record.known[name] = memory_of(record)

    def standing(self) -> Mapping[str, Record]:
        """Return where each mission stands."""
        missions: Mapping[str, Record] = self.life.brain.standing()["missions"]
        return missions

    def look_back(self, events: list[Event]) -> None:
        """Report what this run has not restored of the last one."""
        if not self.life.is_set_out:
            return
        now = self.standing()
        before, self.before = self.before, {}
        since: dict[str, list[Event]] = {}
        for event in events:
            since.setdefault(str(event.get("mission")), []).append(event)
        found = self.run.found
        for name, known in before.items():
            if name not in now:
                found.append(f"{name} was forgotten")
            elif self.run.record.ends.get(name) not in ENDS:
                after = memory_of(now[name])
                said = forgotten(name, known, after, since.get(name, ()))
                found += [f"{self.kernel.now:g} s: {sentence}" for sentence in said]
        results = len(self.life.brain.standing()["results"])
        if results < self.run.record.once.done:
            found.append(f"{self.run.record.once.done} results were there, {results} are left")

    # What strikes

    def plan(self, strike: Strike, events: list[Event]) -> None:
        if strike.after:
            self.run.later(strike.after, partial(self.strike, strike, events))
        else:
            self.strike(strike, events)

    def strike(self, strike: Strike, events: list[Event]) -> None:
        """Apply a strike to the brain that wrote the row, or to the present one."""
        if self.struck(strike.kind, events):
            self.run.fired[strike.kind.value] += 1

    def struck(self, kind: StrikeKind, events: list[Event]) -> bool:
        """Apply a strike; return False if it was not applicable."""
        run, brain = self.run, self.run.brain
        if kind is StrikeKind.GATEWAY:
            run.gateway.crash()
            run.gateway = run.new_gateway()
        elif kind in (StrikeKind.REBOOT, StrikeKind.FALL):
            named = [str(event["drone"]) for event in events if event.get("drone")]
            drone = (named or [run.drones[0].id])[-1]
            if kind is StrikeKind.FALL:
                flies = not run.navigation.telemetry[drone].landed
                return flies and run.navigation.strike(drone, Failure.CRASH)
            run.navigation.reboot(drone)
        elif kind is StrikeKind.REPORT:
            run.loses_report = True
        elif brain is None:
            return False
        elif kind in DEATHS:
            run.lose_brain(run.case.weather.down)
        elif kind is StrikeKind.FREEZE:
            run.freeze()
        elif kind is StrikeKind.CUT:
            run.gateway.cut()
        elif kind in STOPS:
            brain.kernel.post(
                brain.life.control.stop, Down.HOME if kind is StrikeKind.RTL else Down.LAND
            )
        elif kind in BY_HAND:
            return brain.by_hand(kind, events)
        return True

    def by_hand(self, kind: StrikeKind, events: list[Event]) -> bool:
        """Give a user's command; return whether the app could receive it."""
        named = [str(event["mission"]) for event in events if event.get("mission")]
        mission = (named or [mission.name for mission in self.run.case.missions])[-1]
        control = self.life.control
        tell: dict[StrikeKind, Callable[[str], str]] = {
            StrikeKind.PAUSE: control.pause,
            StrikeKind.SKIP: control.skip,
            StrikeKind.CANCEL: control.cancel,
        }
        told = self.told(partial(tell[kind], mission))
        if told and kind is StrikeKind.PAUSE:
            self.run.later(PERSON_LOOKS_AFTER, self.person)
        return told

    def told(self, command: Callable[[], object]) -> bool:
        """Send a command to the app; return whether it could receive it."""
        if self.task.is_set:  # it is about to end, and receives nothing any more
            return False
        try:
            command()
        except BadInput:
            return False
        return True

    def person(self) -> None:
        """Resume paused missions and answer questions, as a user would."""
        run = self.run
        if run.brain is not self:
            return
        if self.told(self.life.control.go_on):
            run.fired["go on"] += 1
        for name, record in list(self.life.recorder.standing.missions.items()):
            if not record["ended"] and (record["question"] or record["held"]):
                decide = partial(
                    self.life.control.decide,
                    name,
                    run.record.answer(name, self.life.recorder.standing),
                )
                if self.told(decide):
                    run.fired["decision"] += 1
        if any(record["paused"] for record in self.life.recorder.standing.missions.values()):
            run.later(PERSON_LOOKS_AFTER, self.person)

    def lost(self, down: float = 0.5) -> None:
        """Restart the brain from its journal: it has lost the gateway, or cannot write."""
        if self.run.brain is self:
            self.run.lose_brain(down)

    def stopped(self, _: object) -> None:
        """Called when a Stop is complete: it is resumed later."""
        self.due.append(self.rest)

    def rest(self) -> None:
        if self.run.brain is self:
            self.run.brain = None
            self.remember()
            self.wire.alive = False
            self.run.gateway.cut()
            self.die()
            self.run.later(STOPPED_FOR, self.run.start_life)

    def die(self) -> None:
        """End this run at once."""
        if self.kernel.dead:
            return
        self.kernel.over = self.kernel.dead = True
        self.life.halt()
        self.kernel.close()


class TrialRun:
    """A trial: a world, and the app's runs in it.

    MovingWorld and brain have a virtual clock each; what is due first is processed first, and at one instant
    the world goes first. So a brain can die at any moment, and the drones fly on.
    """

    def __init__(self, app: App, case: Case) -> None:
        self.app = app
        self.case = case
        self.record = TrialRecord(app, case)
        self.fired = self.record.fired
        self.found = self.record.found
        self.chance = Random(f"{case.seed}/trial")
        self.world = world = VirtualTime()
        self.drones = fleet_drones(app, case.fleet)
        airspace = case.fleet.airspace
        self.navigation = SimulatedNavigation(
            world,
            self.drones,
            MovingWorld(case.seed, airspace, case.fleet.world),
            Faults(**{name: getattr(case.weather, name) for name in FAULTS}),
            case.seed,
            self.seen,
        )
        self.ledger = Ledger()
        self.loses_report = False
        """Whether the next report is lost, and the connection with it."""
        self.gateway = self.new_gateway()
        self.lives = 0
        self.skew = 0.0
        """How many seconds the brain's clock is ahead of the world's."""
        self.strikes: dict[int, list[Strike]] = {}
        """The strikes by row."""
        for strike in case.strikes:
            self.strikes.setdefault(strike.row, []).append(strike)
        self.over = False
        self.brain: TrialLife | None = None
        self.brains: list[TrialLife] = []
        """All brains, also stale ones that go on."""

    def run(self) -> TrialResult:
        """Run until everything has ended, or counts as endless."""
        try:
            self.run_lives()
            return self.record.closed(self.lives)
        finally:
            for brain in self.brains:
                brain.die()
            self.world.close()

    def run_lives(self) -> None:
        """Run the app again and again; an uncaught error is a finding."""
        try:
            self.start_life()
            while not self.over and self.turn():
                pass
        except ANY_ERROR as error:  # in a callback outside of any task, such as the end of a flight
            if by_a_person(error):
                raise
            self.blame(error)

    def turn(self) -> bool:
        """Process what is due next; return False if nothing ever will be."""
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
        if self.record.endless and not self.over:
            why = f"{self.record.endless} sets out again and again, and nothing ends that"
            self.found.append(f"{self.world.now:g} s: {why}")
            return False
        if self.world.now > LONGEST_TRIAL + self.record.delays and not self.over:
            self.found.append(f"it goes on for ever; waiting: {self.waiting()}")
            return False
        return True

    def waiting(self) -> str:
        """Return the waiting tasks, for a message."""
        brain = self.brain
        tasks = [] if brain is None else [task.name for task in brain.kernel.tasks]
        return ", ".join(sorted(tasks)) or "nothing"

    def start_life(self) -> None:
        """Start a run, or resume one."""
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
        self.brain = TrialLife(self, self.record.standing())
        self.brains.append(self.brain)

    def lose_brain(self, down: float) -> None:
        """Handle a dead brain: the gateway notices at once, or by the missing heartbeat."""
        brain, self.brain = self.brain, None
        if brain is None:
            return
        brain.remember()
        if self.lives > 1 and brain.added <= 1:
            self.fired["death in recovery"] += 1
        brain.wire.alive = False
        if self.chance.random() < 0.5:
            self.gateway.cut()
            brain.die()
        self.be_missed(down)

    def be_missed(self, down: float) -> None:
        """Make the gateway land everything after a while, unless a brain connects."""
        gateway = self.gateway

        def land() -> None:
            if self.brain is None and self.gateway is gateway and gateway.flies:
                self.fired["failsafe"] += 1
                gateway.fail_safe(Down.LAND)

        if down > HEARTBEAT_WITHIN:
            self.later(HEARTBEAT_WITHIN, land)
        self.later(down, self.start_life)

    def freeze(self) -> None:
        """Make the brain hang, start another, and then continue the stale one."""
        brain, self.brain = self.brain, None
        if brain is not None:
            brain.remember()
            self.be_missed(self.case.weather.down)
            for pulse in range(UNAWARE_FOR):
                self.later(self.case.weather.down + 1.0 + pulse, brain.go_on_unaware)
            self.later(self.case.weather.down + 1.0 + UNAWARE_FOR, brain.die)

    def ended(self, brain: TrialLife) -> None:
        """Called when a run has ended by itself: everything has ended, or waits for the user."""
        self.brain = None
        brain.remember()
        brain.wire.alive = False
        self.gateway.cut()
        brain.die()
        waits = self.record.waits
        if waits and self.record.decide(brain.life.recorder.standing):
            self.later(PERSON_LOOKS_AFTER, self.start_life)
            return
        self.over = True
        if waits:
            self.found.append(f"{self.world.now:g} s: it ended, and {', '.join(waits)} had not")

    def blame(self, error: BaseException) -> None:
        """Report an uncaught error as a finding."""
        where = "".join(f", {note}" for note in getattr(error, "__notes__", ()))
        what = f"the app ended with an internal error: {type(error).__name__}: {error}{where}"
        self.found.append(f"{self.world.now:g} s: {what}")
        self.over = True

    def raise_from(self, kernel: VirtualTime) -> None:
        """End the trial with an uncaught error, which is a bug of Pluto."""
        if kernel.crashed is not None:
            error = kernel.crashed
            kernel.crashed = None
            self.blame(error)

    def later(self, seconds: float, call: Callable[[], object]) -> None:
        """Schedule a call after seconds of the world's time."""
        self.world.at(self.world.now + seconds, EventKind.FLIGHT, FLEET, call)

    def seen(self, done: WorldAction) -> None:
        """Called with an action of a drone on the world."""
        if done.job is not None:
            self.record.did(done.job, done.action, self.world.now)

    def new_gateway(self) -> Gateway:
        """Return a new gateway over the same drones and ledger."""
        fleet = self.case.fleet
        radio = self.case.weather.radio
        controls: Controls = self.navigation
        if radio:
            controls = Radio(self.world, self.navigation, self.radio_delay)
        return Gateway(
            self.world,
            controls,
            self.drones,
            fleet.airspace,
            ledger=self.ledger,
            apart=fleet.apart,
            max_airborne=fleet.max_airborne,
        )

    def radio_delay(self, _: str) -> float:
        """Return the delay of a message to or from a drone."""
        self.fired["slow radio"] += 1
        return self.case.weather.radio

    def report_is_lost(self) -> bool:
        """Return whether a report is lost, and the connection with it."""
        lost = self.loses_report
        self.loses_report = False
        return lost


def tried(app: App, case: Case) -> TrialResult:
    """Fly a case to its end, and return its violations and statistics."""
    collects = gc.isenabled()
    gc.disable()  # most objects live until the end
    try:
        return TrialRun(app, case).run()
    finally:
        if collects:
            gc.enable()
