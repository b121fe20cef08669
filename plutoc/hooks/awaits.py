"""A forgotten `await`: a call that makes a coroutine, which nothing then runs."""

from __future__ import annotations

import ast
import builtins
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from plutoc.diagnostic import Diagnostic, Fix
from plutoc.hooks import errors
from plutoc.hooks.annotations import Scope, meaning
from plutoc.hooks.expected import Expected
from plutoc.hooks.module import Function, node_span, own_nodes, yields
from plutoc.hooks.python import parsed
from plutoc.source import Span

MUST_BE_AWAITED = {
    "Context": frozenset({"sleep", "trip_ended"}),
    "LiveDrone": frozenset({"read", "write"}),
}
"""The methods of what hooks are given that are an `async def`."""

_READ = frozenset(
    {"abs", "bool", "float", "int", "len", "max", "min", "print", "round", "str", "sum"}
)
"""Functions of Python that can do nothing with a coroutine."""

Types = Mapping[str, str]
"""What the names within a function stand for: `context` for a `Context`."""


@dataclass(frozen=True, slots=True, kw_only=True)
class _Within:
    """A function, and what its names stand for."""

    function: Function
    types: Types
    hook: Expected | None
    """The hook that it is, if it is one."""
    hidden: frozenset[str]
    """Names that are its own, or of a function around it."""


def forgotten(scope: Scope, hooks: Sequence[Expected]) -> Iterator[Diagnostic]:
    """Find calls that are surely not awaited; silent where the coroutine may be awaited later."""
    yield from sorted(_forgotten(scope, hooks), key=lambda found: found.span.start)


def _forgotten(scope: Scope, hooks: Sequence[Expected]) -> Iterator[Diagnostic]:
    by_name = {hook.name: hook for hook in hooks}
    for within in _functions(scope, by_name):
        nodes = list(own_nodes(within.function))
        parents = {
            child: node
            for node in (within.function, *nodes)
            for child in ast.iter_child_nodes(node)
        }
        made = [
            node
            for node in nodes
            if isinstance(node, ast.Call) and _is_coroutine(node, within, scope)
        ]
        for call in made:
            if _is_lost(call, within, nodes, parents, scope):
                yield _told(call, within, parents, scope)


def _functions(scope: Scope, hooks: Mapping[str, Expected]) -> Iterator[_Within]:
    """Yield every function of the module, those within others too."""
    module = scope.module
    around: list[tuple[ast.AST, Types, frozenset[str]]] = [(parsed(module.source), {}, frozenset())]
    while around:
        outer, types, hidden = around.pop()
        inner = own_nodes(outer) if isinstance(outer, Function) else _statements(outer)
        for function in inner:
            if isinstance(function, ast.ClassDef):
                around.append((function, types, hidden))
            if not isinstance(function, Function):
                continue
            known = module.defined.get(function.name)
            is_hook = known is not None and known.lineno == function.lineno
            hook = hooks.get(function.name) if is_hook else None
            bound = _bindings(function)
            own = _types(function, bound, {**_without(types, bound)}, hook, scope)
            within = _Within(function=function, types=own, hook=hook, hidden=hidden | bound.keys())
            yield within
            around.append((function, own, within.hidden))


def _statements(outer: ast.AST) -> Iterator[ast.AST]:
    """Go through what stands in a module or a class, without what is in its functions and classes."""
    waiting = list(ast.iter_child_nodes(outer))
    while waiting:
        node = waiting.pop()
        yield node
        if not isinstance(node, Function | ast.ClassDef):
            waiting.extend(ast.iter_child_nodes(node))


def _bindings(function: Function) -> Counter[str]:
    """Count how often a function gives each of its names a value."""
    found = Counter(arg.arg for arg in _args(function))
    for node in own_nodes(function):
        if isinstance(node, ast.Name) and not isinstance(node.ctx, ast.Load):
            found[node.id] += 1
        elif isinstance(node, Function | ast.ClassDef):
            found[node.name] += 1
        elif isinstance(node, ast.Import | ast.ImportFrom):
            found.update(alias.asname or alias.name.partition(".")[0] for alias in node.names)
        elif isinstance(node, ast.Global | ast.Nonlocal):
            found.update(2 * node.names)  # another function may give it a value, too
    return found


def _args(function: Function) -> list[ast.arg]:
    given = function.args
    several = [arg for arg in (given.vararg, given.kwarg) if arg is not None]
    return [*given.posonlyargs, *given.args, *given.kwonlyargs, *several]


def _without(types: Types, names: Iterable[str]) -> Types:
    return {name: what for name, what in types.items() if name not in set(names)}


