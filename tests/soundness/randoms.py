"""Small random apps: forks in forks, both gates, hooks that say statuses, ways chosen by status.

They are drawn so that most could be flown, then edited: of arrows drawn blindly nearly none could,
and nothing would be learnt from them.
"""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

from tests.soundness.app import END, START, App, Arrow, read
from tests.soundness.kinds import FIVE, GATES, C, F, R, S, Status, U
from tests.soundness.mutants import mutants

DEEPEST = 2
MOST_BLOCKS = 11
EMITTED: tuple[tuple[Status, ...], ...] = ((), (), (S, C, F), (R, F), (F,), (S,), FIVE)
"""What hooks declare: nothing, what a monitor would say, what it would say too early, anything."""
WIDEST = 10
FIELDS = ("mission has owner: text, notes: int = 0", "trip has gentle: bool = yes")
JUDGES: tuple[tuple[str, Status, tuple[Status, ...]], ...] = (
    ("PriorityManager", F, (S, F)),
    ("MissionEvaluator", C, (S, C, F)),
    ("MissionRepeater", C, (S, C)),
)


def random_app(rng: Random) -> App:
    """Return an app, edited up to three times."""
    app = _Drawing(rng).app()
    for _ in range(rng.choice((0, 0, 1, 1, 2, 3))):
        edits = list(mutants(app))
        edit = rng.choice(sorted({mutant.edit for mutant in edits}))
        app = rng.choice([mutant.app for mutant in edits if mutant.edit == edit])
    return app


