"""One trial: a world with its drones and a gateway lives on, and brains come and go.

World and brain have a virtual clock each, and take turns: whatever is due first is taken first, and
at one instant the world goes first. So a brain can die at any moment, and the drones fly on.
"""

from __future__ import annotations

import gc
from random import Random
from typing import TYPE_CHECKING

from plutoc_runtime.alone.faults import Faults
from plutoc_runtime.alone.world import World
from plutoc_runtime.domain.errors import ANY_ERROR
from plutoc_runtime.time.kernel import FLEET
from plutoc_runtime.time.kernel import Kind as When
from plutoc_runtime.time.virtual import VirtualTime

from ..gateway.gateway import Gateway
from ..gateway.ledger import MemoryLedger
from ..gateway.lossy_line import LOST, Line
from ..jobs.reports import Down
from ..process.signal_guard import by_a_person
from ..simulation.body import SimulatedDrone
from ..simulation.drones import SimulatedNavigation
from ..simulation.radio import Radio
from .blows import Blow, Kind
from .book import Book, Trial
from .living import THINKS, Living

if TYPE_CHECKING:
    from collections.abc import Callable

    from plutoc_runtime.domain.app import App

    from ..jobs.controls import Controls
    from ..simulation.drones import Deed
    from .case import Case

PATIENCE = 3.0
"""Seconds without a brain after which the gateway lands everything."""
PULSES = 20
"""Seconds for which a brain goes on after another has taken over."""
MOST_LIVES = 40
LONGEST = 7 * 86_400.0
"""Seconds, delays apart. A mission that has not ended by then never will."""


def tried(app: App, case: Case) -> Trial:
    """Fly a case to its end, and say what no run may do and this one did."""
    collects = gc.isenabled()
    gc.disable()  # it would look again and again at what lives until the end
    try:
        return Rig(app, case).run()
    finally:
        if collects:
            gc.enable()


class Rig:
    """The world of a trial, and what happens to the brains in it."""

    def __init__(self, app: App, case: Case) -> None:
        self.app, self.case = app, case
        self.book = Book(app, case)
        self.fired, self.found = self.book.fired, self.book.found
        self.chance = Random(f"{case.seed}/trial")
        self.world = world = VirtualTime()
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
            self.seen,
        )
        self.ledger = MemoryLedger()
        self.loses_report = False
        """Whether the next report is lost, and the line with it."""
        self.gateway = self.new_gateway()
        self.brain: Living | None = None
        self.brains: list[Living] = []
        """All there ever were: of some nobody has noticed yet that they are dead."""
        self.lives = 0
        self.skew = 0.0
        """How far the brain's clock is ahead of the world's."""
        self.strikes: dict[int, list[Blow]] = {}
        """By row, what strikes there."""
        for blow in case.blows:
            self.strikes.setdefault(blow.row, []).append(blow)
        self.over = False

    # The whole

    def run(self) -> Trial:
        """Go on until everything has ended, or never will."""
        try:
            self.go_through()
            return self.book.closed(self.lives)
        finally:
            for brain in self.brains:
                brain.die()
            self.world.close()

    def go_through(self) -> None:
        """Let lives come and go; an error that is not caught is a finding."""
        try:
            self.be_born()
            while not self.over:
                if not self.turn():
                    break
        except ANY_ERROR as error:  # in what no task has called, such as the end of a flight
            if by_a_person(error):
                raise
            self.blame(error)

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
        if self.book.endless and not self.over:
            why = f"{self.book.endless} sets out again and again, and nothing ends that"
            self.found.append(f"{self.world.now:g} s: {why}")
            return False
        if self.world.now > LONGEST + self.book.delays and not self.over:
            self.found.append(f"it goes on for ever; waiting: {self.waiting()}")
            return False
        return True

    def waiting(self) -> str:
        """Name who waits, for a sentence."""
        brain = self.brain
        tasks = [] if brain is None else [task.name for task in brain.kernel.tasks]
        return ", ".join(sorted(tasks)) or "nobody"

    def raise_from(self, kernel: VirtualTime) -> None:
        """An error that nobody caught is a mistake of ours: the trial ends with it."""
        if kernel.crashed is not None:
            error, kernel.crashed = kernel.crashed, None
            self.blame(error)

    def blame(self, error: BaseException) -> None:
        """Make a finding of an error that was not caught."""
        where = "".join(f", {note}" for note in getattr(error, "__notes__", ()))
        what = f"the app ended with an internal error: {type(error).__name__}: {error}{where}"
        self.found.append(f"{self.world.now:g} s: {what}")
        self.over = True

    def later(self, seconds: float, call: Callable[[], object]) -> None:
        """Let this happen after so many seconds of the world's."""
        self.world.schedule(self.world.now + seconds, When.FLIGHT, FLEET, call)

    def seen(self, deed: Deed) -> None:
        """A drone has done something to the world."""
        if deed.job is not None:
            self.book.did(deed.job, deed.action, self.world.now)

    # Lives

    def new_gateway(self) -> Gateway:
        """Return a gateway over the drones and the ledger that are there."""
        fleet, radio = self.case.fleet, self.case.weather.radio
        controls: Controls = self.navigation
        if radio:
            controls = Radio(self.world, self.navigation, self.radio_delay)
        gateway = Gateway(
            self.world,
            controls,
            self.drones,
            fleet.airspace,
            ledger=self.ledger,
            apart=fleet.apart,
            max_airborne=fleet.max_airborne,
        )
        if any(blow.kind is Kind.REPORT for blow in self.case.blows):
            gateway.line = Line(gateway, self.fate)
        return gateway

    def radio_delay(self, _: str) -> float:
        """Say how long a message to or from a drone takes."""
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
        records = self.book.records(self.case.weather.snapshot, self.chance)
        self.brain = Living(self, records)
        self.brains.append(self.brain)

    def lose_brain(self, down: float) -> None:
        """The brain is dead; the gateway notices at once, or when the heartbeat is missing."""
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
        """No heartbeat comes: after a while the gateway lands everything, unless a brain comes."""
        gateway = self.gateway

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
            self.be_missed(self.case.weather.down)
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
        waits = self.book.waits
        if waits and self.book.decide(brain.life.recorder.records):
            self.later(THINKS, self.be_born)
            return
        self.over = True
        if waits:
            self.found.append(f"{self.world.now:g} s: it ended, and {', '.join(waits)} had not")
