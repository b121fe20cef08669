"""What a mission has behind it when it leaves a block, and what that leaves it to emit."""

from __future__ import annotations

from collections.abc import Iterator

from plutoc.check.flow import Facts, Place, ordered
from plutoc.graph.model import Graph, Node
from plutoc_runtime.status import Status

OUTCOMES = (Status.STANDBY, Status.COMPLETED, Status.FAILED)
"""How a trip can end: well with more to fly, well as the last one, or not well."""
_MOST_REMEMBERED = 200_000
"""Blocks times different bounds; in a graph with more, no bound is remembered, only its block's
own word is taken: then a loop that only trips with attempts left can leave is not found."""


def bound_of(node: Node) -> int:
    """Return how often a block lets a trip fly, the first time included; 0 is no bound."""
    bound = dict(node.values).get(node.block.bound) if node.block.bound else None
    return int(bound) if bound and node.block.retries else 0


def remembers_attempts(graph: Graph) -> bool:
    """Say whether it is worth it to follow which bounds a trip has used up."""
    return len({bound_of(node) for node in graph.nodes}) * len(graph.nodes) <= _MOST_REMEMBERED


def puts_trips(node: Node) -> bool:
    """Say whether a block's hook may put another trip first."""
    return bool(node.hook and node.hook.emits)


def leaving(node: Node, place: Place, remember: bool) -> Iterator[tuple[Status, Facts]]:
    """Give each status with which a mission can leave a block, and what it has behind it then."""
    facts, bound = place.facts, bound_of(node) if remember else 0
    emitted = ordered(node.emitted(place.status))
    if node.block.watches and facts.outcome in emitted:
        emitted = (facts.outcome,)
    if bound and facts.attempts >= bound and Status.FAILED in emitted:
        emitted = (Status.FAILED,)
    for status in emitted:
        if bound and status is Status.FAILED:
            yield status, facts._replace(attempts=max(facts.attempts, bound))
        else:
            for behind in _behind(node, facts):
                yield status, behind


def _behind(node: Node, facts: Facts) -> tuple[Facts, ...]:
    if node.block.launches:
        return tuple(
            Facts(
                launched=True,
                outcome=outcome,
                # a trip that goes well is followed by another, which has not been flown yet
                attempts=facts.attempts if outcome is Status.FAILED else 0,
            )
            for outcome in OUTCOMES
        )
    if node.block.allocates:
        return (facts._replace(allocated=True, outcome=None),)
    if puts_trips(node):
        return (facts._replace(attempts=0),)
    return (facts,)
