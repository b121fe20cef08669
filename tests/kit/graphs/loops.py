"""Random apps full of loops on which nothing is flown: of repeaters, evaluators, modifiers and forks.

What follows a flight is drawn an arrow at a time, only for statuses that really come, so that little
is refused for want of an arrow: it is the loops that decide.
"""

from __future__ import annotations

from random import Random

from plutoc_runtime.domain.status import WORST_FIRST, Status
from tests.kit.graphs.drawing import END, KINDS, START, C, Drawing, F, R, S, Statuses, U

BEHIND = 9
"""Blocks behind the flight, at most."""
DEEPEST = 2
HEAD = ("create", "allocate", "launch", "watch")
EMITTED: tuple[Statuses, ...] = ((), (), (C, F), (S, C), (S, C, F), (S, F), (C,), (F,))
"""What hooks of modifiers declare."""
LOOPING = ("MissionRepeater", "MissionEvaluator", "MissionModifier", "MissionModifier")


def looping_source(rng: Random) -> str:
    """Return an app."""
    return _Loops(rng).text()


class _Part:
    """The blocks outside of all forks, or those of one branch."""

    def __init__(self, gate: str, depth: int) -> None:
        self.gate, self.depth = gate, depth
        self.blocks: list[str] = []
        self.arrived: list[Status] = []
        """What comes to the gate."""


class _Loops:
    def __init__(self, rng: Random) -> None:
        self.rng = rng
        self.drawing = Drawing(rng=rng, most=BEHIND + len(HEAD))

    def text(self) -> str:
        drawing = self.drawing
        kinds = ("MissionCreator", "DroneAllocator", "TripLauncher", "TripMonitor")
        create, self.head, launch, watch = (
            drawing.block(name, kind, emits)
            for name, kind, emits in zip(HEAD, kinds, ((U,), (U, S), (R,), (S, C, F)), strict=True)
        )
        drawing.arrows += [(START, create, (U,)), (create, self.head, (U,))]
        drawing.arrows += [(self.head, launch, (U, S)), (launch, watch, (R,))]
        drawing.arrows.append((watch, self.head, (S,)))
        left: list[tuple[str, Status]] = [(watch, C)]
        if drawing.chance(0.7):
            left.append((watch, F))
        else:
            drawing.arrows.append((watch, END, (F,)))
        self.draw(left, _Part("", 0))
        return drawing.text()

    def draw(self, left: list[tuple[str, Status]], part: _Part) -> None:
        """Lead what leaves these blocks somewhere, and what comes of that, until all is led."""
        led = set(left)
        while left:
            source, status = left.pop(0)
            target = self.target(source, status, part)
            for said in self.said(target, status) if target in part.blocks else ():
                if (target, said) not in led:
                    led.add((target, said))
                    left.append((target, said))

    def target(self, source: str, status: Status, part: _Part) -> str:
        """Draw the arrow for a status, or the fork; return the block that it leads to."""
        drawing = self.drawing
        if status in (C, F) and not drawing.full and part.depth < DEEPEST and drawing.chance(0.15):
            return self.fork(source, status, part)
        target = self.chosen(status, part)
        drawing.arrows.append((source, target, (status,)))
        if target == part.gate:
            part.arrived.append(status)
        return target

    def chosen(self, status: Status, part: _Part) -> str:
        known = [block for block in part.blocks if status in KINDS[self.kind(block)].accepts]
        out = self.out(status, part)
        drawn = self.rng.random()
        if drawn < 0.35 and not self.drawing.full and (status in (C, F) or drawn < 0.1):
            return self.block(status, part)
        if drawn < 0.65 and known and (status in (C, F) or drawn < 0.4):
            return self.rng.choice(known)
        return out

    def out(self, status: Status, part: _Part) -> str:
        """Return where a status leads that shall not stay here."""
        if part.gate:
            return part.gate
        if status in (U, S) or (status is F and self.drawing.chance(0.25)):
            return self.head
        return END

    def fork(self, source: str, status: Status, part: _Part) -> str:
        kind = self.rng.choice(("GateFIFO", "GateFunnel"))
        gate = self.drawing.block("gate", kind, ())
        part.blocks.append(gate)
        came: list[list[Status]] = []
        for _ in range(self.rng.choice((2, 2, 3))):
            branch = _Part(gate, part.depth + 1)
            first = self.block(status, branch)
            self.drawing.arrows.append((source, first, (status,)))
            self.draw([(first, said) for said in self.said(first, status)], branch)
            came.append(branch.arrived)
        some = [s for s in WORST_FIRST if any(s in each for each in came)]
        if kind == "GateFunnel":
            worst = [max(map(WORST_FIRST.index, each), default=-1) for each in came]
            some = [s for s in some if WORST_FIRST.index(s) <= min(worst)]
        self.drawing.emits[gate] = tuple(some)
        return gate

    def said(self, block: str, status: Status) -> Statuses:
        """Return the statuses with which a mission can leave a block that it came to like this."""
        emits = self.drawing.emits
        if not emits[block] and self.kind(block) == "MissionModifier":
            return (status,)
        return emits[block]

    def kind(self, block: str) -> str:
        return self.drawing.kinds[block]

    def block(self, status: Status, part: _Part) -> str:
        drawing = self.drawing
        kinds = [kind for kind in LOOPING if status in KINDS[kind].accepts]
        match self.rng.choice([*kinds, *["PriorityManager"] * (2 if status is F else 0)]):
            case "MissionModifier":
                name = drawing.modifier("do", self.rng.choice(EMITTED))
            case "MissionEvaluator":
                hook = drawing.hook("evaluator", "judge")
                name = drawing.block("judge", "MissionEvaluator", (S, C, F), f"hook: {hook}")
            case "MissionRepeater":
                name = drawing.block("again", "MissionRepeater", (S, C))
            case _:
                limit = self.rng.choice((0, 2, 3))
                said = (S, F) if limit else (S,)
                name = drawing.block("retry", "PriorityManager", said, f"max_attempts: {limit}")
        part.blocks.append(name)
        return name
