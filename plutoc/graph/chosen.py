"""Hooks that a mission may choose in the place of a block's own: then they have their defaults alone."""

from __future__ import annotations

from collections.abc import Container, Iterator, Sequence

from plutoc.block import HookParam
from plutoc.diagnostic import Diagnostic
from plutoc.graph import value_errors
from plutoc.graph.model import Hook, Node
from plutoc.graph.values import EXAMPLES
from plutoc.source import Source
from plutoc.syntax.tree import HookDecl, Statement


def without_a_value(
    source: Source,
    statements: Sequence[Statement],
    nodes: Sequence[Node],
    hooks: Sequence[Hook],
    partial: Container[str],
) -> Iterator[Diagnostic]:
    """Find parameters that have no value where a mission chooses their hook.

    `partial` are hooks with a mistake in their declaration: what they take is not certain.
    """
    spans = {
        (one.name.span, parameter.name.text): parameter.span
        for one in statements
        if isinstance(one, HookDecl)
        for parameter in one.parameters
    }
    for hook in hooks:
        where = next((node for node in nodes if may_be_chosen(hook, node)), None)
        for one in hook.parameters if where and hook.name not in partial else ():
            if where and one.default is None:
                span = spans[hook.span, one.name]
                default = f"{one.name}: {one.type.value} = {EXAMPLES[one.type]}"
                yield value_errors.chosen_without_a_value(source, span, hook, one, where, default)


def may_be_chosen(hook: Hook, node: Node) -> bool:
    """Return whether a mission can choose a hook at a block that has another one."""
    if node.hook is None or node.hook.name == hook.name:
        return False
    return any(
        isinstance(param, HookParam) and param.instead != "" and param.kind is hook.kind
        for param in node.block.params
    )
