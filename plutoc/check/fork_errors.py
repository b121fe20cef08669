"""What can be wrong with forks and gates (P2)."""

from __future__ import annotations

from collections.abc import Sequence

from plutoc.check.branches import Astray, Branch
from plutoc.check.flow import Fork, Way
from plutoc.check.phrases import (
    before_allocation,
    emits_nothing,
    error,
    fate,
    fork_of,
    is_flown,
    or_guarded,
    related_to,
    whole_mission,
    with_emits,
)
from plutoc.check.side_by_side import behind, last_arrow, put_beside, through_gate
from plutoc.diagnostic import Diagnostic
from plutoc.graph.model import Graph, Node
from plutoc.graph.wording import all_of
from plutoc_runtime.domain.status import Status


def astray(
    graph: Graph,
    branches: Sequence[tuple[Branch, Astray]],
    gates: Sequence[str],
    way: Way,
    beside: Branch | None,
    limited: bool,
) -> Diagnostic:
    """`beside` is the branch in which a block holds the mission that others fly; `limited` is a fork with a limit."""
    first, lost = branches[0]
    guard = or_guarded(graph, first.fork)
    past = last_arrow(graph, way) if is_flown(lost) and gates else None
    watches = graph.node[first.fork[0]].block.watches  # then the flight is over, and was no fork
    if beside:
        holds = graph.node[beside.edge.target]
        mend = (
            f"`{holds.name}` holds only what comes through it, and not the branch beside it: "
            f"put it {before_allocation(graph, holds)}{guard}"
        )
    elif past and (watches or past[0] is not first.edge):
        mend = through_gate(graph, *past, gates[0]) + ("" if watches else guard)
    elif gates:
        mend = f"close the fork first, at `{gates[0]}`{guard}"
    else:
        mend = f"let the branches meet at a gate{guard}"
    if limited and is_flown(lost) and not beside:
        mend += f"; a limit is for one flight: {whole_mission(graph)}"
    to = "" if lost[0].node == first.edge.target else f" to `{first.edge.target}`"
    return error(
        "P2012" if is_flown(lost) else "P2011",
        (graph, first.edge.span),
        f"{fork_of(first.fork)} is not closed: its branch{to} {fate(lost)}",
        label="its mission would be flown twice" if is_flown(lost) else "this branch",
        related=tuple(
            related_to(
                graph, branch.edge.span, f"the branch to `{branch.edge.target}` {fate(other)}, too"
            )
            for branch, other in branches[1:]
        ),
        help=mend,
        ways=(way,),
    )


def different_gates(
    graph: Graph, branches: Sequence[Branch], gates: Sequence[str], ways: Sequence[Way]
) -> Diagnostic:
    closing = [
        related_to(
            graph, b.edge.span, f"the branch to `{b.edge.target}` closes at {all_of([*b.gates])}"
        )
        for b in branches
        if b.gates
    ]
    return error(
        "P2013",
        (graph, closing[0].span),
        f"{fork_of(branches[0].fork)} closes at different gates: {all_of(gates)}",
        label=closing[0].label,
        related=tuple(closing[1:]),
        help="lead all branches to one gate",
        ways=ways,
    )


def never_closes(graph: Graph, branch: Branch, gates: Sequence[str], way: Way | None) -> Diagnostic:
    return error(
        "P2014",
        (graph, branch.edge.span),
        f"the branch to `{branch.edge.target}` of {fork_of(branch.fork)} can go round for ever",
        label="it does not always close",
        help=f"lead every way through it to {f'`{gates[0]}`' if gates else 'a gate'}",
        ways=(way,),
    )


def waits_in_vain(graph: Graph, branch: Branch, gate: str, way: Way | None) -> Diagnostic:
    return error(
        "P2015",
        (graph, graph.node[gate].name_span),
        f"`{gate}` waits for a branch of {fork_of(branch.fork)} that cannot arrive",
        related=(
            related_to(
                graph, branch.edge.span, f"the branch to `{branch.edge.target}` never gets there"
            ),
        ),
        help=f"lead the branch to `{gate}`",
        ways=(way,),
    )


