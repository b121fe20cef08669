"""All checks of a graph, a line each."""

from __future__ import annotations

from dataclasses import replace

from plutoc.check import (
    ending,
    errors,
    failures,
    flights,
    forks,
    gates,
    order,
    parallel,
    reach,
    resume,
    stuck,
)
from plutoc.check.branches import Branches, branches
from plutoc.check.entry import entry
from plutoc.check.flow import Flow
from plutoc.check.model import Checked
from plutoc.check.statuses import creation, explore
from plutoc.diagnostic import Diagnostic, Rejected, Severity, accept_or_raise
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
    found += _in_flight(flow, parallels)
    found += reach.unreached(flow, creator.name, stuck.forgotten_gates(flow, parallels))
    found += reach.starved(flow)
    found += stuck.ends(flow)
    found += parallel.written_twice(flow, parallels)
    found += parallel.unwatched_limits(flow, parallels)
    found += flights.held(flow)
    found += failures.unmended(flow)
    found += failures.unbounded(flow)
    found += order.repeated_unjudged(flow)
    stopped = _after_a_stop(flow)
    found += reach.untaken(flow, stopped)
    if not _has_errors(found):
        wrong = _in_flight(stopped, branches(stopped))
        found += map(errors.after_a_stop, wrong)
    if _has_errors(found):  # what is not needed now may be once the errors are mended
        found = [replace(d, fix=None) for d in found]
    warnings = accept_or_raise(found)
    checked = Checked(
        graph=graph,
        arrives=flow.arrives,
        leaves=flow.leaves,
        carries=flow.carries,
        forks=forks.closed(parallels),
        implicit_ends=stuck.implicit_ends(flow),
        resumes=resume.resume_points(flow),
        explored=len(flow.places),
    )
    return checked, warnings


def _in_flight(flow: Flow, parallels: Branches) -> list[Diagnostic]:
    """Find what can happen to a mission on its way: each shown by the shortest way to it."""
    return [
        *stuck.stuck(flow, parallels),
        *ending.endless(flow),
        *forks.unclosed(flow, parallels),
        *gates.idle(flow, parallels),
        *flights.undrawn(flow),
        *flights.unlaunched(flow),
    ]


def _after_a_stop(flow: Flow) -> Flow:
    """Follow missions that were stopped and go on, where that is another way than before."""
    again = [place for place in resume.resumed(flow) if place not in flow.places]
    return explore(flow.graph, flow.edges, again)


def _has_errors(found: list[Diagnostic]) -> bool:
    return any(d.severity is Severity.ERROR for d in found)
