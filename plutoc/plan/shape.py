"""The shape of a chart: what must be passed on the way to each spot, and where its loops are."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from plutoc.plan.chart import Chart, Spot
from plutoc.plan.dominators import immediate_dominators


@dataclass(frozen=True, slots=True, kw_only=True)
class Shape:
    """What a chart's arrows say about its structure."""

    chart: Chart
    order: tuple[Spot, ...]
    """Every spot behind those that lead to it, loops aside."""
    place: Mapping[Spot, int]
    """Where a spot stands in the order."""
    before: Mapping[Spot, tuple[Spot, ...]]
    """The spots with an arrow to it."""
    parent: Mapping[Spot, Spot]
    """The last spot that every way there passes."""
    children: Mapping[Spot, tuple[Spot, ...]]
    """The spots that have it for their parent, in order."""
    number: Mapping[Spot, int]
    """Counts the spots so that all that is below one follows it."""
    size: Mapping[Spot, int]
    """How many there are below a spot, itself included."""
    merges: frozenset[Spot]
    """Spots that two or more arrows lead to, arrows back not counted."""
    shared: frozenset[Spot]
    """The same, with the arrows back."""
    loops: Mapping[Spot, tuple[Spot, ...]]
    """For each spot at which a loop begins, the spots with an arrow back to it."""
    entering: tuple[tuple[Spot, Spot], ...]
    """Arrows back to a loop that is entered elsewhere as well; none, if every loop has one entry."""

    def is_below(self, spot: Spot, other: Spot) -> bool:
        """Is a spot reached only through the other, or the other itself?"""
        return 0 <= self.number[spot] - self.number[other] < self.size[other]

    def below(self, spot: Spot) -> list[Spot]:
        """Return the spot and all that is reached through it only, in order."""
        found = [spot]
        for one in found:
            found.extend(self.children[one])
        return self.ordered(found)

    def ordered(self, spots: Iterable[Spot]) -> list[Spot]:
        """Return some spots in order."""
        return sorted(spots, key=self.place.__getitem__)


def shape(chart: Chart) -> Shape:
    """Return the shape of a chart. It takes no more memory than the chart itself."""
    order = tuple(reversed(_last_things_first(chart)))
    place = {spot: number for number, spot in enumerate(order)}
    arrows = [
        (one, place[way.target])
        for one, spot in enumerate(order)
        for way in chart.ways[spot]
        if way.target
    ]
    before: list[list[int]] = [[] for _ in order]
    for one, two in arrows:
        before[two].append(one)
    parent = immediate_dominators(before)
    size = [1] * len(order)
    for spot in reversed(range(1, len(order))):
        size[parent[spot]] += size[spot]
    # a parent stands before its children, and takes as many numbers as there are below it
    number, following = [0] * len(order), [1] * len(order)
    children: list[list[int]] = [[] for _ in order]
    for spot in range(1, len(order)):
        above = parent[spot]
        children[above].append(spot)
        number[spot] = following[above]
        following[above] += size[spot]
        following[spot] = number[spot] + 1
    loops: dict[int, list[int]] = {}
    forward: list[tuple[int, int]] = []
    for one, two in arrows:
        if 0 <= number[one] - number[two] < size[two]:
            loops.setdefault(two, []).append(one)
        else:
            forward.append((one, two))
    led_to = (two for _, two in forward)
    return Shape(
        chart=chart,
        order=order,
        place=place,
        before={order[i]: tuple(order[j] for j in sources) for i, sources in enumerate(before)},
        parent={order[spot]: order[parent[spot]] for spot in range(1, len(order))},
        children={spot: tuple(order[c] for c in children[i]) for i, spot in enumerate(order)},
        number=dict(zip(order, number, strict=True)),
        size=dict(zip(order, size, strict=True)),
        merges=frozenset(order[spot] for spot, ways in Counter(led_to).items() if ways > 1),
        shared=frozenset(
            spot for spot, sources in zip(order, before, strict=True) if len(sources) > 1
        ),
        loops={order[head]: tuple(order[i] for i in lasts) for head, lasts in loops.items()},
        # in this order an arrow that leads back, and not to where all ways pass, enters a loop
        entering=tuple((order[one], order[two]) for one, two in forward if one >= two),
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


def round_of(shape: Shape, head: Spot) -> frozenset[Spot]:
    """Return the spots on the ways from a loop's head to the arrows that lead back to it."""
    found = {head, *shape.loops[head]}
    queue = [spot for spot in shape.loops[head] if spot != head]
    for spot in queue:
        fresh = [one for one in shape.before[spot] if one not in found]
        found.update(fresh)
        queue.extend(fresh)
    return frozenset(found)


def ahead(shape: Shape, spot: Spot) -> frozenset[Spot]:
    """Return what can be reached from a spot, itself included, without an arrow back."""
    found = {spot: None}
    queue = [spot]
    for one in queue:
        fresh = [
            way.target
            for way in shape.chart.ways[one]
            if way.target is not None
            and way.target not in found
            and not shape.is_below(one, way.target)
        ]
        found.update(dict.fromkeys(fresh))
        queue.extend(dict.fromkeys(fresh))
    return frozenset(found)
