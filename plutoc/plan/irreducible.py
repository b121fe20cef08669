"""Making irreducible loops, which have several entries, reducible by duplicating a few blocks.

One place in the loop becomes its entry. A mission that enters elsewhere gets a copy of that place, and of what
follows until the loop's entry or exit. The copies are passed once, so they contain no loops but inner ones.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import islice

import networkx as nx

from plutoc.graph.digraph import loops
from plutoc.plan.chart import Chart, Kind, Spot, Way
from plutoc.plan.shape import Shape, shape

MOST_COPIES = 6
"""For all loops of a body together."""
MOST_HEADS = 100
"""The most spots of a loop that are tried as its entry; of a longer loop only its entries are tried."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Irreducible:
    """A loop with several entries."""

    spots: tuple[Spot, ...]
    entries: tuple[Spot, ...]


def reducible(found: Shape) -> Shape | None:
    """Return a shape in which every loop has one entry; None: it would need too many copies."""
    copies = 0
    while found.entering:
        chart = found.chart
        loop = next(_irreducible_loops(chart, chart.ways))
        regions = _smallest(chart, loop) if len(loop.entries) <= MOST_COPIES else None
        if regions is None:
            return None
        for entry, region in regions.items():
            copies += len(region)
            if copies > MOST_COPIES:
                return None
            chart = _apart(chart, loop, entry, region, copies)
        found = shape(chart)
    return found


def _irreducible_loops(chart: Chart, spots: Iterable[Spot]) -> Iterator[_Irreducible]:
    """Yield loops with several entries, outer ones first; those in loops with one entry, too."""
    inside = dict.fromkeys(spots)
    for loop in loops(
        nx.from_dict_of_lists({s: _after(chart, s, inside) for s in inside}, nx.DiGraph)
    ):
        within = frozenset(loop)
        entered = {
            way.target
            for spot, ways in chart.ways.items()
            if spot not in within
            for way in ways
            if way.target in within
        }
        entries = tuple(spot for spot in loop if spot in entered or spot == chart.entry)
        if len(entries) > 1:
            yield _Irreducible(spots=loop, entries=entries)
        else:
            yield from _irreducible_loops(chart, (spot for spot in loop if spot not in entries))


def _after(chart: Chart, spot: Spot, inside: Mapping[Spot, None]) -> tuple[Spot, ...]:
    targets = (way.target for way in chart.ways[spot])
    return tuple(target for target in targets if target is not None and target in inside)


def _smallest(chart: Chart, loop: _Irreducible) -> Mapping[Spot, tuple[Spot, ...]] | None:
    """Return the regions to copy for the cheapest choice of the loop's entry."""
    heads = loop.spots if len(loop.spots) <= MOST_HEADS else loop.entries
    options = [
        {entry: _region(chart, loop, entry, head) for entry in loop.entries if entry != head}
        for head in heads
    ]
    # the branches of a fork are functions, and a function is written once
    free = [
        regions
        for regions in options
        if not any(spot.kind is Kind.FORK for region in regions.values() for spot in region)
    ]
    return min(free, key=lambda regions: sum(map(len, regions.values())), default=None)


def _region(chart: Chart, loop: _Irreducible, entry: Spot, head: Spot) -> tuple[Spot, ...]:
    """Return what is reachable from an entry before the loop's head or exit."""
    inside = dict.fromkeys(spot for spot in loop.spots if spot != head)
    onward = nx.from_dict_of_lists({s: _after(chart, s, inside) for s in inside}, nx.DiGraph)
    return (entry, *(spot for _, spot in islice(nx.bfs_edges(onward, entry), MOST_COPIES)))


def _apart(
    chart: Chart, loop: _Irreducible, entry: Spot, region: tuple[Spot, ...], number: int
) -> Chart:
    """Return the chart with a copy of a region for entries from outside."""
    copies: dict[Spot | None, Spot] = {spot: replace(spot, copy=number) for spot in region}
    ways = {
        spot: led if spot in loop.spots else _turned(led, {entry: copies[entry]})
        for spot, led in chart.ways.items()
    }
    ways |= {copies[spot]: _turned(chart.ways[spot], copies) for spot in region}
    first = copies[entry] if entry == chart.entry else chart.entry
    return replace(chart, entry=first, ways=ways)


def _turned(ways: tuple[Way, ...], instead: Mapping[Spot | None, Spot]) -> tuple[Way, ...]:
    return tuple(replace(way, target=instead.get(way.target, way.target)) for way in ways)
