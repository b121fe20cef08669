"""Every branch of a fork closes at one gate, forks nest, and every gate closes a fork."""

from __future__ import annotations

from collections.abc import Collection

from plutoc.block import Gate
from plutoc.check import fork_errors as errors
from plutoc.check import model
from plutoc.check.branches import Branch, Branches, nesting, within
from plutoc.check.flow import Flow, Fork, Hop, Place, Way, ordered
from plutoc.check.phrases import is_flown
from plutoc.diagnostic import Diagnostic
from plutoc.graph.digraph import loops
from plutoc.graph.model import Graph, Node
from plutoc_runtime.domain.status import Status

Branched = tuple[Branch, ...]
MOST_NESTED = 100
"""The deepest nesting of forks, as branches become nested functions."""
_MOST_WAYS = 200
"""The most endless forks whose loops are shown."""


def unclosed(flow: Flow, found: Branches) -> dict[Fork, Diagnostic]:
    """Find forks that do not close, with the most specific message for each."""
    inside = nesting(found)
    breeding = loops(inside)
    diagnostics: dict[Fork, Diagnostic] = {}
    for part in breeding:
        again = [p for s, places in flow.entries.items() if s.fork == part[0] for p in places]
        way = flow.way(again[-1], part[0][1])
        diagnostics[part[0]] = errors.breeds(flow.graph, found[part[0]][0], way)
    for fork, branches in found.items():
        stuck = any(inner.stuck for branch in branches for inner in within(found, inside, branch))
        if not stuck and not any(fork in part for part in breeding):
            shown = len(diagnostics) < _MOST_WAYS
            wrong = _shared(flow, found, branches) or _open(flow, found, branches, shown)
            if wrong:
                diagnostics[fork] = wrong
    return diagnostics


def flown(found: Branches, unclosed: Collection[Fork]) -> list[Fork]:
    """Return the forks in a branch of which a mission is flown before its gate.

    How it then goes on is a guess. Those that follow from forks within them are left out.
    """
    return [
        fork
        for fork, branches in found.items()
        if (fork in unclosed or any(branch.stuck for branch in branches))
        and any(branch.astray and is_flown(branch.astray) for branch in branches)
    ]


def too_deep(flow: Flow, found: Branches) -> list[Diagnostic]:
    """Find a fork that is nested too deeply, in a graph in which all forks close."""
    inside = tuple(found)
    for _ in range(MOST_NESTED):
        inner = (fork for one in inside for branch in found[one] for fork in branch.inner)
        inside = tuple(dict.fromkeys(inner))
    return [errors.too_deep(flow.graph, fork, MOST_NESTED) for fork in inside[:1]]


def closed(found: Branches) -> tuple[model.Fork, ...]:
    """Return the forks of a graph in which all of them close."""
    return tuple(
        model.Fork(
            node=node,
            status=status,
            branches=tuple(branch.edge for branch in branches),
            gate=gates_of(branches)[0],
        )
        for (node, status), branches in found.items()
    )


def gates_of(branches: Branched) -> tuple[str, ...]:
    """Return the gates at which branches close."""
    return tuple(dict.fromkeys(gate for branch in branches for gate in branch.gates))


def _shared(flow: Flow, found: Branches, branches: Branched) -> Diagnostic | None:
    """Find a fork inside a branch that closes at the gate of the outer fork."""
    gates = gates_of(branches)
    for branch in branches:
        for inner in filter(lambda fork: _sound(found[fork]), branch.inner):
            for gate in gates_of(found[inner]):
                if gate in gates:
                    way = flow.way(next(b.gates[gate] for b in found[inner] if gate in b.gates))
                    return errors.shared_gate(flow.graph, branches, found[inner], gate, way)
    return None


