"""Comparing blocks: added, removed and renamed ones, and changed settings."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from plutoc.block import Choice, HookKind, Param
from plutoc.check.facts import bound_of
from plutoc.diff.both import Both
from plutoc.diff.messages import blocks as messages
from plutoc.diff.model import Change
from plutoc.diff.roles import Role, role
from plutoc.graph.model import Choose, Node, Plain


def blocks(both: Both, told: Sequence[Change]) -> Iterator[Change]:
    """Tell of the blocks themselves; `told` is what was found about anything else."""
    about = {name for change in told for name in change.blocks}
    for old, new in both.common():
        if old.name != new.name:
            yield messages.block_renamed(old, new, alone=new.name not in about)
    for node in both.gone():
        yield messages.block_of_one(node, is_new=False)
    for node in both.added():
        yield messages.block_of_one(node, is_new=True)


def settings(both: Both) -> Iterator[Change]:
    """Compare how the blocks are set that both apps have."""
    for old, new in both.common():
        if (old.package, old.block.name) != (new.package, new.block.name):
            yield messages.kind_changed((old, new), *_kinds(old, new))
            continue
        yield from _values(both, old, new)
        yield from _choices(both, old, new)
        yield from _hook(both, old, new)


def _values(both: Both, old: Node, new: Node) -> Iterator[Change]:
    before = dict(old.values)
    for name, now in new.values:
        param, was = new.block.param(name), before.get(name)
        if not isinstance(param, Param) or same(was, now):
            continue
        if role(new) is Role.RETRIES and name == new.block.bound:
            yield messages.retries_changed(both.new, (old, new), bound_of(old), bound_of(new))
        elif new.block.limits and new.block.needs and name == _default(new):
            yield messages.limit_changed((old, new), param, was, now)
        else:
            yield messages.parameter_changed((old, new), param, was, now)


def _default(node: Node) -> str | None:
    """The parameter of a limit that holds where its field is left empty: the only one it has."""
    names = [name for name, _ in node.values]
    return names[0] if len(names) == 1 else None


def _choices(both: Both, old: Node, new: Node) -> Iterator[Change]:
    before = dict(old.choices)
    for name, now in new.choices:
        param, was = new.block.param(name), before[name]
        if isinstance(param, Choice) and _chosen(both, was) != (now.name, now.hook is not None):
            yield messages.choice_changed(both.new, (old, new), param, was.name, now.name)


def _chosen(both: Both, was: Choose) -> tuple[str, bool]:
    """Return what the new app calls it, and whether it is a hook."""
    return (both.hooks.get(was.name, was.name), True) if was.hook else (was.name, False)


def _hook(both: Both, old: Node, new: Node) -> Iterator[Change]:
    was, now = old.hook, new.hook
    if (both.hooks.get(was.name, was.name) if was else None) != (now.name if now else None):
        if was and now and now.kind is HookKind.EVALUATOR:
            yield messages.evaluator_changed(both.new, (old, new), was.name, now.name)
        else:
            names = (was.name if was else None, now.name if now else None)
            yield messages.hook_changed((old, new), *names)
        return
    before = dict(old.passed)
    for name, value in new.passed:
        if now and not same(before.get(name), value) and name in before:
            parameter = next(p for p in now.parameters if p.name == name)
            yield messages.passed_changed((old, new), parameter, before[name], value)


def _kinds(old: Node, new: Node) -> tuple[str, str]:
    """Return what the two kinds are called: with their packages, where only these differ."""
    was, now = old.block.name, new.block.name
    if was == now:
        return f"{old.package}.{was}", f"{new.package}.{now}"
    return was, now


def same(one: Plain | None, other: Plain | None) -> bool:
    """Return whether two values are one: `yes` is not 1."""
    return one == other and isinstance(one, bool) == isinstance(other, bool)
