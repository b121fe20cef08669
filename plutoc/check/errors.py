"""Every sentence of the checks, one function a diagnostic."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from plutoc.check.branches import Astray, Branch
from plutoc.check.flow import Fork, Way, ordered
from plutoc.check.words import (
    accepts,
    arrows,
    emits_here,
    error,
    fate,
    fork_of,
    is_flown,
    listed,
    names,
    related_to,
    taken_by,
    there,
    warning,
)
from plutoc.diagnostic import Diagnostic, Fix
from plutoc.edits import is_single, without_arrow
from plutoc.graph.model import Edge, Graph, Node
from plutoc_runtime.status import Status

# Where missions come in


def no_creator(graph: Graph) -> Diagnostic:
    return error(
        "P2001",
        (graph, graph.name_span),
        f"no block of `{graph.name}` makes missions",
        help="declare a block that makes them and begin with `start -> NAME`; "
        "`plutoc blocks` lists the kinds",
    )


def second_creator(graph: Graph, node: Node, first: Node) -> Diagnostic:
    return error(
        "P2002",
        (graph, node.name_span),
        f"`{node.name}` makes missions, and so does `{first.name}`: there must be exactly one",
        label="a second one",
        related=(related_to(graph, first.name_span, "missions are made here already"),),
        help=f"remove `{node.name}`, or lead its arrows from `{first.name}`",
    )


def no_start(graph: Graph, creator: Node) -> Diagnostic:
    return error(
        "P2003",
        (graph, creator.name_span),
        f"nothing leads from `start` to `{creator.name}`",
        help=f"add `start -> {creator.name}`: missions begin there",
    )


def start_elsewhere(graph: Graph, edge: Edge, creator: Node) -> Diagnostic:
    return error(
        "P2004",
        (graph, edge.span),
        f"`start` leads to `{edge.target}`, which does not make missions",
        related=(related_to(graph, creator.name_span, "missions are made here"),),
        help=f"`start` leads to `{creator.name}` only; draw `{creator.name} -> {edge.target}`",
    )


def into_creator(graph: Graph, edge: Edge, creator: Node) -> Diagnostic:
    return error(
        "P2005",
        (graph, edge.span),
        f"`{edge.source}` leads back to `{creator.name}`, which only makes new missions",
        related=(related_to(graph, creator.name_span, "missions are made here"),),
        help=f"lead the arrow to what comes after it{_named(graph, creator)}; another round of a "
        "mission is started by a block that repeats",
    )


def _named(graph: Graph, creator: Node) -> str:
    following = [edge.target for edge in graph.outgoing[creator.name]]
    return f", {names(following)}" if following else ""


# What nothing reaches


def unreached(graph: Graph, node: Node, behind: Sequence[str]) -> Diagnostic:
    also = f", nor {names(behind)} behind it" if behind else ""
    return error(
        "P2006",
        (graph, node.name_span),
        f"no path from `start` reaches `{node.name}`{also}",
        help=f"draw an arrow to `{node.name}`, or remove it",
    )


def starved(
    graph: Graph,
    node: Node,
    edges: Sequence[Edge],
    leaving: Mapping[str, Sequence[Status]],
    way: Way,
) -> Diagnostic:
    return error(
        "P2007",
        (graph, node.name_span),
        f"`{node.name}` never gets a mission: it accepts {accepts(node)}",
        related=tuple(
            related_to(graph, edge.span, f"`{edge.source}` emits {listed(leaving[edge.source])}")
            for edge in edges
        ),
        help=f"lead an arrow here from a block that emits what it accepts{there(way)}",
    )


def untaken(graph: Graph, edge: Edge, leaving: Sequence[Status], way: Way) -> Diagnostic:
    return error(
        "P2008",
        (graph, edge.guard_span or edge.span),
        f"no mission ever takes the arrow `{edge.source} -> {edge.target}`",
        label=f"takes {listed(ordered(edge.takes))}" if edge.takes else "nothing is left for it",
        related=(emits_here(graph, edge, leaving),),
        help=f"remove the arrow, or let it take what the block emits{there(way)}",
    )


def spare_guard(
    graph: Graph, edge: Edge, spare: Sequence[Status], leaving: Sequence[Status]
) -> Diagnostic:
    return warning(
        "P2052",
        (graph, edge.guard_span or edge.span),
        f"`{edge.source}` never emits {listed(spare, 'or')} here",
        related=(emits_here(graph, edge, leaving),),
        help=f"leave {listed(spare)} out of the guard",
        fix=_without_spare(graph, edge, spare),
    )


def _without_spare(graph: Graph, edge: Edge, spare: Sequence[Status]) -> Fix | None:
    """The guard without statuses, unless it guards other arrows, too, which may need them."""
    alone = is_single(graph.source, (edge.source, edge.target), edge.span)
    if edge.guard_span is None or not alone:
        return None
    kept = ", ".join(status.value for status in edge.guard or () if status not in spare)
    return Fix(span=edge.guard_span, text=f"when {kept}")


def idle_otherwise(graph: Graph, edge: Edge, leaving: Sequence[Status]) -> Diagnostic:
    return warning(
        "P2053",
        (graph, edge.guard_span or edge.span),
        f"nothing is left for the arrow `{edge.source} -> {edge.target}`",
        label="takes what no other arrow takes",
        related=(emits_here(graph, edge, leaving),),
        help="remove it: the other arrows take every status",
        fix=without_arrow(graph.source, (edge.source, edge.target), edge.span, edge.guard_span),
    )


# Where missions are left


def stuck(
    graph: Graph, node: Node, statuses: Sequence[Status], way: Way, taker: str | None
) -> Diagnostic:
    return error(
        "P2009",
        (graph, node.name_span),
        f"a mission that leaves `{node.name}` {listed(statuses, 'or')} is stuck: no arrow takes it",
        related=tuple(
            related_to(graph, edge.span, f"takes {listed(ordered(edge.takes))}")
            for edge in graph.outgoing[node.name]
            if edge.takes
        ),
        help=f"{taken_by(node, statuses[0], taker)}{there(way)}",
    )


_ARROWS = 8
"""So many are proposed at once."""


def _missing_arrow(graph: Graph, node: Node, statuses: Sequence[Status], gate: str) -> str:
    guard = f" when {', '.join(s.value for s in statuses)}" if graph.outgoing[node.name] else ""
    return f"{node.name} -> {gate}{guard}"


def stuck_in_fork(
    graph: Graph,
    fork: Fork,
    left: Sequence[tuple[Node, Sequence[Status]]],
    gate: str | None,
    way: Way,
) -> Diagnostic:
    node, statuses = left[0]
    if gate is None:
        meet = "let its branches meet at a gate"
    else:
        missing = [_missing_arrow(graph, each, stays, gate) for each, stays in left[:_ARROWS]]
        meet = f"lead its branches to `{gate}`: add {names(missing)}"
    return error(
        "P2009",
        (graph, node.name_span),
        f"a mission that leaves `{node.name}` {listed(statuses, 'or')} is stuck, "
        f"and {fork_of(fork)} is not closed",
        label="no arrow takes it",
        related=tuple(
            related_to(
                graph, other.name_span, f"nothing takes {listed(stays, 'or')} from here, either"
            )
            for other, stays in left[1:]
        ),
        help=f"{meet}; or, if only one of the arrows from `{fork[0]}` was meant to take "
        f"{fork[1].value}, guard the others with `when`{there(way)}",
    )


def implicit_end(graph: Graph, node: Node, statuses: Sequence[Status], way: Way) -> Diagnostic:
    return warning(
        "P2051",
        (graph, node.name_span),
        f"a mission that leaves `{node.name}` {listed(statuses, 'or')} ends here: "
        "no arrow takes it",
        help=f"to say so, add `{node.name} -> end when {', '.join(s.value for s in statuses)}`{there(way)}",
    )


def endless(graph: Graph, head: Node, way: Way, round_: Sequence[str]) -> Diagnostic:
    return error(
        "P2010",
        (graph, head.name_span),
        f"a mission that comes to `{head.name}` can never end",
        label="no way leads from here to an end",
        help=f"it goes round {arrows((*round_, round_[0]))}: lead an arrow out of this loop"
        f"{there(way)}",
    )


# Forks and gates


def astray(
    graph: Graph, branches: Sequence[tuple[Branch, Astray]], gates: Sequence[str], way: Way
) -> Diagnostic:
    first, lost = branches[0]
    guard = f"only one of the arrows was meant to take {first.fork[1].value}, guard the others"
    if gates:
        mend = f"close the fork first, at `{gates[0]}`; or, if {guard} with `when`"
    else:
        mend = f"if {guard} with `when`; else let the branches meet at a gate"
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
        help=f"{mend}{there(way)}",
    )


def different_gates(
    graph: Graph, branches: Sequence[Branch], gates: Sequence[str], ways: Sequence[Way]
) -> Diagnostic:
    closing = [
        related_to(
            graph, b.edge.span, f"the branch to `{b.edge.target}` closes at {names([*b.gates])}"
        )
        for b in branches
        if b.gates
    ]
    return error(
        "P2013",
        (graph, closing[0].span),
        f"{fork_of(branches[0].fork)} closes at different gates: {names(gates)}",
        label=closing[0].label,
        related=tuple(closing[1:]),
        help=f"lead all branches to one gate{there(*ways)}",
    )


def never_closes(graph: Graph, branch: Branch, gates: Sequence[str], way: Way | None) -> Diagnostic:
    return error(
        "P2014",
        (graph, branch.edge.span),
        f"the branch to `{branch.edge.target}` of {fork_of(branch.fork)} can go round for ever",
        label="it does not always close",
        help=f"lead every way through it to {f'`{gates[0]}`' if gates else 'a gate'}"
        f"{there(way)}",
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
        help=f"lead the branch to `{gate}`{there(way)}",
    )


def outside_fork(graph: Graph, node: Node, way: Way) -> Diagnostic:
    return error(
        "P2016",
        (graph, node.name_span),
        f"a mission can come to `{node.name}` outside of the fork that closes there",
        related=tuple(
            related_to(graph, edge.span, "it comes along here")
            for edge in graph.incoming[node.name]
            if edge.source == way[-2].node
        ),
        help=f"lead this way past the gate{there(way)}",
    )


def closes_nothing(graph: Graph, node: Node, way: Way) -> Diagnostic:
    return error(
        "P2017",
        (graph, node.name_span),
        f"`{node.name}` closes no fork: a gate needs at least two branches",
        help="fork before it (two arrows that take the same status), or remove the gate"
        f"{there(way)}",
    )


def breeds(graph: Graph, first: Branch, way: Way) -> Diagnostic:
    return error(
        "P2018",
        (graph, first.edge.span),
        f"{fork_of(first.fork)} comes round to itself before it closes: its clones multiply without end",
        help=f"close it at a gate before the way leads back{there(way)}",
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
        help=f"give the fork inside a gate of its own, and lead that gate to `{gate}`{there(way)}",
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
        help=f"let one of them write it, or put one behind the other{there(*ways)}",
    )


def unwatched_limit(graph: Graph, node: Node, way: Way) -> Diagnostic:
    return error(
        "P2023",
        (graph, node.name_span),
        f"`{node.name}` sets a limit to a flight, but no block beside it watches the flight",
        help="put it on one branch of a fork, a block that only watches on another, and let both meet "
        f"at a gate{there(way)}",
    )


# Drones and launches


def no_allocation(graph: Graph, node: Node, way: Way) -> Diagnostic:
    return error(
        "P2021",
        (graph, node.name_span),
        f"a mission can come to `{node.name}` without a drone allocated since its last launch",
        help=f"lead the way through a block that allocates a drone{there(way)}",
    )


def no_launch(graph: Graph, node: Node, way: Way) -> Diagnostic:
    return error(
        "P2022",
        (graph, node.name_span),
        f"a mission can come to `{node.name}` though no trip was launched before",
        help=f"lead the way through a block that launches the trip{there(way)}",
    )


def after_a_stop(wrong: Diagnostic) -> Diagnostic:
    return replace(
        wrong,
        code="P2024",
        message=f"after a Stop, {wrong.message}",
        help=f"a stopped mission goes on at the nearest block behind it that waits or allocates, "
        f"STANDBY if it has flown\n{wrong.help}",
    )


def drone_held(graph: Graph, node: Node, way: Way) -> Diagnostic:
    return warning(
        "P2054",
        (graph, node.name_span),
        f"a mission waits in `{node.name}` with a drone allocated, which nobody else can use",
        help=f"put `{node.name}` before the block that allocates{there(way)}",
    )


def failures_stop(graph: Graph, node: Node) -> Diagnostic:
    return warning(
        "P2055",
        (graph, node.name_span),
        "a failed trip ends its mission: nothing here puts the trip back",
        label="FAILED leaves here",
        help="if failed trips shall be flown again, lead FAILED through a block that retries",
    )


def fails_forever(graph: Graph, node: Node, round_: Sequence[str]) -> Diagnostic:
    return warning(
        "P2056",
        (graph, node.name_span),
        f"a trip that always fails is put back by `{node.name}` for ever",
        help=f"bound the number of attempts in the loop {arrows((*round_, round_[0]))}",
    )


def repeated_unjudged(graph: Graph, node: Node, judge: Node) -> Diagnostic:
    return warning(
        "P2057",
        (graph, node.name_span),
        f"`{node.name}` repeats a mission before `{judge.name}` has judged it",
        related=(related_to(graph, judge.name_span, "judged only after the last round"),),
        help=f"lead to `{judge.name}` first, and from there to `{node.name}`",
    )