class _Drawing:
    """An app that grows a block at a time."""

    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.hooks: list[str] = []
        self.blocks: list[str] = []
        self.arrows: list[str] = []

    def app(self) -> App:
        self.arrow(START, self.block("MissionCreator"))
        self.arrow("block0", self.block("DroneAllocator"))
        self.arrow("block1", self.block("TripLauncher"))
        last, left = self.part("block2", (R,), 0)
        if self.rng.random() < 0.2 and not self.full:  # a fork that begins where another closed
            last, left = self.fork(last, left, 0)
        if R in left:
            watch = self.block("TripMonitor")
            self.arrow(last, watch, (R,))
            self.home(watch, (S, C, F))
        self.home(last, [status for status in left if status != R])
        luck = Random(
            len(self.blocks) * 100 + len(self.arrows)
        )  # of its own: for what changes no way
        fields = [one for one in FIELDS if luck.random() < 0.2]
        lines = [*fields, *self.hooks, *self.blocks, *self.arrows]
        return read("\n".join(["pluto 1", "app drawn {", *lines, "}"]))

    def home(self, source: str, statuses: Sequence[Status]) -> None:
        """Lead what leaves a block to the next trip, or to the end."""
        again = [status for status in statuses if status in (U, S)]
        if again:
            self.arrow(source, "block1", again)
        if F in statuses and self.rng.random() < 0.3:
            retry = self.block("PriorityManager", limit=self.rng.choice((0, 2, 3, 3)))
            self.arrow(source, retry, (F,))
            self.arrow(retry, "block1", (S,))
            self.arrow(retry, END)
            statuses = [status for status in statuses if status != F]
        if C in statuses and self.rng.random() < 0.3:
            kind = self.rng.choice(("MissionEvaluator", "MissionRepeater"))
            judge = self.block(kind)
            self.arrow(source, judge, (C,))
            self.arrow(judge, "block1", (S,))
            self.arrow(judge, END)
            statuses = [status for status in statuses if status != C]
        if C in statuses or F in statuses:
            self.arrow(source, END)

    def part(
        self, source: str, statuses: tuple[Status, ...], depth: int
    ) -> tuple[str, tuple[Status, ...]]:
        """Draw what comes after a block; return where it stops, and with which statuses."""
        drawn = self.rng.random()
        if depth < DEEPEST and drawn < (0.7 if depth == 0 else 0.25) and not self.full:
            return self.fork(source, statuses, depth)
        if statuses == (R,) and drawn < 0.6:
            watch = self.block(self.rng.choice(("TripMonitor", "TripMonitor", "TimerMonitor")))
            self.arrow(source, watch)
            return watch, (S, C, F)
        emits = self.rng.choice(EMITTED if depth else EMITTED[:4])
        hook = self.block("MissionModifier", emits)
        self.arrow(source, hook, statuses)
        left = emits or statuses
        if len(left) > 1 and self.rng.random() < 0.2:  # it goes round until it says otherwise
            self.arrow(hook, hook, left[:1])
            left = left[1:]
        return hook, left

    def fork(
        self, source: str, statuses: tuple[Status, ...], depth: int
    ) -> tuple[str, tuple[Status, ...]]:
        wide = self.rng.random() < 0.08 and not self.full
        width = self.rng.randint(4, WIDEST) if wide else self.rng.choice((2, 2, 3))
        gate = self.gate()
        passed: list[Status] = []
        for branch in range(width):
            if branch and self.rng.random() < (0.85 if wide else 0.1):
                passed.extend(self.bare(source, statuses, gate, wide))
                continue
            last, left = self.part(source, statuses, depth + 1)
            if self.rng.random() < 0.3 and not self.full:
                some = left[: self.rng.randint(1, len(left))]
                left = left[len(some) :]
                emits = self.rng.choice(EMITTED[1:5])
                hook = self.block("MissionModifier", emits)
                self.arrow(last, hook, some)
                self.arrow(hook, gate)
                passed.extend(emits or some)
            left, said = self.judged(last, left, gate)
            passed.extend(said)
            if left:
                self.arrow(last, gate, left)
            passed.extend(left)
        return gate, tuple(s for s in FIVE if s in passed)

    def gate(self) -> str:
        """Draw a gate, or take one that closes another fork already."""
        gates = [block.split()[0] for block in self.blocks if block.split()[2] in GATES]
        if gates and self.rng.random() < 0.1:
            return self.rng.choice(gates)
        return self.block(self.rng.choice(GATES))

    def bare(
        self, source: str, statuses: tuple[Status, ...], gate: str, wide: bool
    ) -> tuple[Status, ...]:
        """Draw a branch of one block, and of none now and then."""
        if self.rng.random() < 0.2:
            self.arrow(source, gate, statuses)
            return statuses
        emits = self.rng.choice(((), (), (), (F,))) if wide else ()
        hook = self.block("MissionModifier", emits)
        self.arrow(source, hook, statuses)
        self.arrow(hook, gate)
        return emits or statuses

    def judged(
        self, last: str, left: tuple[Status, ...], gate: str
    ) -> tuple[tuple[Status, ...], tuple[Status, ...]]:
        """Put a retry or a judge into a branch; return what is left, and what they say."""
        if self.full or self.rng.random() > 0.25:
            return left, ()
        kind, takes, says = self.rng.choice(JUDGES)
        if takes not in left:
            return left, ()
        judge = self.block(kind, limit=self.rng.choice((0, 2, 3)))
        self.arrow(last, judge, (takes,))
        self.arrow(judge, gate, says)
        return tuple(s for s in left if s != takes), says

    @property
    def full(self) -> bool:
        return len(self.blocks) >= MOST_BLOCKS

    def block(self, kind: str, emits: Sequence[Status] = (), limit: int = 3) -> str:
        name = f"block{len(self.blocks)}"
        said = f" emits {', '.join(emits)}" if emits else ""
        if kind == "MissionModifier":
            self.hooks.append(f"modifier do_{name}{said}")
            self.blocks.append(f"{name} = {kind}(hook: do_{name})")
        elif kind == "MissionEvaluator":
            self.hooks.append(f"evaluator do_{name}")
            self.blocks.append(f"{name} = {kind}(hook: do_{name})")
        elif kind == "PriorityManager":
            self.blocks.append(f"{name} = {kind}(max_attempts: {limit})")
        else:
            self.blocks.append(f"{name} = {kind}")
        return name

    def arrow(self, source: str, target: str, guard: Sequence[Status] = ()) -> None:
        drawn = Arrow(source=source, target=target, guard=tuple(guard), otherwise=False)
        self.arrows.append(str(drawn))
