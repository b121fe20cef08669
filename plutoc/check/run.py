"""All checks of a graph, a line each."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeVar

from plutoc.check import ending, errors, flights, forks, parallel, reach, resume
from plutoc.check.branches import Branches, branches
from plutoc.check.flow import Flow, Place
from plutoc.check.model import Checked
from plutoc.check.statuses import creation, explore, stop_if_tangled
from plutoc.diagnostic import Diagnostic, Rejected, in_order
from plutoc.graph.model import Edge, Graph, Node
from plutoc_runtime.domain.status import Status

T = TypeVar("T", str, Edge)


def check(graph: Graph) -> tuple[Checked, tuple[Diagnostic, ...]]:
    """Return the graph with what the checks found out, and their warnings.

    Raises `Rejected` with all errors of the graph, if it has any.
    """
    creators, edges, found = reach.entry(graph)
    if not creators or (found and not graph.outgoing[creators[0].name]):
        raise Rejected(in_order(found))  # no mission moves: nothing else can be checked
    names = [node.name for node in creators]
    begun = tuple(map(creation, names))
    flow = explore(graph, edges, begun)
    parallels = branches(flow)
    unclosed = forks.unclosed(flow, parallels)
    flown = forks.flown(parallels, unclosed)
    # what a flight before a gate leads to is not told: the flight is
    sure = explore(graph, edges, begun, barred=flown) if flown else flow
    seen = {split.fork for split in sure.entries}
    open_forks = [wrong for fork, wrong in unclosed.items() if fork in seen]
    unwatched = parallel.unwatched_limits(sure, parallels)
    lacking = reach.unreached(flow, names, _missed(open_forks, unwatched))
    if not flown:
        lacking += reach.starved(flow)
        found += parallel.written_twice(flow, parallels)
    found += _in_flight(sure, flow, parallels, lacking=bool(lacking or unwatched))
    found += open_forks
    found += lacking
    found += unwatched
    found += parallel.interrupted_twice(sure, parallels)
    found += flights.along_nothing(graph)
    if found and (flown or not _vain(flow, flow)):
        raise Rejected(in_order(found))  # what missions do after a Stop would change none of it
    points = resume.nearest(flow)
    stopped, points_then = _after_a_stop(flow, points)
    if not flown:
        found += _vain(flow, stopped)
    if found or (found := forks.too_deep(flow, parallels)):
        raise Rejected(in_order(found))  # the same errors would recur after a Stop
    again = branches(stopped)
    wrong = _in_flight(stopped, stopped, again, lacking=False)
    wrong += forks.unclosed(stopped, again).values()
    if wrong:
        raise Rejected(in_order([errors.after_a_stop(each) for each in wrong]))
    checked = Checked(
        graph=graph,
        arrives=_both(flow.arrives, stopped.arrives),
        leaves=_both(flow.leaves, stopped.leaves),
        carries=_both(flow.carries, stopped.carries),
        forks=tuple(dict.fromkeys((*forks.closed(parallels), *forks.closed(again)))),
        implicit_ends=tuple(
            dict.fromkeys((*ending.implicit_ends(flow), *ending.implicit_ends(stopped)))
        ),
        resumes=resume.resume_points(graph, (points, points_then)),
        entries=resume.entries(graph, (points, points_then), names[1:]),
        explored=len(flow.places),
    )
    return checked, in_order(_warnings(flow, stopped))


def _missed(unclosed: list[Diagnostic], unwatched: list[Diagnostic]) -> Callable[[Node], bool]:
    """Return the blocks that were most likely meant where these findings miss one."""

    def missed(node: Node) -> bool:
        block = node.block
        closes = bool(unclosed) and block.gate is not None
        return closes or (bool(unwatched) and block.watches and not block.limits)

    return missed


def _vain(flow: Flow, stopped: Flow) -> list[Diagnostic]:
    """Return what is said of edges that lead no mission on, not even after a Stop."""
    return [*reach.untaken(flow, stopped), *reach.spent(flow, stopped)]


def _warnings(flow: Flow, stopped: Flow) -> list[Diagnostic]:
    """Return the warnings of a sound graph; for another one most would be guesses."""
    return [
        *reach.spare(flow, stopped),
        *ending.implicitly(flow),
        *flights.held(flow),
        *flights.unmended(flow),
        *flights.unbounded(flow),
        *flights.repeated_unjudged(flow),
    ]


def _in_flight(flow: Flow, whole: Flow, parallels: Branches, *, lacking: bool) -> list[Diagnostic]:
    """Return the errors that missions can run into, each with the shortest path to it.

    The `whole` exploration has what lies in the branches of barred forks, too.
    """
    idle = forks.idle_gates(flow, parallels, lacking=lacking)
    return [
        *ending.stuck(flow, whole, parallels, tuple(idle)),
        *ending.endless(flow, tuple(idle)),
        *idle.values(),
        *flights.undrawn(flow),
        *flights.unlaunched(flow),
    ]


def _after_a_stop(flow: Flow, points: resume.Points) -> tuple[Flow, resume.Points]:
    """Explore missions that resume after a Stop, where they take new paths.

    They may be stopped again, so this repeats until nothing is new. Raises `Rejected` if that is too
    much.
    """
    begun: dict[Place, None] = {}
    looked = 0
    while again := [
        p for p in resume.resumed(flow.graph, points) if p not in flow.places and p not in begun
    ]:
        stop_if_tangled(flow.graph, looked)
        begun.update(dict.fromkeys(again))
        stopped = explore(flow.graph, flow.edges, begun)
        looked += len(stopped.places) + len(flow.graph.nodes)  # the same ones, after each Stop
        points = resume.nearest(stopped)
    return (stopped, points) if begun else (explore(flow.graph, flow.edges, ()), {})


def _both(
    one: Mapping[T, frozenset[Status]], other: Mapping[T, frozenset[Status]]
) -> Mapping[T, frozenset[Status]]:
    """Join the explorations before and after a Stop."""
    return {key: statuses | other.get(key, frozenset()) for key, statuses in one.items()}
