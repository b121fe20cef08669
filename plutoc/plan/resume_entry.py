"""Entries into the chart for each block at which an interrupted mission can resume.

Before:                         After:
    create -> wait                  ? -> create, if the mission begins
    wait -> allocate                ? -> ?wait, else
    allocate -> launch              create -> ?wait
    launch -> allocate              ?wait -> allocate, if the mission goes on there
                                    ?wait -> wait, else
                                    wait -> allocate
                                    …

In the order of the chart stands a question before each such block: does the mission go on behind
here? What stands before the block is passed over then. A block inside a loop gets a copy before the
loop, if little lies between it and the loop's head, perhaps with another block for a head. Else it is
asked in the loop, and a mission that has come to its block is interrupted no more.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import networkx as nx

from plutoc.graph.model import Graph
from plutoc.plan.chart import Chart, Kind, Spot, Way
from plutoc.plan.model import Place
from plutoc.plan.shape import Shape, shape

MOST_ENTRIES = 40
"""The most blocks at which missions resume; with more, a dispatch is shorter."""
MOST_COPIES = 4
"""The most blocks that may be duplicated for one loop."""
MOST_LEADING, MOST_ASIDE = 3, 2
"""Of these, for all that come to the loop, and for those alone that go on at one block."""
MOST_HEADS = 100
"""The most spots of a loop that are tried as its head."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Site:
    """An entry: at a block itself, or at a loop that contains it."""

    spot: Spot
    points: tuple[str, ...]
    """The blocks at which those go on that enter here."""
    key: tuple[int, int, int]
    """Sites are passed in this order."""
    own: frozenset[Spot] = frozenset()
    """The loop that begins here, if one does: missions that come from there are asked nothing."""
    aside: tuple[Spot, ...] = ()
    """A copy for missions that enter here alone, which leads to the head of a loop."""
    whole: bool = False
    """The blocks are inside of the loop that begins here."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Heading:
    """A loop's head, and what is copied so that no other place in it need be entered."""

    head: Spot
    copied: Mapping[Spot, tuple[Spot, ...]]


def entrances(found: Shape, points: Sequence[str], graph: Graph) -> Iterator[Shape]:
    """Yield shapes with entries at these blocks, the preferred one first.

    Those that make missions of events have theirs in the chart already.
    """
    entered = [name for name in points if not graph.node[name].block.creates]
    if not entered:
        yield found
        return
    for other_heads in (True, False) if len(points) <= MOST_ENTRIES else ():
        entering = _Entering(found, points, entered, graph, other_heads=other_heads)
        after = shape(entering.chart())
        if not after.entering:
            yield after