def outside_fork(
    graph: Graph, node: Node, way: Way, giver: Node | None, ends: Sequence[Status]
) -> Diagnostic:
    """`giver` is the block that brought a flight to the gate, which led on from there."""
    mend = with_emits(giver, ends) if giver else "lead this way past the gate"
    return error(
        "P2016",
        (graph, node.name_span),
        f"a mission can come to `{node.name}` outside of the fork that closes there",
        related=tuple(
            related_to(graph, edge.span, "it comes along here")
            for edge in graph.incoming[node.name]
            if edge.source == way[-2].node
        )
        + (emits_nothing(graph, giver) if giver else ()),
        help=mend,
        ways=(way,),
    )


def closes_nothing(graph: Graph, node: Node, way: Way) -> Diagnostic:
    return error(
        "P2017",
        (graph, node.name_span),
        f"`{node.name}` closes no fork: a gate needs at least two branches",
        help="fork before it (two arrows that take the same status), or remove the gate",
        ways=(way,),
    )


def breeds(graph: Graph, first: Branch, way: Way) -> Diagnostic:
    return error(
        "P2018",
        (graph, first.edge.span),
        f"{fork_of(first.fork)} comes round to itself before it closes: its clones multiply without end",
        help="close it at a gate before the way leads back",
        ways=(way,),
    )


def shared_gate(
    graph: Graph, outer: Sequence[Branch], inner: Sequence[Branch], gate: str, way: Way
) -> Diagnostic:
    return error(
        "P2019",
        (graph, inner[0].edge.span),
        f"{fork_of(inner[0].fork)} closes at `{gate}`, which must close {fork_of(outer[0].fork)} around it",
        label="the fork inside",
        related=(
            related_to(graph, outer[0].edge.span, "the fork around it"),
            related_to(graph, graph.node[gate].name_span, "the gate of both"),
        ),
        help=f"give the fork inside a gate of its own, and lead that gate to `{gate}`",
        ways=(way,),
    )


def written_twice(
    graph: Graph, first: Node, second: Node, attribute: str, ways: Sequence[Way]
) -> Diagnostic:
    return error(
        "P2020",
        (graph, second.name_span),
        (
            f"`{second.name}` and `{first.name}` run side by side and both write `{attribute}`"
            if first is not second
            else f"`{first.name}` runs in two branches side by side, and both write `{attribute}`"
        ),
        label="who comes last would win",
        related=(related_to(graph, first.name_span, "written here"),) if first != second else (),
        help="let one of them write it, or put one behind the other",
        ways=ways,
    )


def interrupted_twice(graph: Graph, first: Node, second: Node, way: Way) -> Diagnostic:
    return error(
        "P2027",
        (graph, second.name_span),
        f"`{second.name}` and `{first.name}` wait for the same event, `{second.event}`, at one time",
        label="the second one",
        related=(related_to(graph, first.name_span, "the first one"),),
        help="one of them is enough: `of: any` means the events that are a mission's own, too",
        ways=(way,),
    )


def unwatched_limit(graph: Graph, node: Node, way: Way) -> Diagnostic:
    second = behind(graph, node)
    does = "breaks off" if node.block.interrupts else "sets a limit to"
    return error(
        "P2023",
        (graph, node.name_span),
        f"`{node.name}` {does} a flight, but no block beside it watches the flight",
        help=(
            put_beside(graph, node, second, way)
            if second and not second.block.limits
            else "put it on one branch of a fork, a block that only watches on another, and let both meet "
            "at a gate"
        ),
        ways=(way,),
    )


def too_deep(graph: Graph, fork: Fork, most: int) -> Diagnostic:
    return error(
        "P2026",
        (graph, graph.node[fork[0]].name_span),
        f"forks lie in each other more than {most} deep",
        label=f"here is {fork_of(fork)}",
        help="close forks before others begin",
    )
