"""Structuring a chart: a body of loops and switches, if possible.

Each spot is written once, where the last spot before it is that every way there passes: in an arm
if one arrow leads there, behind the switch if several do. What loops leave towards stands behind
them. Where a jump would be needed that Python does not have, `Unstructured` is raised.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from plutoc.block import IN_GRAPH
from plutoc.plan.bodies import breaks, continues, falls, switch, without_last_continue
from plutoc.plan.chart import Kind, Spot, Way
from plutoc.plan.model import Arm, Body, Break, Continue, End, Goto, Loop, Step, Switch
from plutoc.plan.shape import Shape
from plutoc_runtime.domain.status import Status

MOST_NESTED_LOOPS = 12
"""Loops in loops; Python itself compiles no more than twenty."""
MOST_NESTED_ARMS = 40
"""Arms in arms; Python itself indents no more than a hundred times."""
MOST_MERGES = 40
"""Places at which the ways of one switch meet; each is written in a call of its own."""
MOST_COPIES = 3
"""Blocks that may be written once more where a jump cannot be written."""
MOST_TRIES = 50
"""How often each spot may be tried in one place or another before we give up."""


class Unstructured(Exception):
    """A jump is needed that Python does not have."""


class GivenUp(Exception):
    """The result would be nested too deeply, or the search takes too long."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Context:
    """The context of a part of a body."""

    follow: Spot | None = None
    """Where falling off the end leads; None: it is not allowed."""
    head: Spot | None = None
    """Where the innermost loop begins."""
    out: Spot | None = None
    """What stands behind the innermost loop, where it is left by `Break`."""
    elsewhere: frozenset[Spot] = frozenset()
    """Spots that are written in another place, behind a loop or as a case."""
    labels: frozenset[Spot] = frozenset()
    """Spots that `Goto` leads to."""
    loops: int = 0
    arms: int = 0
    """How many there are around this piece."""


