"""The types that a hook is written with, against what arrives and what is wanted."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from plutoc.diagnostic import Diagnostic
from plutoc.emit.python import PYTHON
from plutoc.emit.reactions import exports
from plutoc.emit.stubs import EXPORTS
from plutoc.graph.model import Graph
from plutoc.graph.names import near
from plutoc.hooks import errors
from plutoc.hooks.annotations import Meaning, Scope, meaning, unknown_names
from plutoc.hooks.expected import Expected
from plutoc.hooks.module import Function, Module, node_span
from plutoc.syntax.tokens import shortened

_ARRIVES = {
    "drone": "Drone",
    "trip": "Trip",
    "context": "Context",
    "event": "Event",
    "mission": "Mission",
    "results": "Results",
    "candidates": "Sequence",
    "waiting": "Sequence",
    "drones": "Sequence",
    "now": "float",
}
"""The types of what comes by position."""

_TAKES = {
    "bool": {"int", "float", "complex"},
    "int": {"float", "complex"},
    "float": {"complex"},
    "Sequence": {"tuple", "list"},
}
"""Types besides its own that something can be taken for; every one can be for an object."""

_GIVES = {
    "Assignment": {"Again", "dict", "list", "tuple", "set", "frozenset"},
    "Mission": {"None"},
}
"""What else a hook may say that it returns, where something is wanted: a creator may never make a mission."""

_NEVER_WRONG = "object"
_LONGEST = 40


def of_types(
    graph: Graph, at: errors.At, function: Function, module: Module
) -> Iterator[Diagnostic]:
    """Find types that nothing has, and those of something else; silent where it cannot be known."""
    generic = frozenset(one.name for one in getattr(function, "type_params", ()))
    scope = Scope(
        module=module, app=graph.name, parameters=generic, exports=EXPORTS | exports(graph)
    )
    for annotation, name, arrives in _expected(at.hook, function):
        unknown = list(unknown_names(annotation, scope))
        for one in unknown:
            meant = next(iter(near(one.name, one.options)), None)
            place = at.on(node_span(at.hooks, one.place))
            yield errors.unknown_annotation(place, one.name, meant, one.exported)
        allowed = _meaning(annotation, scope)
        if unknown or arrives is None or allowed is None or _NEVER_WRONG in allowed:
            continue
        place = at.on(node_span(at.hooks, annotation))
        written = shortened(at.hooks.quote(place.span), _LONGEST)
        if name is None:
            fits = {arrives, "int"} if arrives == "float" else {arrives, *_GIVES.get(arrives, ())}
            if not (allowed <= fits if at.hook.result else allowed & fits):
                yield errors.wrong_return(place, written, arrives)
        elif not allowed & {arrives, *_TAKES.get(arrives, ())}:
            events = at.hook.events if arrives == "Event" else ()
            if not allowed & {*events}:
                yield errors.wrong_annotation(place, name, written, " | ".join(events) or arrives)


def _expected(
    hook: Expected, function: Function
) -> Iterator[tuple[ast.expr, str | None, str | None]]:
    """Yield every annotation with its parameter, or None for the result, and with what arrives."""
    arguments = function.args
    by_place = [*arguments.posonlyargs, *arguments.args]
    own = {parameter.name: PYTHON[parameter.type] for parameter in hook.own}
    arrives = {arg: _ARRIVES[name] for arg, name in zip(by_place, hook.passed, strict=False)}
    for arg in (*by_place, arguments.vararg, *arguments.kwonlyargs, arguments.kwarg):
        if arg is not None and arg.annotation is not None:
            several = arg in (arguments.vararg, arguments.kwarg)
            yield arg.annotation, arg.arg, None if several else arrives.get(arg, own.get(arg.arg))
    if function.returns is not None:
        wanted = None if hook.returns == _NEVER_WRONG else hook.returns
        yield function.returns, None, wanted


def _meaning(annotation: ast.expr, scope: Scope) -> Meaning:
    try:
        return meaning(annotation, scope)
    except RecursionError:  # a type of a thousand parts
        return None
