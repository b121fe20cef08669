"""Checking the developer's functions against what the app declares."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from plutoc.check.model import Checked
from plutoc.diagnostic import Diagnostic, Rejected
from plutoc.graph.names import near
from plutoc.hooks import errors
from plutoc.hooks.annotations import Scope
from plutoc.hooks.awaits import forgotten
from plutoc.hooks.expected import FOR_ALL, Expected, as_defined, expected, probes
from plutoc.hooks.module import Function, Module, arg_span, name_span, read, waits, yields
from plutoc.hooks.python import Unreadable, check_compiles
from plutoc.hooks.raised import raised, unraised
from plutoc.hooks.returns import of_returns
from plutoc.hooks.types import of_types
from plutoc.source import Source


def check_hooks(checked: Checked, hooks: Source) -> tuple[Diagnostic, ...]:
    """Return the warnings; raise `Rejected` with all errors."""
    found = list(_found(checked, hooks)) or list(_left(hooks))
    if found:
        raise Rejected(found)
    return tuple(unraised(checked, hooks))


def missing(checked: Checked, hooks: Source) -> tuple[str, ...]:
    """Return the hooks that a hooks.py does not define; none where it cannot be read."""
    try:
        module = read(hooks)
    except Unreadable:
        return ()
    return tuple(hook.name for hook in expected(checked) if _is_missing(hook, module))


def policies_for_all(checked: Checked, hooks: Source) -> frozenset[str]:
    """Return the policies that choose for all that wait."""
    defined = read(hooks).defined
    functions = ((hook, defined.get(hook.name)) for hook in expected(checked))
    return frozenset(
        hook.name
        for hook, function in functions
        if isinstance(function, Function) and as_defined(hook, function).passed == FOR_ALL
    )


def _found(checked: Checked, hooks: Source) -> Iterator[Diagnostic]:
    try:
        module = read(hooks)
    except Unreadable as error:
        yield _unreadable(hooks, error)
        return
    app, declared = checked.graph.source, expected(checked)
    free = [
        name
        for name, definition in module.defined.items()
        if isinstance(definition, Function) and name not in {hook.name for hook in declared}
    ]
    for hook in declared:
        if _is_missing(hook, module):
            meant = next(iter(near(hook.name, free)), None)
            yield errors.missing(app, hook, hooks.path, meant)
        else:
            yield from _of_definition(checked, hooks, hook, module)
    for probe in probes(checked):
        if probe.name in module.defined:
            yield from _of_definition(checked, hooks, probe, module)
    yield from raised(checked, hooks)
    yield from forgotten(Scope(module=module, app=checked.graph.name), declared)


def _left(hooks: Source) -> Iterator[Diagnostic]:
    """Find what would keep Python from loading a file that it can read."""
    try:
        check_compiles(hooks)
    except Unreadable as error:
        yield _unreadable(hooks, error)


def _unreadable(hooks: Source, error: Unreadable) -> Diagnostic:
    if error.span is None:
        return errors.unreadable(hooks, error.why)
    return errors.not_python(hooks, error.span, error.why)


def _is_missing(hook: Expected, module: Module) -> bool:
    return hook.name not in module.defined and not module.imports_all


def _of_definition(
    checked: Checked, hooks: Source, hook: Expected, module: Module
) -> Iterator[Diagnostic]:
    """What is imported, assigned or decorated can be anything: it is believed."""
    definition = module.defined.get(hook.name)
    if definition is None:
        return
    if not isinstance(definition, ast.ClassDef):
        hook = as_defined(hook, definition)
    at = errors.At(
        app=checked.graph.source, hooks=hooks, hook=hook, span=name_span(hooks, definition)
    )
    if isinstance(definition, ast.ClassDef):
        yield errors.not_a_function(at)
    elif not definition.decorator_list:
        if isinstance(definition, ast.AsyncFunctionDef) and not hook.may_wait:
            yield errors.may_not_wait(at)
        elif yields(definition):
            yield errors.generator(at)
        elif isinstance(definition, ast.FunctionDef) and waits(definition):
            wrong = errors.must_wait if hook.may_wait else errors.policy_waits
            yield wrong(at)
        mistakes = list(_of_parameters(at, definition))
        yield from mistakes or of_types(checked.graph, at, definition, module)
        yield from of_returns(at, definition, Scope(module=module, app=checked.graph.name))


def _of_parameters(at: errors.At, function: Function) -> Iterator[Diagnostic]:
    """Find what would go wrong when the app calls it."""
    hook = at.hook
    arguments = function.args
    by_place = [*arguments.posonlyargs, *arguments.args]
    count = len(hook.passed)
    if len(by_place) < count and arguments.vararg is None:
        yield errors.wrong_count(at, [arg.arg for arg in by_place])
        return
    for arg, gets in zip(by_place, hook.passed, strict=False):
        # Its name is free, as long as it is not the name of something else that comes.
        if arg.arg != gets and arg.arg in (*hook.passed, *hook.own_names):
            yield errors.wrong_order(at.on(arg_span(at.hooks, arg)), arg.arg, gets)
            return
    rest = by_place[count:]
    by_name = {arg.arg for arg in (*rest, *arguments.kwonlyargs)}
    only_by_place = {arg.arg for arg in arguments.posonlyargs[count:]}
    strange = [
        arg
        for arg in _without_default(arguments)
        if arg not in by_place[:count] and arg.arg not in hook.own_names
    ]
    taken = {*by_name, *only_by_place}
    missing = [each for each in hook.own_names if each not in taken and not arguments.kwarg]
    renamed = _renamed(missing, strange)
    for name in hook.own_names:
        if name in only_by_place:
            yield errors.by_position_only(at, name)
        elif name in renamed:
            arg = renamed[name]
            yield errors.renamed_parameter(at.on(arg_span(at.hooks, arg)), arg.arg, name)
        elif name in missing:
            yield errors.missing_parameter(at, name)
    for arg in strange:
        if arg not in renamed.values():
            yield errors.unfilled_parameter(at.on(arg_span(at.hooks, arg)), arg.arg)


def _renamed(missing: Sequence[str], strange: Sequence[ast.arg]) -> dict[str, ast.arg]:
    """Find which parameters were meant to be those that are missing: that is one mistake."""
    if len(missing) == len(strange) == 1:
        return {missing[0]: strange[0]}
    by_name = {arg.arg: arg for arg in strange}
    found: dict[str, ast.arg] = {}
    for name in missing:
        left = [each for each in by_name if by_name[each] not in found.values()]
        for meant in near(name, left)[:1]:
            found[name] = by_name[meant]
    return found


def _without_default(arguments: ast.arguments) -> list[ast.arg]:
    by_place = [*arguments.posonlyargs, *arguments.args]
    needed = by_place[: len(by_place) - len(arguments.defaults)]
    return needed + [
        arg
        for arg, default in zip(arguments.kwonlyargs, arguments.kw_defaults, strict=True)
        if default is None
    ]
