"""Graphs for plans: the sound ones of the checks, some with a shape of their own, and random ones.

A modifier that emits what it likes makes any shape: `route("a", "STANDBY > b, FAILED > end")`.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from hypothesis import strategies as st

from tests.compiler.check.graphs import BASIC
from tests.compiler.check.test_sound_graphs import SOUND

STATUSES = ("STANDBY", "COMPLETED", "FAILED")


def route(name: str, ways: str) -> str:
    """Return the lines of a block that emits these statuses, and leads each where it says."""
    pairs = [way.split(" > ") for way in ways.split(", ")]
    emits = ", ".join(status for status, _ in pairs)
    lines = [f"{name} = MissionModifier emits {emits}"]
    lines += [f"{name} -> {target} when {status}" for status, target in pairs]
    return "\n".join(lines)


def routes(**ways: str) -> str:
    """Return a graph of such blocks; missions come to the first one."""
    first = next(iter(ways))
    lines = [route(name, text) for name, text in ways.items()]
    return "\n".join(["create = MissionCreator", f"start -> create -> {first}", *lines])


NESTED_LOOPS = f"""{BASIC}
    wait = Clock
    retry = PriorityManager
    start -> create -> wait -> allocate -> launch -> watch
    watch -> wait when STANDBY
    watch -> retry when FAILED
    retry -> allocate when STANDBY
    retry -> end otherwise
    watch -> end when COMPLETED
"""
TWO_ENTRIES = routes(
    a="COMPLETED > b, FAILED > c",
    b="STANDBY > c, COMPLETED > end",
    c="STANDBY > b, FAILED > end",
)
MAZE = routes(
    a="STANDBY > b, COMPLETED > c, FAILED > d",
    b="STANDBY > c, COMPLETED > d, FAILED > e",
    c="STANDBY > d, COMPLETED > b, FAILED > e",
    d="STANDBY > e, COMPLETED > c, FAILED > b",
    e="STANDBY > b, COMPLETED > d, FAILED > end",
)
GRAPHS = {
    **SOUND,
    "nested loops": NESTED_LOOPS,
    "a loop with two entries": TWO_ENTRIES,
    "a maze": MAZE,
    "loops left to each loop around them": routes(
        a="STANDBY > b, FAILED > end",
        b="STANDBY > c, COMPLETED > a",
        c="STANDBY > d, COMPLETED > b, FAILED > a",
        d="STANDBY > c, COMPLETED > b, FAILED > a",
    ),
    "ways that meet again": routes(
        a="STANDBY > b, COMPLETED > c, FAILED > end",
        b="STANDBY > d",
        c="STANDBY > d",
        d="COMPLETED > e, FAILED > e, STANDBY > a",
        e="COMPLETED > end",
    ),
    "two meetings, one in an arm": routes(
        a="STANDBY > b, COMPLETED > c, FAILED > d",
        b="STANDBY > m",
        c="STANDBY > m",
        m="STANDBY > g",
        d="STANDBY > g",
        g="COMPLETED > h",
        h="COMPLETED > end",
    ),
    "ways that cross": routes(
        a="STANDBY > b, COMPLETED > c, FAILED > g",
        b="STANDBY > e, COMPLETED > g",
        c="STANDBY > e, COMPLETED > g",
        e="STANDBY > f",
        f="STANDBY > g",
        g="COMPLETED > end",
    ),
    "a loop left to both sides": routes(
        a="STANDBY > b",
        b="FAILED > b, COMPLETED > a, STANDBY > c",
        c="STANDBY > a, FAILED > end",
    ),
    "a loop left to two places that others come to as well": routes(
        a="STANDBY > b, FAILED > d",
        b="FAILED > b, COMPLETED > a, STANDBY > d",
        d="STANDBY > a, FAILED > end",
    ),
    "out of two loops at once": routes(
        a="STANDBY > b",
        b="STANDBY > c",
        c="STANDBY > b, COMPLETED > a, FAILED > tidy",
        tidy="STANDBY > sweep",
        sweep="FAILED > end",
    ),
    "a block in two branches": """
    left = MissionModifier
    right = MissionModifier
    note = MissionModifier
    both = GateFunnel
    create = MissionCreator
    done = MissionModifier emits COMPLETED
    start -> create -> [left, right] -> note -> both -> done -> end
""",
    "a branch without a block": f"""{BASIC}
    timer = TimerMonitor
    first = GateFIFO
    start -> create -> allocate -> launch -> [watch, timer]
    watch -> first
    timer -> first
    first -> tell when STANDBY
    tell = MissionModifier
    note = MissionModifier
    all = GateFunnel
    tell -> note -> all
    tell -> all
    all -> allocate
    first -> end
""",
    "a block in a branch and outside": """
    create = MissionCreator
    note = MissionModifier
    mark = MissionModifier
    both = GateFunnel
    step = MissionModifier emits STANDBY, COMPLETED
    start -> create -> [note, mark] when UNEXECUTED
    mark -> both
    note -> both when UNEXECUTED
    both -> step
    step -> note when STANDBY
    note -> step when STANDBY
    step -> end when COMPLETED
""",
}


@dataclass(kw_only=True)
class _Drawing:
    """A random graph while it is drawn."""

    draw: st.DrawFn
    left: int
    lines: list[str] = field(default_factory=list)
    made: int = 0

    def fresh(self, letter: str) -> str:
        self.made += 1
        self.left -= 1
        return f"{letter}{self.made}"

    def region(self, out: str, depth: int) -> str:
        """Draw blocks of which every one is reached; what leaves them leads `out`."""
        first = self.fresh("m")
        names = [first]
        for name in names:
            emitted = self.draw(st.sets(st.sampled_from(STATUSES), min_size=1))
            ordered = [status for status in STATUSES if status in emitted]
            self.lines.append(f"{name} = MissionModifier emits {', '.join(ordered)}")
            for status in ordered:
                self.onward(name, f" when {status}", status, names, out, depth)
        return first

    def onward(
        self, name: str, guard: str, status: str, names: list[str], out: str, depth: int
    ) -> None:
        targets = list(names)
        if self.left > 0:
            targets += ["new", "new", "fork"] if depth else ["new", "new"]
        if out != "end" or status != "STANDBY":
            targets += [out, out]
        target = self.draw(st.sampled_from(targets))
        if target == "fork":
            self.fork(name, guard, names, depth)
            return
        if target == "new":
            target = self.fresh("m")
            names.append(target)
        self.lines.append(f"{name} -> {target}{guard}")

    def fork(self, name: str, guard: str, names: list[str], depth: int) -> None:
        gate, behind = self.fresh("g"), self.fresh("m")
        names.append(behind)
        kind = self.draw(st.sampled_from(["GateFIFO", "GateFunnel"]))
        self.lines += [f"{gate} = {kind}", f"{gate} -> {behind}"]
        for _ in range(self.draw(st.integers(2, 3))):
            self.lines.append(f"{name} -> {self.region(gate, depth - 1)}{guard}")


@st.composite
def random_graphs(draw: st.DrawFn, blocks: int = 14) -> str:
    """Draw a graph of blocks that route and fork wherever they like; few checks refuse it."""
    drawing = _Drawing(draw=draw, left=blocks)
    first = drawing.region("end", 2)
    return "\n".join(["create = MissionCreator", f"start -> create -> {first}", *drawing.lines])
