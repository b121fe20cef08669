"""Every sentence of the checks, one function a diagnostic. Forks and gates: a file of their own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from plutoc.check import chain
from plutoc.check.flow import Fork, Way, ordered
from plutoc.check.phrases import (
    accepts,
    arrows,
    before_allocation,
    emits_here,
    emits_nothing,
    error,
    fork_of,
    listed,
    or_guarded,
    related_to,
    taken_by,
    warning,
    whole_mission,
    with_emits,
)
from plutoc.check.side_by_side import behind, last_arrow, put_beside, through_gate
from plutoc.diagnostic import Diagnostic, Fix
from plutoc.edits import is_single, without_arrow
from plutoc.graph.model import START, Action, Edge, Graph, Node
from plutoc.graph.wording import all_of
from plutoc.syntax.tokens import joined
from plutoc_runtime.domain.status import Status

# Where missions come in


def no_creator(graph: Graph, of_events: Sequence[Node]) -> Diagnostic:
    what = "missions from the user's trips" if of_events else "missions"
    return error(
        "P2001",
        (graph, graph.name_span),
        f"no block of `{graph.name}` makes {what}",
        related=tuple(
            related_to(graph, node.name_span, "missions of events are made here")
            for node in of_events
        ),
        help="declare a block that makes them and begin with `start -> NAME`; "
        "`plutoc blocks` lists the kinds",
    )


def no_event(graph: Graph, creator: Node) -> Diagnostic:
    known = [event.name for event in graph.events] or ["EVENT"]
    return error(
        "P2003",
        (graph, creator.name_span),
        f"no event leads to `{creator.name}`, which makes missions of events",
        help=f"add `{known[0]} -> {creator.name}`",
    )


def event_elsewhere(graph: Graph, edge: Edge, creators: Sequence[Node]) -> Diagnostic:
    """An event that leads to a block, or to the creator of the user's missions."""
    names = [f"`{node.name}`" for node in creators] or ["a block that does"]
    return error(
        "P2004",
        (graph, edge.span),
        f"the event `{edge.source}` leads to `{edge.target}`, which does not make missions of events",
        related=tuple(related_to(graph, n.name_span, "missions are made here") for n in creators),
        help=f"lead it to {joined(names, 'or')}: it has a hook of the app's own, a `creator`",
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
    target = graph.node.get(edge.target)
    of_events = target is not None and target.block.creates
    drawn = [(each.source, each.target) for each in graph.edges]
    wanted = (START if of_events else creator.name, creator.name if of_events else edge.target)
    arrow = " -> ".join(wanted)
    mend = f"remove it: `{arrow}` is there" if wanted in drawn else f"write `{arrow}` instead"
    return error(
        "P2004",
        (graph, edge.span),
        f"`start` leads to `{edge.target}`, which "
        + ("makes missions of events only" if of_events else "does not make missions"),
        related=(related_to(graph, creator.name_span, "the user's missions are made here"),),
        help=mend,
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
    return f", {all_of(following)}" if following else ""


def along_nothing(graph: Graph, action: Action) -> Diagnostic:
    return error(
        "P2028",
        (graph, action.span),
        f"`{action.name}` is done along the way, and no drone ever flies: no block launches a trip",
        help="lead the missions through a block that launches, or remove the action",
    )


# What nothing reaches


def unreached(graph: Graph, node: Node, behind: Sequence[str]) -> Diagnostic:
    also = f", nor {all_of(behind)} behind it" if behind else ""
    begins = "`start` or an event" if len(graph.sources) > 1 else "`start`"
    return error(
        "P2006",
        (graph, node.name_span),
        f"no path from {begins} reaches `{node.name}`{also}",
        help=f"draw an arrow to `{node.name}`, or remove it",
    )


def starved(
    graph: Graph,
    node: Node,
    edges: Sequence[Edge],
    leaving: Mapping[str, Sequence[Status]],
    way: Way,
    before: Node | None,
) -> Diagnostic:
    """`before` is the block at the end of the way, if it watches the flight that this one would watch."""
    return error(
        "P2007",
        (graph, node.name_span),
        f"`{node.name}` never gets a mission: it accepts {accepts(node)}",
        related=tuple(
            related_to(graph, edge.span, f"`{edge.source}` emits {listed(leaving[edge.source])}")
            for edge in edges
        ),
        help=put_beside(graph, before, node, way) if before else _fed(graph, node, leaving),
        ways=(way,),
    )


def _fed(graph: Graph, node: Node, leaving: Mapping[str, Sequence[Status]]) -> str:
    if node.block.holds and all(Status.RUNNING in statuses for statuses in leaving.values()):
        return f"it cannot hold a mission in flight: put it {before_allocation(graph, node)}"
    if node.block.limits:
        whole = "" if node.block.interrupts else f"; {whole_mission(graph)}"
        return f"lead an arrow here from a block that launches{whole}"
    return "lead an arrow here from a block that emits what it accepts"


def untaken(graph: Graph, edge: Edge, leaving: Sequence[Status], way: Way) -> Diagnostic:
    return error(
        "P2008",
        (graph, edge.guard_span or edge.span),
        f"no mission ever takes the arrow `{edge.source} -> {edge.target}`",
        label=f"takes {listed(ordered(edge.takes))}" if edge.takes else "nothing is left for it",
        related=(emits_here(graph, edge, leaving),),
        help="remove the arrow, or let it take what the block emits",
        ways=(way,),
    )


def nothing_to_fly(graph: Graph, edge: Edge, status: Status, way: Way) -> Diagnostic:
    return error(
        "P2008",
        (graph, edge.guard_span or edge.span),
        f"no mission that takes the arrow `{edge.source} -> {edge.target}` {status.value} has a trip left",
        label=f"it ends at `{edge.target}`, FAILED",
        help="lead FAILED elsewhere: a mission can fly on only where a trip of it failed, or where an "
        "evaluator asked for more trips, STANDBY",
        ways=(way,),
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
    second = behind(graph, node)
    return error(
        "P2009",
        (graph, node.name_span),
        f"a mission that leaves `{node.name}` {listed(statuses, 'or')} is stuck: no arrow takes it",
        related=tuple(
            related_to(graph, edge.span, f"takes {listed(ordered(edge.takes))}")
            for edge in graph.outgoing[node.name]
            if edge.takes
        ),
        help=(
            put_beside(graph, node, second, way) if second else taken_by(node, statuses[0], taker)
        ),
        ways=(way,),
    )


def flight_at_gate(
    graph: Graph, gate: Node, giver: Node | None, ends: Sequence[Status], way: Way
) -> Diagnostic:
    """A branch does not end its flight, but brings it to the gate."""
    cause = (
        f"`{giver.name}` does not end its flight" if giver else "a branch does not end its flight"
    )
    mend = (
        with_emits(giver, ends) if giver else "end each branch with a block that watches the flight"
    )
    return error(
        "P2009",
        (graph, gate.name_span),
        f"a mission that leaves `{gate.name}` RUNNING is stuck: {cause}",
        related=emits_nothing(graph, giver) if giver else (),
        help=mend,
        ways=(way,),
    )


_ARROWS = 8
"""So many are proposed at once."""


def _missing_arrow(graph: Graph, node: Node, statuses: Sequence[Status], gate: str | None) -> str:
    guard = f" when {', '.join(s.value for s in statuses)}" if graph.outgoing[node.name] else ""
    return f"{node.name} -> {gate}{guard}"


def stuck_in_fork(
    graph: Graph,
    fork: Fork,
    left: Sequence[tuple[Node, Sequence[Status]]],
    gate: str | None,
    past: Way | None,
    way: Way,
) -> Diagnostic:
    """`past` is a way from a fork inside past the gate, which closes that one instead."""
    node, statuses = left[0]
    missing = [
        _missing_arrow(graph, each, stays, gate) for each, stays in left if gate != each.name
    ]
    arrow = last_arrow(graph, past) if past else None
    if gate is None:
        meet = "let its branches meet at a gate"
    elif missing:
        meet = f"lead its branches to `{gate}`: add {all_of(missing[:_ARROWS])}"
    elif arrow:
        meet = through_gate(graph, *arrow, gate)
    else:
        meet = f"give the fork inside a gate of its own, and lead that gate to `{gate}`"
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
        help=f"{meet}{or_guarded(graph, fork)}",
        ways=(way,),
    )


def implicit_end(graph: Graph, node: Node, statuses: Sequence[Status], way: Way) -> Diagnostic:
    return warning(
        "P2051",
        (graph, node.name_span),
        f"a mission that leaves `{node.name}` {listed(statuses, 'or')} ends here: "
        "no arrow takes it",
        help=f"to say so, add `{node.name} -> end when {', '.join(s.value for s in statuses)}`",
        ways=(way,),
    )


def endless(graph: Graph, head: Node, way: Way, round_: Sequence[str]) -> Diagnostic:
    return error(
        "P2010",
        (graph, head.name_span),
        f"a mission that comes to `{head.name}` can never end",
        label="no way leads from here to an end",
        help=f"it goes round {_round(round_)}: lead an arrow out of this loop",
        ways=(way,),
    )


def spins(graph: Graph, head: Node, way: Way, round_: Sequence[str]) -> Diagnostic:
    blocks = [graph.node[name] for name in round_]
    same = [
        (
            "a repeater with no round left has none the next time"
            if node.block.repeats
            else "an evaluator says the same until something is flown"
        )
        for node in blocks
        if node.block.repeats or node.block.evaluates
    ]
    return error(
        "P2025",
        (graph, head.name_span),
        f"a mission with nothing left to fly can go round at `{head.name}` for ever",
        label="it leaves only if a hook fails it, or never",
        help=f"it goes round {_round(round_)}{_because(same)}: lead COMPLETED out of this loop",
        ways=(way,),
    )


def _round(blocks: Sequence[str]) -> str:
    """`look → again → look`; a gate is come to and left at one block."""
    once = blocks[:-1] if len(blocks) > 1 and blocks[-1] == blocks[0] else blocks
    return arrows((*once, blocks[0]))


def _because(reasons: Sequence[str]) -> str:
    return f", for {' and '.join(dict.fromkeys(reasons))}" if reasons else ""


def too_tangled(graph: Graph, places: int, steps: int) -> Diagnostic:
    return error(
        "P2026",
        (graph, graph.name_span),
        f"the graph of `{graph.name}` cannot be checked: missions can be in more than {places:,} states, "
        f"or go from one to another in more than {steps:,} ways",
        help="draw it with fewer loops within loops, forks within forks, or bounds on attempts",
    )


# Drones and launches


def no_allocation(graph: Graph, node: Node, way: Way) -> Diagnostic:
    edges = [e for e in graph.outgoing[way[-2].node] if e.target == node.name]
    missing = chain.missing(graph, allocated=False, launched=True)[0]
    through = chain.way_through(graph, edges, way, allocated=False, launched=True)
    return error(
        "P2021",
        (graph, node.name_span),
        f"a mission can come to `{node.name}` without a drone allocated since its last launch",
        label=f"no {missing} before it",
        related=tuple(related_to(graph, edge.span, "on this way") for edge in edges),
        help=through,
        ways=(way,),
    )


def no_launch(graph: Graph, node: Node, way: Way) -> Diagnostic:
    return error(
        "P2022",
        (graph, node.name_span),
        f"a mission can come to `{node.name}` though no trip was launched before",
        help="lead the way through a block that launches the trip",
        ways=(way,),
    )


def left_unlaunched(
    graph: Graph, node: Node, edges: Sequence[Edge], way: Way, *, allocated: bool
) -> Diagnostic:
    """Nothing launches the trip between a block and those that watch its flight."""
    missing = " and no ".join(chain.missing(graph, allocated=allocated, launched=False))
    through = chain.way_through(graph, edges, way, allocated=allocated, launched=False)
    watch = graph.node[edges[0].target]
    return error(
        "P2022",
        (graph, watch.name_span),
        f"there is no {missing} between `{node.name}` and `{watch.name}`: no trip is launched",
        label="it watches a flight",
        related=tuple(related_to(graph, edge.span, "on this way") for edge in edges),
        help=through,
        ways=(way,),
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
        f"a mission waits in `{node.name}` with a drone allocated, which no other mission can use",
        help=f"put `{node.name}` before the block that allocates",
        ways=(way,),
    )


def failures_stop(graph: Graph, node: Node) -> Diagnostic:
    return warning(
        "P2055",
        (graph, node.name_span),
        "a failed trip ends its mission: nothing here puts the trip back",
        label="FAILED leaves here",
        help="if failed trips shall be flown again, lead FAILED through a block that retries; "
        "if not, say so: `-> end when FAILED`",
    )


def fails_forever(
    graph: Graph, node: Node, round_: Sequence[str], others: Sequence[Node]
) -> Diagnostic:
    return warning(
        "P2056",
        (graph, node.name_span),
        f"a trip that always fails is put back by `{node.name}` for ever",
        related=tuple(related_to(graph, each.name_span, "here, too") for each in others),
        help=f"bound the number of attempts in the loop {_round(round_)}",
    )


def repeated_unjudged(graph: Graph, node: Node, judge: Node) -> Diagnostic:
    return warning(
        "P2057",
        (graph, node.name_span),
        f"`{node.name}` repeats a mission before `{judge.name}` has judged it",
        related=(related_to(graph, judge.name_span, "judged only after the last round"),),
        help=f"lead to `{judge.name}` first, and from there to `{node.name}`",
    )
