"""Which block of the new app is which block of the old one.

A name and a kind that both have are the same block. What is left over may have been renamed: it is
the same if it is declared alike and stands alike among its neighbours, which may have been renamed,
too. So colours are handed on along the arrows until no more blocks can be told apart.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping

from plutoc.check.flow import ordered
from plutoc.check.model import Checked
from plutoc.graph.model import END, START, Graph, Node

_MOST_ROUNDS = 64
"""So many arrows from a block that both have, a renamed one can be recognised."""

Pairs = Mapping[str, str]
"""Of each block that both have: its old name, and its new one."""
_Colours = dict[str, int]
_Numbers = dict[Hashable, int]


def pairs(old: Checked, new: Checked) -> Pairs:
    """Return the blocks that both have, in the order of the old source."""
    found: dict[str, str] = {}
    for node in old.graph.nodes:
        other = new.graph.node.get(node.name)
        if other and _kind(other) == _kind(node):
            found[node.name] = node.name
    _match_alike(old, new, found)
    _match_nearby(old.graph, new.graph, found)
    taken = set(found.values())
    for name in old.graph.node:  # it has become another kind
        if name not in found and name in new.graph.node and name not in taken:
            found[name] = name
    return {name: found[name] for name in old.graph.node if name in found}


def _match_alike(old: Checked, new: Checked, found: dict[str, str]) -> None:
    """Match what is declared alike and stands alike."""
    if len(found) in (len(old.graph.nodes), len(new.graph.nodes)):
        return
    known: _Numbers = {}
    mine = _first_colours(old.graph, found, known)
    theirs = _first_colours(new.graph, {name: name for name in found.values()}, known)
    told_apart = 0
    for _ in range(_MOST_ROUNDS):
        mine, theirs = _handed_on(old, mine, known), _handed_on(new, theirs, known)
        colours = len({*mine.values(), *theirs.values()})
        if colours == told_apart:
            break
        told_apart = colours
    candidates: dict[int, list[str]] = {}
    taken = set(found.values())
    for name in new.graph.node:
        if name not in taken:
            candidates.setdefault(theirs[name], []).append(name)
    for name in old.graph.node:
        if name not in found and candidates.get(mine[name]):
            found[name] = candidates[mine[name]].pop(0)


def _first_colours(graph: Graph, known_names: Pairs, known: _Numbers) -> _Colours:
    """Give each block a colour: what is matched already has one of its own in both apps."""

    def first(node: Node) -> Hashable:
        return known_names.get(node.name) or (_kind(node), _values(node))

    return {node.name: _number(first(node), known) for node in graph.nodes}


def _handed_on(checked: Checked, colours: _Colours, known: _Numbers) -> _Colours:
    """Mix each block's colour with those around it, and with what the arrows carry."""
    around: dict[str, list[int]] = {name: [] for name in colours}
    for edge in checked.graph.edges:
        carried = ordered(checked.carries[edge])
        source, target = colours.get(edge.source, START), colours.get(edge.target, END)
        if edge.target in around:
            around[edge.target].append(_number(("from", source, carried), known))
        if edge.source in around:
            around[edge.source].append(_number(("to", target, carried), known))
    return {
        name: _number((colour, tuple(sorted(around[name]))), known)
        for name, colour in colours.items()
    }


def _match_nearby(old: Graph, new: Graph, found: dict[str, str]) -> None:
    """Match what is of one kind and has at least half of its neighbours in common."""
    matched = True
    while matched:
        matched = False
        taken = set(found.values())
        left: dict[Hashable, list[Node]] = {}
        for node in new.nodes:
            if node.name not in taken:
                left.setdefault(_kind(node), []).append(node)
        for node in old.nodes:
            if node.name in found:
                continue
            mine = {found.get(name, name) for name in _neighbours(old, node)}
            best, most = None, 0
            for other in left.get(_kind(node), ()):
                common = len(mine & _neighbours(new, other))
                if common > most and 2 * common >= len(mine) and other.name not in taken:
                    best, most = other, common
            if best:
                found[node.name] = best.name
                taken.add(best.name)
                matched = True


def _neighbours(graph: Graph, node: Node) -> set[str]:
    before = {edge.source for edge in graph.incoming[node.name]}
    return before | {edge.target for edge in graph.outgoing[node.name]}


def _kind(node: Node) -> tuple[str, str]:
    return node.package, node.block.name


def _values(node: Node) -> Hashable:
    """What is written beside the kind, without the names of hooks, which may change as well."""
    choices = tuple((name, None if one.hook else one.name) for name, one in node.choices)
    return node.values, choices, node.passed


def _number(what: Hashable, known: _Numbers) -> int:
    return known.setdefault(what, len(known))
