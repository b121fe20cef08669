"""The structure of a chart: dominators, loops and merges."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import networkx as nx

from plutoc.graph.digraph import reachable
from plutoc.plan.chart import Chart, Spot


@dataclass(frozen=True, slots=True, kw_only=True)
class Shape:
    """The structure of a chart."""

    chart: Chart
    order: tuple[Spot, ...]
    """The spots in reverse postorder."""
    place: Mapping[Spot, int]
    """The index of each spot in the order."""
    arrows: nx.MultiDiGraph
    """An arrow for each way."""
    forward: nx.MultiDiGraph
    """The arrows without back edges."""
    dominators: nx.DiGraph
    """The dominator tree: the parent of each spot is its immediate dominator."""
    number: Mapping[Spot, int]
    """Counts the spots so that all that is below one in the tree follows it."""
    size: Mapping[Spot, int]
    """How many there are below a spot, itself included."""
    merges: frozenset[Spot]
    """Spots that two or more arrows lead to, arrows back not counted."""
    loops: Mapping[Spot, tuple[Spot, ...]]
    """For each spot at which a loop begins, the spots with an arrow back to it."""
    entering: tuple[tuple[Spot, Spot], ...]
    """Arrows back to a loop that is entered elsewhere as well; none, if every loop has one entry."""

    def is_below(self, spot: Spot, other: Spot) -> bool:
        """Whether a spot is dominated by the other."""
        return 0 <= self.number[spot] - self.number[other] < self.size[other]

    def is_child(self, spot: Spot, other: Spot) -> bool:
        """Whether the other is the immediate dominator of a spot."""
        return bool(self.dominators.has_edge(other, spot))

    def below(self, spot: Spot) -> list[Spot]:
        """Return the spot and all that it dominates, in order."""
        return self.ordered(nx.dfs_preorder_nodes(self.dominators, spot))

    def ordered(self, spots: Iterable[Spot]) -> list[Spot]:
        """Return some spots in order."""
        return sorted(spots, key=self.place.__getitem__)

    def loop_body(self, head: Spot) -> frozenset[Spot]:
        """Return the spots on the ways from a loop's head to the arrows that lead back to it."""
        backwards = nx.restricted_view(self.arrows.reverse(copy=False), [head], [])
        return frozenset({head}) | reachable(backwards, {*self.loops[head]} - {head})

    def ahead(self, spot: Spot) -> frozenset[Spot]:
        """Return what can be reached from a spot, itself included, without an arrow back."""
        return frozenset((spot, *nx.descendants(self.forward, spot)))


def shape(chart: Chart) -> Shape:
    """Return the shape of a chart. It takes no more memory than the chart itself."""
    arrows = nx.MultiDiGraph()
    arrows.add_nodes_from(chart.ways)
    arrows.add_edges_from(
        (spot, way.target) for spot, ways in chart.ways.items() for way in ways if way.target
    )
    # the last way first, and all in reverse: so the ways of a spot stay in the order of the source
    last_first = nx.dfs_postorder_nodes(
        arrows, chart.entry, sort_neighbors=lambda targets: reversed(list(targets))
    )
    order = tuple(last_first)[::-1]
    place = {spot: number for number, spot in enumerate(order)}
    arrows.remove_nodes_from([spot for spot in chart.ways if spot not in place])
    above = nx.immediate_dominators(arrows, chart.entry)
    tree = nx.DiGraph()
    tree.add_nodes_from(order)
    tree.add_edges_from((above[spot], spot) for spot in order[1:])
    number = {spot: count for count, spot in enumerate(nx.dfs_preorder_nodes(tree, chart.entry))}
    size = dict.fromkeys(order, 1)
    for spot in reversed(order[1:]):
        size[above[spot]] += size[spot]
    forward = nx.MultiDiGraph()
    forward.add_nodes_from(order)
    loops: dict[Spot, list[Spot]] = {}
    for spot in order:
        for way in chart.ways[spot]:
            if way.target is None:
                continue
            if 0 <= number[spot] - number[way.target] < size[way.target]:
                loops.setdefault(way.target, []).append(spot)
            else:
                forward.add_edge(spot, way.target)
    return Shape(
        chart=chart,
        order=order,
        place=place,
        arrows=arrows,
        forward=forward,
        dominators=tree,
        number=number,
        size=size,
        merges=frozenset(spot for spot, ways in forward.in_degree if ways > 1),
        loops={head: tuple(lasts) for head, lasts in loops.items()},
        # in this order an arrow that leads back, and not to where all ways pass, enters a loop
        entering=tuple(
            (spot, target) for spot, target in forward.edges() if place[spot] >= place[target]
        ),
    )