def _open(flow: Flow, found: Branches, branches: Branched, shown: bool) -> Diagnostic | None:
    # a fork inside that does not close has its own message
    branches = tuple(b for b in branches if all(_sound(found[fork]) for fork in b.inner))
    graph, gates = flow.graph, gates_of(branches)
    astray = [(branch, branch.astray) for branch in branches if branch.astray]
    if astray:
        ways = [flow.way(*lost) for _, lost in astray]
        nearest = min(range(len(ways)), key=lambda i: len(ways[i]))
        astray.insert(0, astray.pop(nearest))
        flies = is_flown(astray[0][1])
        beside = next((b for b in branches if flies and _holds(graph, b)), None)
        limited = any(_limits(graph, branch) for branch in found[branches[0].fork])
        return errors.astray(graph, astray, gates, ways[nearest], beside, limited)
    if len(gates) > 1:
        first = {gate: place for b in reversed(branches) for gate, place in b.gates.items()}
        ways = [flow.way(first[gate]) for gate in gates]
        return errors.different_gates(graph, branches, gates, ways)
    for branch in branches:
        way = flow.way(branch.circles) if branch.circles and shown else None
        if not branch.gates and gates and graph.node[gates[0]].block.gate is Gate.ALL:
            return errors.waits_in_vain(graph, branch, gates[0], way)
        if branch.circles or not branch.gates:
            return errors.never_closes(graph, branch, gates, way)
    return None


def _holds(graph: Graph, branch: Branch) -> bool:
    """Whether a branch begins with a block that holds missions."""
    first = graph.node.get(branch.edge.target)
    return first is not None and first.block.holds


def _limits(graph: Graph, branch: Branch) -> bool:
    """Whether a branch sets a limit to the flight that the fork is about."""
    blocks = [graph.node[name].block for name in branch.nodes]
    return any(block.limits and not block.interrupts for block in blocks)


def past_gate(flow: Flow, found: Branches, fork: Fork, gate: str) -> Way | None:
    """Return the way past a gate out of a fork, in a branch of this one, that closes there instead."""
    for inner in dict.fromkeys(one for branch in found[fork] for one in branch.inner):
        if gate in gates_of(found[inner]):
            for branch in found[inner]:
                if branch.astray and is_flown(branch.astray):
                    return flow.way(*branch.astray)
    return None


def handed_on(graph: Graph, gate: str, way: Way) -> Node | None:
    """Return the block by which a flight comes to a gate, though its hook could end it with `emits`."""
    at = next((i for i, hop in enumerate(way) if hop == Hop(gate, Status.RUNNING)), 0)
    for hop in reversed(way[:at]):
        node = graph.node[hop.node]
        if hop.leaving is not Status.RUNNING or node.block.launches:
            return None
        if node.block.emits_by_hook and node.hook and not node.hook.emits:
            return node
    return None


def _sound(branches: Branched) -> bool:
    """Whether all branches close at one gate."""
    return len(gates_of(branches)) == 1 and all(
        branch.gates and not branch.astray and not branch.circles and not branch.stuck
        for branch in branches
    )


def idle_gates(flow: Flow, found: Branches, *, lacking: bool) -> dict[str, Diagnostic]:
    """Find gates that missions reach outside of any fork, by name.

    If an unreached block is `lacking`, it may be the missing branch, and has a message already.
    """
    # branches that close at different gates are reported already
    torn = {
        g for branches in found.values() if len(gates_of(branches)) > 1 for g in gates_of(branches)
    }
    closing = {gate for branches in found.values() for gate in gates_of(branches)}
    alone: dict[str, Place] = {}
    for place in flow.places:
        if place.frame is None and not place.out:
            alone.setdefault(place.node, place)
    idle: dict[str, Diagnostic] = {}
    for name, place in alone.items():
        node = flow.graph.node.get(name)
        if node is None or node.block.gate is None or name in torn:
            continue
        way = flow.way(place)
        # behind a gate that closes nothing comes what was meant to be in a fork
        behind_another = any(hop.node in idle for hop in way)
        if name in closing:
            giver = handed_on(flow.graph, name, way)
            ends = ordered(flow.arrives[name] - {Status.RUNNING})
            idle[name] = errors.outside_fork(flow.graph, node, way, giver, ends)
        elif not lacking and not behind_another:
            idle[name] = errors.closes_nothing(flow.graph, node, way)
    return idle
