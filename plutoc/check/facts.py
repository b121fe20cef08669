"""The abstract state of a mission, and the transitions by which it leaves a block."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from plutoc.check.flow import Facts, Place, ordered
from plutoc.graph.model import Node
from plutoc_runtime.domain.status import Status

OUTCOMES = (Status.STANDBY, Status.COMPLETED, Status.FAILED)
"""How a trip can end: well with more to fly, well as the last one, or not well."""
Way = tuple[Status, Facts]
"""A status with which a mission leaves a block, and its facts then."""


def bound_of(node: Node) -> int:
    """Return how often a block lets a trip be flown in all; 0 is no bound."""
    bound = dict(node.values).get(node.block.bound) if node.block.bound else None
    return int(bound) if bound and node.block.retries else 0


def puts_trips(node: Node) -> bool:
    """Return whether a block's hook may put another trip first."""
    return bool(node.hook and node.hook.emits)


def says_the_same(node: Node) -> bool:
    """Return whether a block gives the same answer until something is flown."""
    return node.block.evaluates or node.block.repeats


def is_over(place: Place) -> bool:
    """Whether a mission has nothing left to fly here."""
    return place.status is Status.COMPLETED or place.facts.spent


def leaving(node: Node, place: Place, number: int | None, *, breaks: bool = False) -> Iterator[Way]:
    """Yield each status with which a mission can leave a block, with its facts then.

    A block that can be reached again without a flight has a number, for its remembered answer.
    `breaks`: it launches a flight that an event may break off.
    """
    facts, bound = place.facts, bound_of(node)
    if facts.spent and node.block.needs_trip:
        return  # with no trip left the mission ends here
    emitted = ordered(node.emitted(place.status))
    if node.block.watches and facts.outcome in emitted:
        emitted = (facts.outcome,)
    if bound and facts.attempts >= bound and Status.FAILED in emitted:
        emitted = (Status.FAILED,)
    said = 0 if number is None else facts.said >> 2 * number & 3
    if said and OUTCOMES[said - 1] in emitted:
        emitted = (OUTCOMES[said - 1],)
    for status in emitted:
        for behind in _behind(node, facts, status, bound, breaks):
            yield status, behind if number is None else _remembered(node, behind, status, number)


def unless_failed(ways: Sequence[Way]) -> Sequence[Way]:
    """Return the statuses with which a mission with nothing left to fly leaves a block, if no hook fails it.

    Without a trip in flight RUNNING is a fault, and so is UNEXECUTED once one has been flown. A hook
    that can say nothing else fails it all the same, or leaves it as FAILED as it was.
    """
    return [way for way in ways if way[0] in (Status.STANDBY, Status.COMPLETED)] or ways


def elsewhere(facts: Facts) -> Facts:
    """Drop remembered answers of blocks that are not reached again before the next launch."""
    return facts._replace(said=0) if facts.said else facts


def _behind(
    node: Node, facts: Facts, status: Status, bound: int, breaks: bool
) -> tuple[Facts, ...]:
    if bound and status is Status.FAILED:
        return (facts._replace(attempts=max(facts.attempts, bound)),)
    if node.block.launches:
        # a trip that goes well is followed by another, which has not been flown yet; one whose
        # flight was broken off comes next again, and was not charged
        again = [(Status.STANDBY, facts.attempts)] if breaks and facts.attempts else []
        return tuple(
            Facts(launched=True, outcome=outcome, attempts=attempts)
            for outcome, attempts in (
                *((one, facts.attempts if one is Status.FAILED else 0) for one in OUTCOMES),
                *again,
            )
        )
    if node.block.skips:
        return (facts._replace(attempts=0),)
    if node.block.allocates:
        return (facts._replace(allocated=True, outcome=None),)
    if node.block.evaluates and facts.spent != (status is Status.FAILED):
        return (facts._replace(spent=status is Status.FAILED),)
    if puts_trips(node) and (facts.attempts or facts.spent):
        return (facts._replace(attempts=0, spent=False),)
    return (facts,)


def _remembered(node: Node, facts: Facts, status: Status, number: int) -> Facts:
    """Remember a block's answer, if it is the same until something is flown."""
    # as long as rounds are left, the next answer may differ
    if node.block.repeats and status is not Status.COMPLETED:
        return facts
    others = facts.said & ~(3 << 2 * number)
    return facts._replace(said=others | OUTCOMES.index(status) + 1 << 2 * number)
