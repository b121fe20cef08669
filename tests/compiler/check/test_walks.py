"""Graphs that pass, walked at random with real clones: nothing that was promised is broken.

The walk here knows nothing of the compiler's: it keeps a stack of clones, as the runtime does.
"""

from __future__ import annotations

import random
from contextlib import suppress

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plutoc.block import Gate
from plutoc.check.model import Checked
from plutoc.check.run import check
from plutoc.diagnostic import Rejected
from plutoc.graph.model import END, START
from plutoc_runtime.domain.status import WORST_FIRST, Status
from tests.compiler.check.graphs import SOUND, build

STEPS = 60


class Endless(Exception):
    """The walk is long enough."""


class Walker:
    """One mission, its choices made by a seed."""

    def __init__(self, checked: Checked, seed: int) -> None:
        self.checked = checked
        self.graph = checked.graph
        self.gates = {(fork.node, fork.status): fork.gate for fork in checked.forks}
        self.random = random.Random(seed)
        self.left = STEPS
        self.allocated = False

    def run(self) -> None:
        (first,) = self.graph.outgoing[START]
        self.walk(first.target, Status.UNEXECUTED, None)

    def walk(self, name: str, status: Status, gate: str | None) -> Status:
        """Go on until the end, or until the gate that closes the branch; return the status."""
        while name not in (END, gate):
            self.left -= 1
            if not self.left:
                raise Endless
            assert status in self.checked.arrives[name]
            node = self.graph.node[name]
            if node.block.launches:
                assert self.allocated and gate is None
            assert gate is None or not node.block.allocates
            self.allocated = node.block.allocates or (self.allocated and not node.block.launches)
            status = self.pick(node.emitted(status))
            name, status = self.leave(name, status, gate)
        assert gate is None or name == gate, "a branch ended before its gate"
        return status

    def leave(self, name: str, status: Status, gate: str | None) -> tuple[str, Status]:
        assert status in self.checked.leaves[name]
        while True:
            taken = [e for e in self.graph.outgoing[name] if status in e.takes]
            for edge in taken:
                assert status in self.checked.carries[edge]
            if not taken:
                assert (name, status) in self.checked.implicit_ends, "stuck"
                return END, status
            if len(taken) == 1:
                return taken[0].target, status
            closing = self.gates[name, status]
            brought = [self.walk(edge.target, status, closing) for edge in taken]
            if self.graph.node[closing].block.gate is Gate.ALL:
                status = min(brought, key=WORST_FIRST.index)
            else:
                status = self.random.choice(brought)
            name = closing

    def pick(self, statuses: frozenset[Status]) -> Status:
        return self.random.choice([status for status in Status if status in statuses])


def walk(checked: Checked, seed: int) -> None:
    with suppress(Endless):
        Walker(checked, seed).run()


@pytest.mark.parametrize("name", SOUND)
def test_a_sound_graph_keeps_its_promises(name: str) -> None:
    """Statuses stay on the edges that carry them, and every branch comes to its gate."""
    checked, _ = check(build(SOUND[name]))
    for seed in range(25):
        walk(checked, seed)


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


@settings(max_examples=60, deadline=None)
@given(text=edited(), seed=st.integers(0, 1000))
def test_an_edited_graph_is_refused_or_keeps_its_promises(text: str, seed: int) -> None:
    """All that the checks let through can be walked; and they say the same each time."""
    try:
        checked, warnings = check(build(text))
    except Rejected as rejected:
        with pytest.raises(Rejected) as again:
            check(build(text))
        assert again.value.diagnostics == rejected.diagnostics
        return
    assert check(build(text))[1] == warnings
    for step in range(20):
        walk(checked, seed + step)


def test_forks_without_gates_do_not_blow_up() -> None:
    """Forty forks, one behind the other, none of which closes: two to the forty clones."""
    lines = ["make = MissionCreator", "start -> make -> m0"]
    for i in range(40):
        lines += [f"{letter}{i} = MissionModifier" for letter in "mab"]
        lines.append(f"m{i} -> [a{i}, b{i}] -> m{i + 1}")
    lines += ["m40 = MissionModifier emits COMPLETED", "m40 -> end"]
    with pytest.raises(Rejected, match="P2011"):
        check(build("\n".join(lines)))
