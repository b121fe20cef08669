"""The two apps side by side: their matched parts, and the routes of missions in each."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property

from plutoc.check.model import Checked
from plutoc.diff.match import Pairs, category_pairs, hook_pairs, pairs
from plutoc.diff.model import Version
from plutoc.diff.roles import Role, role
from plutoc.diff.routes import Routes, destinations, routes
from plutoc.graph.model import Graph, Node

_GONE = "-"
"""Before the name of a block that the new app has not: no name begins so."""


@dataclass(frozen=True, kw_only=True)
class Side:
    """One app, and what its blocks are called in the new one."""

    version: Version
    names: dict[str, str]

    @property
    def checked(self) -> Checked:
        """The checked graph."""
        return self.version.checked

    @property
    def graph(self) -> Graph:
        """The graph."""
        return self.version.checked.graph

    @cached_property
    def routes(self) -> Routes:
        """Where missions go from each block, with each status."""
        return routes(self.checked)

    @cached_property
    def destinations(self) -> Routes:
        """The same, past the gates."""
        return destinations(self.checked, self.routes)

    @cached_property
    def roles(self) -> Counter[Role]:
        """How many blocks do the same."""
        return Counter(map(role, self.graph.nodes))

    def is_only(self, node: Node) -> bool:
        """Return whether no other block does the same: then it need not be named."""
        return self.roles[role(node)] == 1

    def called(self, names: Iterable[str]) -> tuple[str, ...]:
        """Return blocks of this app as the new one calls them."""
        return tuple(self.names.get(name, name) for name in names)

    def known(self, names: Iterable[str]) -> tuple[str, ...]:
        """The same, in an order that is no matter of meaning: to compare."""
        return tuple(sorted(self.called(names)))


@dataclass(frozen=True, kw_only=True)
class Both:
    """Both apps."""

    old: Side
    new: Side
    blocks: Pairs
    hooks: Pairs
    """Actions, too."""
    categories: Pairs

    def common(self) -> Iterator[tuple[Node, Node]]:
        """Yield the blocks that both have, in the order of the old source."""
        for old, new in self.blocks.items():
            yield self.old.graph.node[old], self.new.graph.node[new]

    def gone(self) -> tuple[Node, ...]:
        """Return the blocks that only the old app has."""
        return tuple(node for node in self.old.graph.nodes if node.name not in self.blocks)

    def added(self) -> tuple[Node, ...]:
        """Return the blocks that only the new app has."""
        known = set(self.blocks.values())
        return tuple(node for node in self.new.graph.nodes if node.name not in known)


def side_by_side(old: Version, new: Version) -> Both:
    """Match the common parts of two apps."""
    mine, theirs = old.checked.graph, new.checked.graph
    blocks = pairs(old.checked, new.checked)
    hooks = hook_pairs(mine, theirs, blocks)
    return Both(
        old=Side(version=old, names={n: blocks.get(n, _GONE + n) for n in mine.node}),
        new=Side(version=new, names={n: n for n in theirs.node}),
        blocks=blocks,
        hooks=hooks,
        categories=category_pairs(mine, theirs, hooks),
    )
