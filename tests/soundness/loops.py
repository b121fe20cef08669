"""Random apps full of loops on which nothing is flown: of repeaters, evaluators, modifiers and forks.

What follows a flight is drawn an arrow at a time, only for statuses that really come, so that little
is refused for want of an arrow: it is the loops that decide.
"""

from __future__ import annotations

from random import Random

from tests.soundness.app import END, START, App, Arrow, read
from tests.soundness.kinds import ACCEPTS, FUNNEL, GATES, C, F, R, S, Status, U
from tests.soundness.mutants import mutants

MOST_BLOCKS = 9
"""Behind the flight."""
DEEPEST = 2
HEAD = "allocate"
EMITTED: tuple[tuple[Status, ...], ...] = ((), (), (C, F), (S, C), (S, C, F), (S, F), (C,), (F,))
"""What hooks of modifiers declare."""
KINDS = ("MissionRepeater", "MissionEvaluator", "MissionModifier", "MissionModifier")
WORST_FIRST = (F, S, C, R, U)


def looping_app(rng: Random) -> App:
    """Return an app; now and then an arrow of it is not as it was drawn."""
    app = _Drawing(rng).app()
    if rng.random() < 0.1:
        edits = list(mutants(app))
        edit = rng.choice(sorted({mutant.edit for mutant in edits}))
        return rng.choice([mutant.app for mutant in edits if mutant.edit == edit])
    return app


class _Part:
    """The blocks outside of all forks, or those of one branch."""

    def __init__(self, gate: str, depth: int) -> None:
        self.gate, self.depth = gate, depth
        self.blocks: list[str] = []
        self.arrived: list[Status] = []
        """What comes to the gate."""


class _Drawing:
    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.hooks: list[str] = []
        self.blocks: dict[str, str] = {}
        self.kinds: dict[str, str] = {}
        self.emits: dict[str, tuple[Status, ...]] = {}
        self.limits: dict[str, int] = {}
        self.arrows: dict[tuple[str, str], list[Status]] = {}

    def app(self) -> App:
        names = ("create", HEAD, "launch", "watch")
        kinds = ("MissionCreator", "DroneAllocator", "TripLauncher", "TripMonitor")
        for name, kind in zip(names, kinds, strict=True):
            self.blocks[name] = f"{name} = {kind}"
        self.arrows["watch", HEAD] = [S]
        whole = _Part("", 0)
        left: list[tuple[str, Status]] = [("watch", C)]
        if self.rng.random() < 0.7:
            left.append(("watch", F))
        else:
            self.arrows["watch", END] = [F]
        self.draw(left, whole)
        lines = [*self.hooks, *self.blocks.values(), f"{START} -> {' -> '.join(names)}"]
        lines += [
            str(Arrow(source=source, target=target, guard=tuple(sorted(taken)), otherwise=False))
            for (source, target), taken in self.arrows.items()
        ]
        return read("\n".join(["pluto 1", "app drawn {", *lines, "}"]))

    def draw(self, left: list[tuple[str, Status]], part: _Part) -> None:
        """Lead what leaves these blocks somewhere, and what comes of that, until all is led."""
        led = set(left)
        while left:
            source, status = left.pop(0)
            for target in self.targets(source, status, part):
                for said in self.said(target, status):
                    if (target, said) not in led:
                        led.add((target, said))
                        left.append((target, said))

    def targets(self, source: str, status: Status, part: _Part) -> list[str]:
        """Draw the arrow for a status, or the fork; return the blocks that are to be led on."""
        full = len(self.blocks) >= MOST_BLOCKS + 4
        if status in (C, F) and not full and part.depth < DEEPEST and self.rng.random() < 0.15:
            gate, passing = self.fork(source, status, part)
            self.emits[gate] = passing
            return [gate]
        target = self.chosen(status, part, full)
        self.arrows.setdefault((source, target), []).append(status)
        if target == part.gate:
            part.arrived.append(status)
        return [target] if target in part.blocks else []

    def chosen(self, status: Status, part: _Part, full: bool) -> str:
        known = [block for block in part.blocks if status in ACCEPTS[self.kinds[block]]]
        out = self.out(status, part)
        drawn = self.rng.random()
        if drawn < 0.35 and not full and (status in (C, F) or drawn < 0.1):
            return self.block(status, part)
        if drawn < 0.65 and known and (status in (C, F) or drawn < 0.4):
            return self.rng.choice(known)
        return out

    def out(self, status: Status, part: _Part) -> str:
        """Return where a status leads that shall not stay here."""
        if part.gate:
            return part.gate
        if status in (U, S) or (status == F and self.rng.random() < 0.25):
            return HEAD
        return END

    def fork(self, source: str, status: Status, part: _Part) -> tuple[str, tuple[Status, ...]]:
        kind = self.rng.choice(GATES)
        gate = self.named(kind)
        self.kinds[gate] = kind
        part.blocks.append(gate)
        came: list[list[Status]] = []
        for _ in range(self.rng.choice((2, 2, 3))):
            branch = _Part(gate, part.depth + 1)
            first = self.block(status, branch)
            self.arrows[source, first] = [*self.arrows.get((source, first), []), status]
            self.draw([(first, said) for said in self.said(first, status)], branch)
            came.append(branch.arrived)
        some = [s for s in WORST_FIRST if any(s in each for each in came)]
        if kind != FUNNEL:
            return gate, tuple(some)
        best = min((max(map(WORST_FIRST.index, each), default=-1) for each in came), default=-1)
        return gate, tuple(s for s in some if WORST_FIRST.index(s) <= best)

    def said(self, block: str, status: Status) -> tuple[Status, ...]:
        """Return the statuses with which a mission can leave a block that it came to like this."""
        match self.kinds[block]:
            case "MissionRepeater":
                return (S, C)
            case "MissionEvaluator":
                return (S, C, F)
            case "PriorityManager":
                return (S, F) if self.limits[block] else (S,)
            case _:
                return self.emits[block] or (status,)

    def block(self, status: Status, part: _Part) -> str:
        kinds = [kind for kind in KINDS if status in ACCEPTS[kind]]
        if status == F:
            kinds += ["PriorityManager"] * 2
        kind = self.rng.choice(kinds)
        name = self.named(kind)
        self.kinds[name], self.emits[name] = kind, ()
        part.blocks.append(name)
        if kind == "MissionModifier":
            emits = self.emits[name] = self.rng.choice(EMITTED)
            said = f" emits {', '.join(emits)}" if emits else ""
            self.hooks.append(f"modifier do_{name}{said}")
            self.blocks[name] = f"{name} = {kind}(hook: do_{name})"
        elif kind == "MissionEvaluator":
            self.hooks.append(f"evaluator do_{name}")
            self.blocks[name] = f"{name} = {kind}(hook: do_{name})"
        elif kind == "PriorityManager":
            self.limits[name] = self.rng.choice((0, 2, 3))
            self.blocks[name] = f"{name} = {kind}(max_attempts: {self.limits[name]})"
        return name

    def named(self, kind: str) -> str:
        name = f"block{len(self.blocks) - 3}"
        self.blocks[name] = f"{name} = {kind}"
        return name
