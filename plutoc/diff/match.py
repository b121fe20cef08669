"""Matching the blocks of the new app with those of the old one.

A name and a kind that both have are the same block. What is left over may have been renamed. So we
go along the arrows from what is matched already: a neighbour that is declared alike, and comes by an
arrow that carries the same, is the same block, and its neighbours are next.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from plutoc.block import HookKind
from plutoc.check.flow import ordered
from plutoc.check.model import Checked
from plutoc.graph.model import END, START, Action, Category, Graph, Hook, Node

Pairs = Mapping[str, str]
"""Of each block that both have: its old name, and its new one."""
_Groups = dict[Hashable, list[str]]
_Neighbours = Mapping[str, tuple[str, ...]]
_MOST_SWEEPS, _MOST_NEIGHBOURS = 8, 200
"""Of large apps with little in common we do not try everything."""


def pairs(old: Checked, new: Checked) -> Pairs:
    """Return the blocks that both have, in the order of the old source."""
    matching = _Matching(old=old, new=new, found={}, taken={})
    for node in old.graph.nodes:
        other = new.graph.node.get(node.name)
        if other and _kind(other) == _kind(node):
            matching.match(node.name, node.name)
    for alike in (_declared, _declared_but_hooks):
        if not matching.complete:
            _along_arrows(matching, alike)
    if not matching.complete:
        _nearby(matching)
    for name in old.graph.node:  # it has become another kind
        if name not in matching.found and name in new.graph.node and name not in matching.taken:
            matching.match(name, name)
    return {name: matching.found[name] for name in old.graph.node if name in matching.found}


@dataclass(frozen=True, slots=True, kw_only=True)
class _Matching:
    """What is matched so far."""

    old: Checked
    new: Checked
    found: dict[str, str]
    taken: dict[str, str]

    @property
    def complete(self) -> bool:
        """Whether one of the apps has no block left."""
        return len(self.found) in (len(self.old.graph.nodes), len(self.new.graph.nodes))

    def match(self, old: str, new: str) -> None:
        """Take two blocks for the same."""
        self.found[old] = new
        self.taken[new] = old


def _along_arrows(matching: _Matching, alike: Callable[[Node], Hashable]) -> None:
    """Match neighbours of what is matched: first those of which there is one only."""
    events = [(name, name) for name in matching.old.graph.sources[1:]]
    known = [(START, START), *events, (END, END), *matching.found.items()]
    ahead = list(reversed(known))

    def extend(doubtful: bool) -> None:
        while ahead:
            before = ahead.pop()
            for pair in _alike_at(matching, before, alike, doubtful):
                matching.match(*pair)
                known.append(pair)
                ahead.append(pair)
            doubtful = False

    extend(doubtful=False)
    for pair in known:  # it grows meanwhile
        ahead.append(pair)
        extend(doubtful=True)


def _alike_at(
    matching: _Matching, pair: tuple[str, str], alike: Callable[[Node], Hashable], doubtful: bool
) -> Iterator[tuple[str, str]]:
    """Yield what is alike around two blocks that are the same: where in doubt, in source order."""
    mine = _around(matching.old, pair[0], matching.found, alike)
    theirs = _around(matching.new, pair[1], matching.taken, alike)
    for key, names in mine.items():
        others = theirs.get(key, [])
        if len(names) == len(others) and (doubtful or len(names) == 1):
            for one, other in zip(names, others, strict=True):
                if one not in matching.found and other not in matching.taken:
                    yield one, other


def _around(
    checked: Checked, name: str, known: Mapping[str, str], alike: Callable[[Node], Hashable]
) -> _Groups:
    """Return the neighbours of a block that are not known yet, by what they are and how they come."""
    graph = checked.graph
    found: dict[str, list[Hashable]] = {}
    for edge in graph.outgoing.get(name, ()):
        if edge.target != END and edge.target not in known:
            found.setdefault(edge.target, []).append(("to", ordered(checked.carries[edge])))
    for edge in graph.incoming.get(name, ()):
        if edge.source in graph.node and edge.source not in known:
            found.setdefault(edge.source, []).append(("from", ordered(checked.carries[edge])))
    groups: _Groups = {}
    for neighbour, ways in found.items():
        groups.setdefault((alike(graph.node[neighbour]), tuple(ways)), []).append(neighbour)
    return groups


def _nearby(matching: _Matching) -> None:
    """Match what is of one kind and has at least half of its neighbours in common."""
    mine, theirs = _neighbours(matching.old.graph), _neighbours(matching.new.graph)
    for _ in range(_MOST_SWEEPS):
        before = len(matching.found)
        for node in matching.old.graph.nodes:
            if node.name not in matching.found:
                around = [matching.found.get(name, name) for name in mine[node.name]]
                common = _common(matching, node, around, theirs)
                best = max(common, key=common.__getitem__, default=None)
                if best is not None and 2 * common[best] >= len(around):
                    matching.match(node.name, best)
        if len(matching.found) == before:
            break


def _common(
    matching: _Matching, node: Node, around: Iterable[str], theirs: _Neighbours
) -> Counter[str]:
    """Count for each block that this one could be, how many of these neighbours it has."""
    common: Counter[str] = Counter()
    for name in around:
        neighbours = theirs.get(name, ())
        if len(neighbours) <= _MOST_NEIGHBOURS:  # of others, each is a neighbour
            common.update(
                other
                for other in neighbours
                if other in matching.new.graph.node
                and other not in matching.taken
                and _kind(matching.new.graph.node[other]) == _kind(node)
            )
    return common


def _neighbours(graph: Graph) -> _Neighbours:
    found: dict[str, dict[str, None]] = {name: {} for name in (*graph.sources, *graph.node, END)}
    for edge in graph.edges:
        found[edge.source][edge.target] = None
        found[edge.target][edge.source] = None
    return {name: tuple(around) for name, around in found.items()}


def _kind(node: Node) -> tuple[str, str]:
    return node.package, node.block.name


def _declared(node: Node) -> Hashable:
    """All that is written behind a block's name."""
    choices = tuple((name, one.name) for name, one in node.choices)
    hook = node.hook.name if node.hook else None
    return _kind(node), node.values, choices, hook, node.passed, node.event


