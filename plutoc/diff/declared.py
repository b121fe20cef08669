"""Comparing declarations: the app's name, its categories, actions, hooks and fields."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from plutoc.diff.blocks import same
from plutoc.diff.both import Both
from plutoc.diff.match import Declared, declared
from plutoc.diff.messages import declared as messages
from plutoc.diff.model import Change
from plutoc.graph.built_in import ACTIONS
from plutoc.graph.categories import PARAMS
from plutoc.graph.chosen import may_be_chosen
from plutoc.graph.model import Action, Category, Graph, Hook, Library, Node
from plutoc_runtime.domain.fields import Entity, Field


def app(both: Both) -> Iterator[Change]:
    """Compare what the apps are called."""
    old, new = both.old.graph, both.new.graph
    if old.name != new.name:
        yield messages.app_renamed(old, new)
    if old.title != new.title:
        yield messages.title_changed(old, new)
    if old.version != new.version:
        yield messages.version_changed(old, new)
    yield from _libraries(old, new)


def _libraries(old: Graph, new: Graph) -> Iterator[Change]:
    """Compare what must be installed; under several conditions, a library is there several times."""
    before, after = _by_name(old), _by_name(new)
    for name, now in after.items():
        was = before.get(name, ())
        if not (was and _same_libraries(was, now)):
            yield messages.library_changed(was, now)
    for name, was in before.items():
        if name not in after:
            yield messages.library_changed(was, ())


def _by_name(graph: Graph) -> dict[str, tuple[Library, ...]]:
    found: dict[str, tuple[Library, ...]] = {}
    for library in graph.libraries:
        found[library.name] = (*found.get(library.name, ()), library)
    return found


def _same_libraries(was: Sequence[Library], now: Sequence[Library]) -> bool:
    """Return whether the same is required, however it is written."""
    written = [{library.requirement for library in each} for each in (was, now)]
    if written[0] == written[1]:
        return True
    from packaging.requirements import Requirement  # slow to import, and seldom asked

    one, other = ({Requirement(text) for text in each} for each in written)
    return one == other


def categories(both: Both) -> Iterator[Change]:
    """Compare what drones can carry and do."""
    old = {one.name: one for one in both.old.graph.categories}
    new = {one.name: one for one in both.new.graph.categories}
    for was, now in both.categories.items():
        before, after = old[was], new[now]
        if was != now:
            yield messages.category_renamed(before, after)
        for param in PARAMS:
            value, other = getattr(before, param.name), getattr(after, param.name)
            if value != other:
                yield messages.category_changed(before, after, param, value, other)
        yield from _abilities(both, before, after)
    kept = set(both.categories.values())
    yield from (
        messages.category_removed(one) for one in old.values() if one.name not in both.categories
    )
    yield from (messages.category_added(one) for one in new.values() if one.name not in kept)


def _abilities(both: Both, before: Category, after: Category) -> Iterator[Change]:
    was, now = before.actions, after.actions
    if was is None or now is None:
        if was is not None:
            yield messages.abilities_changed(before, after, None, ())
        elif now is not None:
            yield messages.abilities_changed(before, after, (), None)
        return
    known = [both.hooks.get(name, name) for name in was]
    gained = [name for name in now if name not in known]
    there = {*ACTIONS, *(one.name for one in declared(both.new.graph))}
    lost = [name for name in known if name not in now and name in there]
    if gained or lost:
        yield messages.abilities_changed(before, after, gained, lost)


def hooks(both: Both) -> Iterator[Change]:
    """Compare what a developer writes in hooks.py."""
    old = {one.name: one for one in declared(both.old.graph)}
    new = {one.name: one for one in declared(both.new.graph)}
    for was, now in both.hooks.items():
        before, after = old[was], new[now]
        if was != now:
            yield messages.hook_renamed(before, after)
        yield from _repeats(before, after)
        yield from _returns(before, after)
        yield from _takes(before, after)
        yield from _parameters(before, after, _by_default(after, both.new.graph))
        yield from _statuses(before, after)
    kept = set(both.hooks.values())
    yield from (messages.hook_removed(one) for one in old.values() if one.name not in both.hooks)
    yield from (messages.hook_added(one) for one in new.values() if one.name not in kept)


def _repeats(old: Declared, new: Declared) -> Iterator[Change]:
    if not (isinstance(old, Action) and isinstance(new, Action)):
        return
    if old.along == new.along and old.repeat != new.repeat:
        yield messages.repeat_changed(old, new)


def _returns(old: Declared, new: Declared) -> Iterator[Change]:
    if isinstance(old, Action) and isinstance(new, Action) and old.returns != new.returns:
        yield messages.returns_changed(old, new)


def _takes(old: Declared, new: Declared) -> Iterator[Change]:
    if isinstance(old, Action) and isinstance(new, Action) and old.takes != new.takes:
        yield messages.takes_changed(old, new)


def _statuses(old: Declared, new: Declared) -> Iterator[Change]:
    if not (isinstance(old, Hook) and isinstance(new, Hook)):
        return
    if old.emits != new.emits:
        yield messages.emits_changed(old, new)
    if sorted(old.writes) != sorted(new.writes):
        yield messages.writes_changed(old, new)


def _by_default(one: Declared, graph: Graph) -> bool:
    """Return whether missions files can name it without values for all that it takes."""
    if isinstance(one, Action):
        return True
    return any(may_be_chosen(one, node) for node in graph.nodes)


def _parameters(old: Declared, new: Declared, by_default: bool) -> Iterator[Change]:
    before = {parameter.name: parameter for parameter in old.parameters}
    after = {parameter.name: parameter for parameter in new.parameters}
    for name, now in after.items():
        was = before.get(name)
        if was is None:
            yield messages.parameter_added(old, new, now)
        elif was.type is not now.type:
            yield messages.type_changed(old, new, was, now)
        elif by_default and not same(was.default, now.default):
            yield messages.default_changed(old, new, was, now)  # others get theirs from a block
    for name, was in before.items():
        if name not in after:
            yield messages.parameter_removed(old, new, was)


_Fields = dict[tuple[Entity, str], tuple[Field, Node]]


def fields(both: Both) -> Iterator[Change]:
    """Tell which fields missions files may have now, and which no more."""
    before, after = _fields(both.old.graph), _fields(both.new.graph)
    for on in Entity:
        more = [one for key, one in after.items() if key not in before and key[0] is on]
        if more:
            yield messages.fields_added(on, more)
        less = [one for key, one in before.items() if key not in after and key[0] is on]
        if less:
            yield messages.fields_removed(on, less)


def _fields(graph: Graph) -> _Fields:
    found: _Fields = {}
    for node in graph.nodes:
        for field in node.block.needs:
            found.setdefault((field.on, field.name), (field, node))
    return found
