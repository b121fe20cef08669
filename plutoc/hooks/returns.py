"""What a hook returns, as far as the text says it, against the statuses or the type it declares."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from plutoc.diagnostic import Diagnostic
from plutoc.hooks import errors
from plutoc.hooks.annotations import Scope
from plutoc.hooks.module import Function, node_span, own_nodes
from plutoc_runtime.domain.status import Status

_STATUS = ".Status."


def of_returns(at: errors.At, function: Function, scope: Scope) -> Iterator[Diagnostic]:
    """Find what is surely not declared, also where another branch is faster when it flies."""
    if at.hook.result is not None:
        yield from _of_result(at, function, at.hook.result)
    emits = at.hook.emits
    if emits is None:
        return
    names = [status.value for status in emits]
    for node in own_nodes(function):
        if not isinstance(node, ast.Return):
            continue
        for value in _values(node):
            said = _said(value, scope)
            if said is None or said in names or (said == "None" and not emits):
                continue
            place = node if isinstance(value, ast.Return) else value
            yield errors.undeclared_return(at.on(node_span(at.hooks, place)), said, names)


def _of_result(at: errors.At, function: Function, result: str) -> Iterator[Diagnostic]:
    """Find constants that are surely of another type than an action declares."""
    fits = {"float", "int"} if result == "float" else {result}
    nodes = list(own_nodes(function))
    if not any(isinstance(node, ast.Return | ast.Raise | ast.While) for node in nodes):
        yield errors.undeclared_result(at, "nothing", result)
    for node in nodes:
        for value in _values(node) if isinstance(node, ast.Return) else ():
            given = value.value if isinstance(value, ast.Constant) else None
            if isinstance(value, ast.Return | ast.Constant) and type(given).__name__ not in fits:
                said = "nothing" if given is None else repr(given)
                yield errors.undeclared_result(at.on(node_span(at.hooks, value)), said, result)


def _values(node: ast.Return) -> Iterator[ast.expr | ast.Return]:
    """Yield what it may return: both sides of `a if b else c`."""
    waiting: list[ast.expr | ast.Return] = [node.value or node]
    while waiting:
        value = waiting.pop()
        if isinstance(value, ast.IfExp):
            waiting += [value.orelse, value.body]
        else:
            yield value


def _said(value: ast.expr | ast.Return, scope: Scope) -> str | None:
    """Return what this is, in words; None where it cannot be known."""
    match value:
        case ast.Return():
            return "None"
        case ast.Constant(value=constant):
            return repr(constant)
        case ast.Attribute() if (scope.path(value) or "").startswith(_STATUS):
            name = (scope.path(value) or "").removeprefix(_STATUS)
            return name if name in Status.__members__ else None
    return None