def _declared_but_hooks(node: Node) -> Hashable:
    """The same without the names of hooks, which may be others as well."""
    choices = tuple((name, None if one.hook else one.name) for name, one in node.choices)
    return _kind(node), node.values, choices, node.passed, node.event


Declared = Action | Hook


def hook_pairs(old: Graph, new: Graph, blocks: Pairs) -> Pairs:
    """Return the names of actions and hooks in both apps: of one name, or renamed.

    Renamed is what is declared alike, and used by the same blocks or as many categories.
    """
    known = {block: block for block in blocks.values()}
    return _paired(
        tuple((one.name, kind_of(one), _signature(one, old, blocks)) for one in declared(old)),
        tuple((one.name, kind_of(one), _signature(one, new, known)) for one in declared(new)),
    )


def category_pairs(old: Graph, new: Graph, hooks: Pairs) -> Pairs:
    """Return the names of the categories in both apps."""
    known = {hook: hook for hook in hooks.values()}
    return _paired(
        tuple((one.name, None, _shape(one, hooks)) for one in old.categories),
        tuple((one.name, None, _shape(one, known)) for one in new.categories),
    )


def declared(graph: Graph) -> tuple[Declared, ...]:
    """Return what a developer writes in hooks.py, in the order of the source."""
    return tuple(sorted((*graph.actions, *graph.hooks), key=lambda one: one.span.start))


def kind_of(one: Declared) -> HookKind:
    """Return what it is."""
    return HookKind.ACTION if isinstance(one, Action) else one.kind


def called_by(node: Node) -> Iterator[str]:
    """Yield the hooks that a block calls."""
    if node.hook:
        yield node.hook.name
    for _, chosen in node.choices:
        if chosen.hook:
            yield chosen.hook.name


_Told = Sequence[tuple[str, Hashable, Hashable]]
"""For each declaration its name, its kind, and what it is declared as."""


def _paired(old: _Told, new: _Told) -> Pairs:
    there = {(name, kind) for name, kind, _ in new}
    found = {name: name for name, kind, _ in old if (name, kind) in there}
    left: dict[Hashable, list[str]] = {}
    for name, kind, shape in new:
        if name not in found:
            left.setdefault((kind, shape), []).append(name)
    for name, kind, shape in old:
        if name not in found and left.get((kind, shape)):
            found[name] = left[kind, shape].pop(0)
    return found


def _signature(one: Declared, graph: Graph, blocks: Mapping[str, str]) -> Hashable:
    users = [node.name for node in graph.nodes if one.name in called_by(node)]
    known = tuple(sorted(blocks[name] for name in users if name in blocks))
    parameters = tuple(sorted((p.name, p.type.value, p.default) for p in one.parameters))
    if isinstance(one, Action):
        able = sum(one.name in (category.actions or ()) for category in graph.categories)
        return known, parameters, one.repeat, one.along, one.returns, one.takes, able
    return known, parameters, one.emits, tuple(sorted(one.writes))


def _shape(one: Category, hooks: Mapping[str, str]) -> Hashable:
    values = (one.payload, one.speed, one.flight_time, one.charge_time, one.reserve)
    can = None if one.actions is None else tuple(sorted(hooks.get(n, n) for n in one.actions))
    return values, can