class _Entering:
    """Adds entries to a chart."""

    def __init__(
        self,
        found: Shape,
        places: Sequence[str],
        points: Sequence[str],
        graph: Graph,
        *,
        other_heads: bool,
    ) -> None:
        self.found = found
        self.graph = graph
        self.other_heads = other_heads
        """Whether a loop may get another head."""
        self.rounds = {head: found.loop_body(head) for head in found.loops}
        self.ways = dict(found.chart.ways)
        self.places: tuple[Place, ...] = (None, *places)
        self.points = {self.least_nested(name): name for name in points}
        self.copies = max(spot.copy for spot in found.order)

    def least_nested(self, name: str) -> Spot:
        """Return the spot of a block, of several that which the fewest loops are around."""
        spots = [s for s in self.found.order if s.kind is Kind.BLOCK and s.name == name]
        return min(spots, key=lambda spot: sum(spot in one for one in self.rounds.values()))

    def chart(self) -> Chart:
        found = self.found
        sites = self.sites(found.order, found.chart.entry, looped=False)
        return replace(
            found.chart, entry=self.asked(found.chart.entry, sites, looped=False), ways=self.ways
        )

    def sites(self, spots: Sequence[Spot], first: Spot, *, looped: bool) -> list[_Site]:
        """Return where missions enter a part of the chart, in order, but for where it begins."""
        place, left = self.found.place, dict.fromkeys(spots)
        del left[first]
        sites: list[_Site] = []
        for head in [spot for spot in left if spot in self.rounds]:
            if head in left:  # else it is inside of a loop that was seen before
                loop = self.found.ordered(self.rounds[head])
                if any(spot in self.points for spot in loop[1:]):
                    sites += self.of_loop(loop, looped=looped)
                    left = {spot: None for spot in left if spot not in self.rounds[head]}
        sites += [
            _Site(
                spot=spot,
                points=(self.points[spot],),
                key=(place[spot], 0, 0),
                own=self.rounds.get(spot, frozenset()),
            )
            for spot in left
            if spot in self.points
        ]
        return sorted(sites, key=lambda site: site.key)

    def of_loop(self, loop: Sequence[Spot], *, looped: bool) -> list[_Site]:
        """Return where missions enter that go on somewhere in a loop."""
        head, place, own = loop[0], self.found.place, frozenset(loop)
        heading = self.heading(loop)
        if heading is None:
            inner = self.sites(loop, head, looped=True)
            start = self.asked(head, inner, looped=True, around=looped)
            points = tuple(self.points[spot] for spot in loop if spot in self.points)
            return [_Site(spot=start, points=points, key=(place[head], 0, 0), own=own, whole=True)]
        sites: list[_Site] = []
        for entry, region in heading.copied.items():
            copies = self.copied(region)
            if entry == head:
                self.turn(head, copies[head], but=own)
                own |= self.apart(head, region, [spot for spot in loop if spot not in region])
            sites += [
                _Site(
                    spot=copies[spot],
                    points=(self.points[spot],),
                    key=(place[head], int(entry != head), place[spot]),
                    aside=() if entry == head else tuple(copies.values()),
                )
                for spot in (region if entry == head else (entry,))
                if spot in self.points
            ]
        points = tuple(self.points[spot] for spot in (heading.head,) if spot in self.points)
        return [*sites, _Site(spot=heading.head, points=points, key=(place[head], 2, 0), own=own)]

    def heading(self, loop: Sequence[Spot]) -> _Heading | None:
        """Return the head for which least must be copied; None: it would be too much for each."""
        if not self.other_heads:
            heads = loop[:1]
        else:
            heads = loop if len(loop) <= MOST_HEADS else (loop[0], *self.points)
        options = [self.headed(loop, head) for head in heads if head in loop]
        return min(
            (option for option in options if option is not None),
            key=lambda option: sum(map(len, option.copied.values())),
            default=None,
        )

    def headed(self, loop: Sequence[Spot], head: Spot) -> _Heading | None:
        """Return what must be copied if a loop begins at this head, if it is not too much."""
        copied: dict[Spot, tuple[Spot, ...]] = {}
        for entry in (loop[0], *(spot for spot in loop[1:] if spot in self.points)):
            if entry != head and entry not in copied.get(loop[0], ()):
                most = MOST_LEADING if entry == loop[0] else MOST_ASIDE
                region = self.between(loop, entry, head, most)
                if region is None:
                    return None
                copied[entry] = region
        total = sum(map(len, copied.values()))
        return _Heading(head=head, copied=copied) if total <= MOST_COPIES else None

    def between(
        self, loop: Sequence[Spot], entry: Spot, head: Spot, most: int
    ) -> tuple[Spot, ...] | None:
        """Return what is passed from an entry to the head, if it is little and leads only there."""
        found: dict[Spot, tuple[Spot, ...]] = {}
        queue = [entry]
        for spot in queue:
            targets = dict.fromkeys(way.target for way in self.ways[spot])
            found[spot] = tuple(one for one in targets if one is not None and one != head)
            fresh = [one for one in found[spot] if one not in queue]
            queue += fresh
            if len(queue) > most or self.once(spot) or any(f not in loop for f in fresh):
                return None
        goes_round = not nx.is_directed_acyclic_graph(nx.from_dict_of_lists(found, nx.DiGraph))
        return None if goes_round else tuple(found)

    def once(self, spot: Spot) -> bool:
        """Is this never to be written twice? A flight is not, as people look for it in one place.

        Neither is a fork: its branches are functions.
        """
        return spot.kind is not Kind.BLOCK or self.graph.node[spot.name].block.launches

    def copied(self, region: Sequence[Spot]) -> Mapping[Spot, Spot]:
        """Duplicate some spots."""
        self.copies += 1
        copies = {spot: replace(spot, copy=self.copies) for spot in region}
        for spot, copy in copies.items():
            self.ways[copy] = _turned(self.ways[spot], copies)
        return copies

    def apart(self, head: Spot, region: Sequence[Spot], sources: Sequence[Spot]) -> frozenset[Spot]:
        """Give each way back to what was the head a copy of its own, if there are few.

        So they need not meet anywhere, and what leads to them stays as it is when another one does.
        """
        back = [one for one in sources if any(way.target == head for way in self.ways[one])]
        made: list[Spot] = []
        if len(back) * len(region) <= MOST_LEADING:
            for source in back[1:]:
                copies = self.copied(region)
                self.ways[source] = _turned(self.ways[source], {head: copies[head]})
                made += copies.values()
        return frozenset(made)

    def asked(
        self, first: Spot, sites: Sequence[_Site], *, looped: bool, around: bool = False
    ) -> Spot:
        """Ask before each of these sites whether to enter, and where all begins whether to begin."""
        if not sites:
            return first
        following: Spot | None = None
        own = frozenset[Spot]()
        behind: tuple[str, ...] = ()
        """Where those go on that pass on here."""
        for site in reversed(sites):
            target = site.spot
            if looped and site.points and not site.whole:
                target = self.arriving(target)
                self.turn(site.spot, target, but={*site.own, target})
            if following is None:
                following = target
            elif site.aside:
                gate = _question(site.spot)
                self.turn(following, gate, but={*own, *site.aside})
                others = tuple(place for place in self.places if place not in site.points)
                self.ways[gate] = (
                    _way(site.points, target),
                    _way(others, following),
                )
                following = gate
            else:
                gate = _question(site.spot)
                self.turn(target, gate, but=site.own)
                self.ways[gate] = (self.not_to(behind, target), _way(behind, following))
                following = gate
            own = own if site.aside else site.own
            behind = (*site.points, *behind)
        start = replace(_question(first), kind=Kind.ENTERED_LOOP if looped else Kind.ENTERED)
        self.turn(first, start)
        target = self.arriving(first) if around and first in self.points else first
        self.ways[start] = (self.not_to(behind, target), _way(behind, following))
        return start

    def arriving(self, spot: Spot) -> Spot:
        """Mark where a resumed mission has reached its block."""
        arrived = Spot(kind=Kind.ARRIVED, name=spot.name, copy=spot.copy)
        self.ways[arrived] = (Way(statuses=(), target=spot, to=spot.name),)
        return arrived

    def not_to(self, behind: Sequence[str], target: Spot) -> Way:
        places = tuple(place for place in self.places if place not in behind)
        return _way(places, target)

    def turn(self, spot: Spot, instead: Spot, but: Collection[Spot] = ()) -> None:
        """Redirect all ways to a spot, except those from some others."""
        for one, ways in self.ways.items():
            if one not in but and any(way.target == spot for way in ways):
                self.ways[one] = _turned(ways, {spot: instead})


def _question(spot: Spot) -> Spot:
    return Spot(kind=Kind.ENTERED, name=spot.name, copy=spot.copy, gate=spot.kind.name)


def _way(places: tuple[Place, ...], target: Spot | None) -> Way:
    return Way(statuses=(), target=target, to=target.name if target else "", places=places)


def _turned(ways: tuple[Way, ...], instead: Mapping[Spot, Spot]) -> tuple[Way, ...]:
    return tuple(
        replace(way, target=instead.get(way.target, way.target)) if way.target else way
        for way in ways
    )
