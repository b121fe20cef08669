"""From a checked graph to its plan."""

from __future__ import annotations

from collections.abc import Mapping

from plutoc.check.model import Checked
from plutoc.graph.model import START, Edge, Graph
from plutoc.plan.chart import Chart, Charts, Kind, Spot
from plutoc.plan.irreducible import reducible
from plutoc.plan.model import Arrived, Body, Branch, Call, Case, Dispatch, End, Join, Plan
from plutoc.plan.resume_entry import entrances
from plutoc.plan.resume_paths import asked_once
from plutoc.plan.shape import Shape, shape
from plutoc.plan.structure import Context, GivenUp, Unstructured, Writer
from plutoc_runtime.domain.status import Status


def build(checked: Checked) -> Plan:
    """Return the plan of the generated coroutine, not optimised: every block is a call."""
    edge = next(e for e in checked.graph.outgoing[START] if checked.carries[e])
    charts = Charts(checked)
    chart = charts.chart(edge.target, checked.carries[edge], checked.entries)
    return Plan(checked=checked, body=_body(charts, chart, {}, tuple(checked.entries)))


def _body(
    charts: Charts, chart: Chart, names: dict[str, int], entries: tuple[str, ...] = ()
) -> Body:
    found = shape(chart)
    steps = {spot: _steps(charts, chart, spot, names) for spot in found.order}
    return _structured(found, steps, entries, charts.checked.graph) or _dispatch(
        found, steps, entries
    )


def _structured(
    found: Shape, steps: Mapping[Spot, Body], entries: tuple[str, ...], graph: Graph
) -> Body | None:
    """Build the body of loops and switches, if possible."""
    one_entry = reducible(found)
    if one_entry is None:
        return None
    for entered in entrances(one_entry, entries, graph):
        written = {spot: _at(spot, steps) for spot in entered.order}
        for copies in (False, True):
            writer = Writer(entered, written, copies=copies)
            try:
                body = writer.body(entered.chart.entry, Context())
            except (Unstructured, GivenUp):
                continue
            created = [name for name in entries if graph.node[name].block.creates]
            return asked_once(body, entries, created)
    return None


def _dispatch(found: Shape, steps: Mapping[Spot, Body], entries: tuple[str, ...] = ()) -> Body:
    """Return an unstructured chart as one dispatch: a case for each spot that is jumped to.

    A spot with a single incoming arrow is inlined, so chains and branches stay together.
    """
    first, entered = found.chart.entry, frozenset(entries)
    if first.kind is Kind.ENTERED:  # whether an event has made the mission: it begins in a case
        first = Spot(kind=Kind.BLOCK, name=first.name)
    places = tuple(
        spot
        for spot in found.order
        if spot.kind is not Kind.ENTERED
        and (
            found.arrows.in_degree(spot) > 1
            or spot == first
            or (spot.kind is Kind.BLOCK and spot.name in entered)
        )
    )
    around = Context(elsewhere=frozenset(places), labels=frozenset(places))
    cases = tuple(
        # each has a writer of its own, so nothing is tried twice
        Case(label=spot.name, body=Writer(found, steps).body(spot, around))
        for spot in places
    )
    return (Dispatch(start=first.name, cases=cases, entries=entries),)


def _at(spot: Spot, steps: Mapping[Spot, Body]) -> Body:
    match spot.kind:
        case Kind.ENTERED | Kind.ENTERED_LOOP:
            return ()  # the ways from there ask
        case Kind.ARRIVED:
            return (Arrived(),)
        case _:
            return steps[spot.original]


def _steps(charts: Charts, chart: Chart, spot: Spot, names: dict[str, int]) -> Body:
    """Build the steps of a spot itself."""
    node = charts.checked.graph.node
    match spot.kind:
        case Kind.BLOCK:
            return (Call(node=node[spot.name]),)
        case Kind.BEHIND | Kind.ENTERED:
            return ()
        case Kind.FORK:
            statuses = chart.arrives[spot]
            branches = tuple(
                _branch(charts, edge, statuses, spot.gate, names) for edge in spot.branches
            )
            return (Join(fork=node[spot.name], gate=node[spot.gate], branches=branches),)
        case _:
            raise AssertionError(f"{spot.kind} is no place of the source")


def _branch(
    charts: Charts, edge: Edge, statuses: frozenset[Status], gate: str, names: dict[str, int]
) -> Branch:
    name = _name(edge.target, names)
    if edge.target == gate:
        path = f"{edge.source} -> {gate}"
        return Branch(name=name, path=path, body=(End(),))
    chart = charts.chart(edge.target, statuses)
    path = " -> ".join((edge.source, *_path(chart), gate))
    return Branch(name=name, path=path, body=_body(charts, chart, names))


def _name(block: str, names: dict[str, int]) -> str:
    """Return a free name for a branch.

    A block's name is a word that begins with a letter. So with an underscore before it, it is
    neither one of Python's own words nor the name of a built-in function. `names` has with each name,
    and with each block, the last number that it got.
    """
    name, number = f"_{block}", names.get(block, 1)
    while name in names:
        number += 1
        name = f"_{block}_{number}"
    names[name] = names[block] = number
    return name


def _path(chart: Chart) -> tuple[str, ...]:
    """The blocks of a branch, up to where its flow divides."""
    found: dict[str, None] = {}
    spot: Spot | None = chart.entry
    while spot is not None:
        if spot.kind is not Kind.BLOCK or spot.name in found:
            return (*found, "...")
        found[spot.name] = None
        if len(chart.ways[spot]) > 1:
            return (*found, "...")
        spot = chart.ways[spot][0].target
    return tuple(found)
