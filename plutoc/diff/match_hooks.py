"""Which declaration of the new app is which of the old one: categories, actions and hooks."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping, Sequence

from plutoc.block import HookKind
from plutoc.diff.match import Pairs
from plutoc.graph.model import Action, Category, Graph, Hook, Node

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
        return known, parameters, one.repeat, able
    return known, parameters, one.emits, tuple(sorted(one.writes))


def _shape(one: Category, hooks: Mapping[str, str]) -> Hashable:
    values = (one.payload, one.speed, one.flight_time, one.charge_time, one.reserve)
    can = None if one.actions is None else tuple(sorted(hooks.get(n, n) for n in one.actions))
    return values, can