def _types(
    function: Function,
    bound: Counter[str],
    around: dict[str, str],
    hook: Expected | None,
    scope: Scope,
) -> Types:
    """Return what its names stand for: by place, by annotation, or as `context.live(drone)`."""
    given, found = function.args, around
    if hook is not None and not function.decorator_list:
        for arg, gets in zip([*given.posonlyargs, *given.args], hook.passed, strict=False):
            if gets == "context":
                found[arg.arg] = "Context"
    for arg in (*given.posonlyargs, *given.args, *given.kwonlyargs):
        _note(found, arg.arg, arg.annotation, scope)
    for node in own_nodes(function):
        match node:
            case ast.AnnAssign(target=ast.Name(id=name), annotation=annotation):
                _note(found, name, annotation, scope)
            case ast.Assign(targets=[ast.Name(id=name)], value=value):
                if (what := _type(value, found)) is not None:
                    found[name] = what
    return {name: what for name, what in found.items() if bound[name] <= 1}


def _note(found: dict[str, str], name: str, annotation: ast.expr | None, scope: Scope) -> None:
    try:
        allowed = meaning(annotation, scope) if annotation is not None else None
    except RecursionError:  # a type of a thousand parts
        return
    if allowed is not None and len(allowed) == 1 and allowed <= MUST_BE_AWAITED.keys():
        (found[name],) = allowed


def _type(value: ast.expr, types: Types) -> str | None:
    match value:
        case ast.Name(id=name):
            return types.get(name)
        case ast.Call(func=ast.Attribute(value=ast.Name(id=name), attr="live")):
            return "LiveDrone" if types.get(name) == "Context" else None
    return None


def _is_coroutine(call: ast.Call, within: _Within, scope: Scope) -> bool:
    """Return whether a call only makes a coroutine."""
    match call.func:
        case ast.Attribute(value=value, attr=name):
            return name in MUST_BE_AWAITED.get(_type(value, within.types) or "", ())
        case ast.Name(id=name) if name not in within.hidden:
            made = scope.module.defined.get(name)
            is_plain = isinstance(made, ast.AsyncFunctionDef) and not made.decorator_list
            return is_plain and isinstance(made, ast.AsyncFunctionDef) and not yields(made)
    return False


def _is_lost(
    node: ast.expr,
    within: _Within,
    nodes: Sequence[ast.AST],
    parents: Mapping[ast.AST, ast.AST],
    scope: Scope,
) -> bool:
    """Return whether a coroutine at this place is never awaited."""
    parent = parents[node]
    match parent:
        case ast.Expr() | ast.Compare() | ast.BinOp() | ast.UnaryOp():
            return True
        case ast.FormattedValue() | ast.AugAssign():
            return True
        case ast.BoolOp():  # gives one of its sides
            return _is_lost(parent, within, (), parents, scope)
        case (
            ast.If(test=test) | ast.While(test=test) | ast.IfExp(test=test) | ast.Assert(test=test)
        ):
            return test is node
        case ast.Subscript(value=value) | ast.For(iter=value):
            return value is node
        case ast.Call(func=ast.Name(id=name)):
            return name in _READ and name in vars(builtins) and not _is_own(name, within, scope)
        case ast.Call(func=ast.Attribute(value=value, attr="log")):
            return _type(value, within.types) == "Context"
        case ast.Return():
            is_hook = within.hook is not None and not within.function.decorator_list
            return is_hook and isinstance(within.function, ast.AsyncFunctionDef)
        case ast.Assign(targets=[ast.Name(id=name)]) | ast.AnnAssign(target=ast.Name(id=name)):
            uses = [one for one in nodes if isinstance(one, ast.Name) and one.id == name]
            read = [use for use in uses if isinstance(use.ctx, ast.Load)]
            is_seen = len(uses) == len(read) + 1 and not _is_used_within(name, nodes)
            return is_seen and all(_is_lost(use, within, (), parents, scope) for use in read)
    return False


def _is_own(name: str, within: _Within, scope: Scope) -> bool:
    return name in within.hidden or scope.is_bound(name) or scope.module.imports_all


def _is_used_within(name: str, nodes: Sequence[ast.AST]) -> bool:
    """Return whether a function within this one has the name, or it is not only its own."""
    for node in nodes:
        if isinstance(node, ast.Global | ast.Nonlocal) and name in node.names:
            return True
        if isinstance(node, Function | ast.Lambda | ast.ClassDef):
            names = (one.id for one in ast.walk(node) if isinstance(one, ast.Name))
            if name in names:
                return True
    return False


def _told(
    call: ast.Call, within: _Within, parents: Mapping[ast.AST, ast.AST], scope: Scope
) -> Diagnostic:
    node = parents[call]
    while not isinstance(node, ast.stmt | ast.JoinedStr):
        node = parents[node]
    span = node_span(scope.module.source, node if isinstance(node, ast.JoinedStr) else call)
    waits, fix = isinstance(within.function, ast.AsyncFunctionDef), None
    # before Python 3.12 a text with values has no places within; and `await a()[0]` waits for `a()[0]`
    if (
        waits
        and not isinstance(node, ast.JoinedStr)
        and not isinstance(parents[call], ast.Subscript)
    ):
        fix = Fix(span=Span(span.start, span.start), text="await ")
    return errors.forgotten_await(
        scope.module.source,
        span,
        ast.unparse(call.func),
        within.function.name,
        fix,
        waits=waits,
        may_wait=within.hook is None or within.hook.may_wait,
    )
