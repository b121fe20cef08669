"""All checks of a graph, a line each."""

from __future__ import annotations

from plutoc.check import ending, failures, flights, forks, gates, order, parallel, reach, stuck
from plutoc.check.branches import branches
from plutoc.check.entry import entry
from plutoc.check.model import Checked
from plutoc.check.statuses import creation, explore
from plutoc.diagnostic import Diagnostic, Rejected, accept_or_raise
from plutoc.graph.model import Graph


def check(graph: Graph) -> tuple[Checked, tuple[Diagnostic, ...]]:
    """Return the graph with what the checks found out, and their warnings.

    Raises `Rejected` with all errors of the graph, if it has any.
    """
    creator, edges, found = entry(graph)
    if creator is None:  # nothing moves: there is nothing else to say
        raise Rejected(found)
    flow = explore(graph, edges, (creation(creator.name),))
    parallels = branches(flow)
    found += reach.unreached(flow, creator.name, stuck.forgotten_gates(flow, parallels))
    found += reach.starved(flow)
    found += reach.untaken(flow)
    found += stuck.stuck(flow, parallels)
    found += stuck.ends(flow)
    found += ending.endless(flow)
    found += forks.unclosed(flow, parallels)
    found += gates.idle(flow, parallels)
    found += parallel.written_twice(flow, parallels)
    found += parallel.unwatched_limits(flow, parallels)
    found += flights.undrawn(flow)
    found += flights.unlaunched(flow)
    found += flights.held(flow)
    found += failures.unmended(flow)
    found += failures.unbounded(flow)
    found += order.repeated_unjudged(flow)
    warnings = accept_or_raise(found)
    checked = Checked(
        graph=graph,
        arrives=flow.arrives,
        leaves=flow.leaves,
        carries=flow.carries,
        forks=forks.closed(parallels),
        implicit_ends=stuck.implicit_ends(flow),
    )
    return checked, warnings
