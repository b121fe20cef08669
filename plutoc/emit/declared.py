"""What blocks of other packages may give: checks, plan and code rest on it, so it is asked for.

Ours are held to their declarations by our tests, and cost nothing where they fly.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from plutoc.check.model import Checked
from plutoc.emit.embed import OURS
from plutoc.emit.python import items
from plutoc.graph.model import Node
from plutoc_runtime.domain.status import IN_GRAPH, Status


def declared_of(checked: Checked) -> Mapping[str, str]:
    """Return the statuses that each such block may give where it is called, as Python has them."""
    return {node.name: _of(node, checked) for node in checked.graph.nodes if node.package != OURS}


def _of(node: Node, checked: Checked) -> str:
    if node.block.gate is not None:  # each of its branches brings a status
        return _tuple(checked.leaves.get(node.name, ()))
    taken = checked.arrives.get(node.name, ())
    ways = {s.name: _tuple(node.emitted(s)) for s in IN_GRAPH if s in taken}
    if len(set(ways.values())) == 1:
        return next(iter(ways.values()))
    return f"{{{', '.join(f'{name}: {given}' for name, given in ways.items())}}}[status]"


def _tuple(statuses: Collection[Status]) -> str:
    return items(status.name for status in IN_GRAPH if status in statuses)
