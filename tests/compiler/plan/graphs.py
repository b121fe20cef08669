"""Graphs for plans: the sound ones of the checks, those of `shapes.txt`, and random ones.

A modifier that emits what it likes makes any shape: `route("a", "STANDBY > b, FAILED > end")`.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from hypothesis import strategies as st

from tests.compiler.check.graphs import SOUND
from tests.kit.sections import given

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


SHAPES = given(Path(__file__).with_name("shapes.txt"))
GRAPHS = {**SOUND, **SHAPES}
LOOP_THAT_ASKS = SHAPES["a loop asks where much lies before its head"]


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
