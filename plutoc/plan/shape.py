"""The shape of a chart: what must be passed on the way to each spot, and where its loops are."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import networkx as nx

from plutoc.plan.chart import Chart, Spot


@dataclass(frozen=True, slots=True, kw_only=True)
class Shape:
    """What a chart's arrows say about its structure."""

    chart: Chart
    order: tuple[Spot, ...]
    """Every spot behind those that lead to it, loops aside."""
    parent: Mapping[Spot, Spot]
    """The last spot that every way there passes."""
    below: Mapping[Spot, frozenset[Spot]]
    """The spot itself, and all that is reached through it only."""
    merges: frozenset[Spot]
    """Spots that two or more arrows lead to, arrows back not counted."""
    shared: frozenset[Spot]
    """The same, with the arrows back."""
    loops: Mapping[Spot, frozenset[Spot]]
    """For each spot at which a loop begins, the spots that go round in it."""
    ahead: Mapping[Spot, frozenset[Spot]]
    """What can be reached from a spot, itself included, without an arrow back."""
    reducible: bool
    """Is every loop entered at one place only?"""


def shape(chart: Chart) -> Shape:
    """Return the shape of a chart."""
    arrows = nx.DiGraph()
    arrows.add_node(chart.entry)
    arrows.add_edges_from((s, w.target) for s, ways in chart.ways.items() for w in ways if w.target)
    order = tuple(reversed(list(_last_things_first(chart))))
    parent: dict[Spot, Spot] = dict(nx.immediate_dominators(arrows, chart.entry))
    parent.pop(chart.entry, None)
    below: dict[Spot, set[Spot]] = {spot: {spot} for spot in order}
    for spot in reversed(order):
        if spot in parent:
            below[parent[spot]] |= below[spot]
    backward = [(one, two) for one, two in arrows.edges if one in below[two]]
    forward = nx.DiGraph(arrows)
    forward.remove_edges_from(backward)
    loops: dict[Spot, set[Spot]] = {}
    for one, head in backward:
        loops.setdefault(head, {head}).update(_round(arrows, one, head))
    reducible = nx.is_directed_acyclic_graph(forward)
    return Shape(
        chart=chart,
        order=order,
        parent=parent,
        below={spot: frozenset(spots) for spot, spots in below.items()},
        merges=frozenset(s for s in order if forward.in_degree(s) > 1),
        shared=frozenset(s for s in order if arrows.in_degree(s) > 1),
        loops={head: frozenset(spots) for head, spots in loops.items()},
        ahead=_ahead(forward, order) if reducible else {},
        reducible=reducible,
    )


def _last_things_first(chart: Chart) -> list[Spot]:
    """Walk depth first, the last way first, and give each spot when all behind it is done.

    So the order that comes of it keeps the ways of a spot in the order of the source.
    """
    done: list[Spot] = []
    seen = {chart.entry}
    stack = [(chart.entry, list(chart.ways[chart.entry]))]
    while stack:
        spot, left = stack[-1]
        target = left.pop().target if left else None
        if target is not None and target not in seen:
            seen.add(target)
            stack.append((target, list(chart.ways[target])))
        elif target is None and not left:
            done.append(spot)
            stack.pop()
    return done


def _round(arrows: nx.DiGraph, last: Spot, head: Spot) -> set[Spot]:
    """The spots on the ways from a loop's head to the arrow that leads back to it."""
    found = {last, head}
    queue = [last] if last != head else []
    for spot in queue:
        fresh = [s for s in arrows.predecessors(spot) if s not in found]
        found.update(fresh)
        queue.extend(fresh)
    return found


def _ahead(forward: nx.DiGraph, order: tuple[Spot, ...]) -> dict[Spot, frozenset[Spot]]:
    found: dict[Spot, frozenset[Spot]] = {}
    for spot in reversed(order):
        found[spot] = frozenset((spot,)).union(*(found[s] for s in forward.successors(spot)))
    return found