class Writer:
    """Writes the body of one chart."""

    def __init__(self, shape: Shape, steps: Mapping[Spot, Body], *, copies: bool = False) -> None:
        self.shape = shape
        self.steps = steps
        """What happens at each spot."""
        self.copies = copies
        """May a few blocks be written twice, if a jump follows them?"""
        self.tried = 0
        self.rounds: dict[Spot, frozenset[Spot]] = {}
        self.reached: dict[Spot, frozenset[Spot]] = {}
        """Caches, filled on demand, as computing all may be far too much."""

    def body(self, spot: Spot, around: Context) -> Body:
        """Write a spot, and all that is reached through it only."""
        if spot in self.shape.loops and spot not in around.labels:
            looped, behind = self.loop(spot, around)
            return looped if behind is None else looped + self.body(behind, around)
        return self.plain(spot, around)

    def plain(self, spot: Spot, around: Context) -> Body:
        """Write a spot whose loop, if it has one, has been opened. Straight on, no recursion."""
        written: list[Step] = []
        current: Spot | None = spot
        while current is not None:
            self.tried += 1
            if self.tried > MOST_TRIES * len(self.shape.order):
                raise GivenUp
            written += self.steps[current]
            steps, current = self.onward(current, around)
            written += steps
            while current is not None and current in self.shape.loops:
                steps, current = self.loop(current, around)
                written += steps
        return tuple(written)

    def onward(self, spot: Spot, around: Context) -> tuple[Body, Spot | None]:
        """Write what follows a spot, up to where one line goes on; return the spot there."""
        ways = self.shape.chart.ways[spot]
        merges = self.merges(spot, around)
        if merges:
            return self.merging(ways, merges, spot, around)
        if around.follow is not None and len(ways) > 1:
            return self.switching(ways, (), spot, around), None
        written: Body = ()
        # nothing may fall off the end, so all ways but one are written as arms that leave
        *early, last = sorted(ways, key=lambda way: self.weight(way, spot, around))
        early = [way for way in ways if way in early]
        if early:
            arms = [self.arm(way, spot, around) for way in early]
            written = switch([*arms, _arm((last,), ())])
        else:
            written = _only(last, ())
        if self.inlined(last, spot, around):
            return written, last.target
        return written + self.jump(last.target, around), None

    def merges(self, spot: Spot, around: Context) -> tuple[Spot, ...]:
        """The spots that are written behind this one's switch."""
        found = tuple(
            child
            for child in self.shape.dominators[spot]
            if child in self.shape.merges and child not in around.elsewhere
        )
        if len(found) > MOST_MERGES:
            raise GivenUp
        return found

    def merging(
        self, ways: Sequence[Way], merges: Sequence[Spot], spot: Spot, around: Context
    ) -> tuple[Body, Spot | None]:
        """Write ways that come together again at `merges`; return the last of these."""
        last = merges[-1]
        try:
            within = replace(around, follow=last)
            written = self.switching(ways, merges[:-1], spot, within)
        except Unstructured:
            return self.otherwise(ways, merges, spot, around)
        return written, last if falls(written) else None

    def otherwise(
        self, ways: Sequence[Way], merges: Sequence[Spot], spot: Spot, around: Context
    ) -> tuple[Body, Spot | None]:
        """Write ways that cannot all go on at the last merge: apart, or one merge for each of them."""
        try:
            return self.apart(ways, merges, spot, around), None
        except Unstructured:
            if not self.copies:
                raise
        for one in merges if len(merges) > 1 else ():
            try:
                return self.merging(ways, [m for m in merges if m != one], spot, around)
            except Unstructured:
                continue
        raise Unstructured

    def apart(
        self, ways: Sequence[Way], merges: Sequence[Spot], spot: Spot, around: Context
    ) -> Body:
        """Write the ways that come together at the last merge in one arm, the others beside it."""
        one = [way for way in ways if self.reaches(way, merges[-1])]
        other = [way for way in ways if way not in one]
        firsts = [m for m in merges if any(self.reaches(way, m) for way in one)]
        seconds = [m for m in merges if any(self.reaches(way, m) for way in other)]
        if not other or set(firsts) & set(seconds):
            raise Unstructured
        together = [self.together(one, firsts, spot, around)]
        if seconds:
            together.append(self.together(other, seconds, spot, around))
        else:
            together.extend(self.arm(way, spot, around) for way in other)
        return switch(together)

    def together(
        self, ways: Sequence[Way], merges: Sequence[Spot], spot: Spot, around: Context
    ) -> Arm:
        written, behind = self.merging(ways, merges, spot, around)
        if behind is not None:
            written += self.body(behind, around)
        return _arm(ways, written)

    def switching(
        self, ways: Sequence[Way], merges: Sequence[Spot], spot: Spot, around: Context
    ) -> Body:
        """Write a switch, and behind it the merges that the ways meet at."""
        if merges:
            written, behind = self.merging(ways, merges, spot, around)
            return written if behind is None else written + self.body(behind, around)
        return switch([self.arm(way, spot, around) for way in ways])

    def arm(self, way: Way, spot: Spot, around: Context) -> Arm:
        if way.target is not None and self.inlined(way, spot, around):
            if around.arms == MOST_NESTED_ARMS:
                raise GivenUp
            written = self.body(way.target, replace(around, arms=around.arms + 1))
        else:
            written = self.jump(way.target, around)
        return _arm((way,), written)

    def inlined(self, way: Way, spot: Spot, around: Context) -> bool:
        """Is the target written just where the way leads there?"""
        return (
            way.target is not None
            and self.shape.is_child(way.target, spot)
            and way.target not in self.shape.merges
            and way.target not in around.elsewhere
        )

    def weight(self, way: Way, spot: Spot, around: Context) -> tuple[bool, int]:
        """How much is written where the way leads; of mere jumps, going round weighs most.

        The heaviest way becomes the main line. So arms are short, and few stand in each other.
        """
        if way.target is None or not self.inlined(way, spot, around):
            return way.target is not None and way.target == around.head, 0
        return True, self.shape.size[way.target]

    def reaches(self, way: Way, spot: Spot) -> bool:
        return way.target is not None and spot in self.ahead(way.target)

    def jump(self, target: Spot | None, around: Context, copies: int = MOST_COPIES) -> Body:
        """Write how a spot is reached that is written elsewhere; `copies` may be written again."""
        if target is None:
            return (End(),)
        if target in around.labels:
            return (Goto(label=target.name),)
        if target == around.follow:
            return ()
        if target == around.head:
            return (Continue(),)
        if target == around.out:
            return (Break(),)
        if not self.copies or copies == 0 or target.kind is Kind.FORK:
            raise Unstructured
        ways = self.shape.chart.ways[target]
        rest = (copies - 1) // len(ways)
        arms = [_arm((way,), self.jump(way.target, around, rest)) for way in ways]
        return (
            *self.steps[target],
            *(switch(arms) if len(arms) > 1 else _only(ways[0], arms[0].body)),
        )

    def loop(self, head: Spot, around: Context) -> tuple[Body, Spot | None]:
        """Write a loop; return the spot to go on with behind it."""
        if around.loops == MOST_NESTED_LOOPS:
            raise GivenUp
        for out in self.outs(head, around):
            ours = out is not None and self.ours(out, head, around)
            try:
                behind = () if out is None or ours else self.jump(out, around)
                within = Context(
                    head=head,
                    out=out,
                    elsewhere=around.elsewhere | {spot for spot in (out,) if spot is not None},
                    loops=around.loops + 1,
                    arms=around.arms,
                )
                written = without_last_continue(self.plain(head, within))
            except Unstructured:
                continue
            if not falls(written) and not continues(written):  # all arrows back led to copies
                if breaks(written):
                    continue
                return written, None
            looped: Body = (Loop(head=head.name, body=written),)
            if not breaks(written):
                return looped, None
            return (looped, out) if ours else (looped + behind, None)
        raise Unstructured

    def ours(self, spot: Spot, head: Spot, around: Context) -> bool:
        """Is the spot to be written behind the loop that begins at `head`?"""
        return self.shape.is_below(spot, head) and spot not in around.elsewhere

    def outs(self, head: Spot, around: Context) -> Iterator[Spot | None]:
        """Yield what may stand behind a loop, the most promising first; None: nothing does.

        What is around the loop can be reached in no other way. What only the loop leads to may
        also be written inside it.
        """
        found, chart = self.shape, self.shape.chart
        round_ = self.round(head)
        exits = [
            way.target
            for spot in found.ordered(round_)
            for way in chart.ways[spot]
            if way.target is not None and way.target not in round_
        ]
        behind = [
            child for spot in round_ for child in found.dominators[spot] if child not in round_
        ]
        inside = found.ordered(behind)[::-1]
        around_it = [spot for spot in exits if not self.ours(spot, head, around)]
        meeting = [spot for spot in inside if spot in found.merges]
        likely = dict.fromkeys((*around_it, *meeting, *inside))
        yield from likely
        # What the inside of a loop leads to, whether by the loop or by what follows it. That may
        # be all the rest of the graph: it is looked at only if nothing else will do.
        led_to = dict.fromkeys(
            way.target
            for spot in found.below(head)
            for way in chart.ways[spot]
            if way.target is not None and not found.is_below(way.target, head)
        )
        yield from (spot for spot in led_to if spot not in likely)
        yield None

    def round(self, head: Spot) -> frozenset[Spot]:
        """The spots that go round in a loop."""
        if head not in self.rounds:
            self.rounds[head] = self.shape.loop_body(head)
        return self.rounds[head]

    def ahead(self, spot: Spot) -> frozenset[Spot]:
        """What can be reached from a spot without an arrow back."""
        if spot not in self.reached:
            self.reached[spot] = self.shape.ahead(spot)
        return self.reached[spot]


def _only(way: Way, behind: Body) -> Body:
    """Write the only way from a spot, with the guard that the source has there."""
    if not way.asked:
        return behind
    return (Switch(arms=(Arm(statuses=way.asked, body=(), to=way.to),)), *behind)


def _arm(ways: Sequence[Way], body: Body) -> Arm:
    statuses = {status for way in ways for status in _asked(way)}
    return Arm(
        statuses=tuple(s for s in IN_GRAPH if s in statuses),
        body=body,
        to=", ".join(way.to for way in ways),
        places=tuple(place for way in ways for place in way.places),
    )


def _asked(way: Way) -> tuple[Status, ...]:
    return way.asked or way.statuses
