"""Walks along graphs, as missions are led, and graphs that are nearly sound.

The walk knows nothing of the compiler's: it goes through the branches of a fork one after the other. On its way
it holds the graph to what the checks promise of it, and notes each block, branch and gate with the status there.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field

from hypothesis import strategies as st

from plutoc.block import IN_GRAPH, Gate
from plutoc.check.model import Checked
from plutoc.graph.model import END, START, Node
from plutoc.plan.model import Place
from plutoc_runtime.domain.status import WORST_FIRST, Status
from tests.compiler.check.graphs import SOUND


class Enough(Exception):
    """The walk is long enough."""


@dataclass(kw_only=True)
class Diary:
    """What happened, and what will: the same seed chooses the same."""

    luck: random.Random
    steps: int
    place: Place = None
    """Where the mission goes on, as long as a plan remembers it."""
    allocated: bool = True
    lines: list[str] = field(default_factory=list)

    def note(self, what: str, status: Status) -> None:
        self.lines.append(f"{what} {status.value}")
        if len(self.lines) == self.steps:
            raise Enough

    def call(self, node: Node, status: Status) -> Status:
        self.note(node.name, status)
        emitted = node.emitted(status)
        return self.luck.choice([s for s in IN_GRAPH if s in emitted])

    def close(self, gate: Node, brought: Sequence[Status]) -> Status:
        if gate.block.gate is Gate.ALL:
            return self.call(gate, min(brought, key=WORST_FIRST.index))
        return self.call(gate, self.luck.choice(list(brought)))


def kept(walk: Callable[[Diary], None], seed: int, steps: int = 80) -> list[str]:
    """Return the diary of a walk that this seed chooses."""
    diary = Diary(luck=random.Random(seed), steps=steps)
    with suppress(Enough):
        walk(diary)
    return diary.lines


def along_graph(
    checked: Checked, diary: Diary, place: Place = None, status: Status = Status.UNEXECUTED
) -> None:
    """Walk the graph, from its beginning or from a block."""
    (first,) = checked.graph.outgoing[START]
    diary.allocated = place is not None
    _from(checked, place or first.target, status, END, diary)


def _from(checked: Checked, name: str, status: Status, to: str, diary: Diary) -> Status:
    gates = {(fork.node, fork.status): fork.gate for fork in checked.forks}
    closed = False
    while closed or name not in (to, END):
        node = checked.graph.node[name]
        if not closed:
            assert status in checked.arrives[name]
            assert to == END or not node.block.allocates
            assert not node.block.launches or (diary.allocated and to == END)
            diary.allocated = node.block.allocates or (diary.allocated and not node.block.launches)
            status = diary.call(node, status)
        closed = False
        assert status in checked.leaves[name]
        taken = [e for e in checked.graph.outgoing[name] if status in e.takes]
        assert all(status in checked.carries[edge] for edge in taken)
        if len(taken) > 1:
            gate = gates[name, status]
            brought = []
            for edge in taken:
                diary.note(f"branch to {edge.target}", status)
                brought.append(_from(checked, edge.target, status, gate, diary))
            status = diary.close(checked.graph.node[gate], brought)
            name, closed = gate, True
        else:
            assert taken or (name, status) in checked.implicit_ends, "stuck"
            name = taken[0].target if taken else END
    assert name == to, "a branch ended before its gate"
    diary.note(f"at {name}", status)
    return status


@st.composite
def edited(draw: st.DrawFn) -> str:
    """A sound graph with one or two lines removed, bent or added."""
    lines = draw(st.sampled_from(list(SOUND.values()))).strip().splitlines()
    names = sorted(line.split()[0] for line in lines if " = " in line)
    for _ in range(draw(st.integers(1, 2))):
        arrows = [i for i, line in enumerate(lines) if "->" in line]
        match draw(st.sampled_from(["remove", "bend", "unguard", "add"])):
            case "remove" if len(arrows) > 1:
                del lines[draw(st.sampled_from(arrows))]
            case "bend":
                index = draw(st.sampled_from(arrows))
                one, other = draw(st.sampled_from(names)), draw(st.sampled_from(names))
                words = (
                    lines[index].replace("[", "[ ").replace("]", " ]").replace(",", " ,").split()
                )
                lines[index] = " ".join(other if word == one else word for word in words)
            case "unguard":
                index = draw(st.sampled_from(arrows))
                lines[index] = lines[index].split(" when ")[0]
            case _:
                one, other = draw(st.sampled_from(names)), draw(st.sampled_from([*names, "end"]))
                lines.append(f"{one} -> {other}")
    return "\n".join(lines)
