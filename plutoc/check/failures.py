"""What becomes of failures: retried never, or for ever."""

from __future__ import annotations

from collections.abc import Iterable

from plutoc.check import errors
from plutoc.check.components import loops, round_of, trimmed
from plutoc.check.facts import bound_of
from plutoc.check.flow import Flow, Place, blocks_of
from plutoc.diagnostic import Diagnostic
from plutoc.graph.model import Node
from plutoc_runtime.domain.status import Status

_MOST_LOOPS = 10
"""So many are shown, each with its way round; nobody reads those of thousands."""


def unmended(flow: Flow) -> list[Diagnostic]:
    """Warn where a failed trip ends its mission, for want of a block that puts it back."""
    failing = [
        node
        for node in flow.graph.nodes
        if node.block.watches and Status.FAILED in flow.leaves[node.name]
    ]
    if not failing or any(_mends(flow, node) for node in flow.graph.nodes):
        return []
    return [errors.failures_stop(flow.graph, failing[0])]


def unbounded(flow: Flow) -> list[Diagnostic]:
    """Warn of loops that a trip which always fails would go round for ever."""
    after = trimmed(
        {
            place: tuple(t for t in targets if _is_failure(flow, place, t))
            for place, targets in flow.after.items()
        }
    )
    if not any(_is_mended(place, targets) for place, targets in after.items()):
        return []
    found: dict[str, Diagnostic] = {}
    for part in loops(after):
        inside = set(part)
        for place in part:
            node = flow.graph.node[place.node]
            mended = _is_mended(place, [t for t in after[place] if t in inside])
            if len(found) == _MOST_LOOPS:
                return list(found.values())
            if mended and node.name not in found:
                names = blocks_of(round_of(after, part, place))
                found[node.name] = errors.fails_forever(flow.graph, node, names)
    return list(found.values())


def _is_mended(place: Place, targets: Iterable[Place]) -> bool:
    """Does a failed mission leave this place in a better state?"""
    return place.status is Status.FAILED and any(t.status is not Status.FAILED for t in targets)


def _mends(flow: Flow, node: Node) -> bool:
    """Does a failed mission come here, and may it leave in a better state?"""
    return Status.FAILED in flow.arrives[node.name] and bool(
        node.emitted(Status.FAILED) - {Status.FAILED}
    )


def _is_failure(flow: Flow, place: Place, target: Place) -> bool:
    """Can a mission take this step though no flight of its trip succeeds, as often as it likes?"""
    node = flow.graph.node[place.node]
    if target.status is Status.FAILED:
        return True
    if node.block.evaluates or node.block.repeats:
        return False
    return not (node.block.watches or bound_of(node))
