"""Blocks of an app: kind, values, choices and hooks."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass

from plutoc.block import Choice, EventParam, HookKind, HookParam, Param
from plutoc.diagnostic import Diagnostic
from plutoc.graph import event_errors, value_errors
from plutoc.graph.model import Choose, Hook, Node, Parameter, Plain
from plutoc.graph.names import near
from plutoc.graph.packages import Packages, find
from plutoc.graph.scope import ACTION, EVENT, HOOK_ROLES, Scope
from plutoc.graph.uncertain_names import UncertainNames
from plutoc.graph.values import EXAMPLES, at_least, once_each, typed, written
from plutoc.source import Source
from plutoc.syntax.tree import Argument, BlockDecl, Bool, Name, Text, Value

_ROLES = {HookKind.ACTION: ACTION} | {HookKind(kind): role for kind, role in HOOK_ROLES.items()}


@dataclass(frozen=True, slots=True, kw_only=True)
class Place:
    """What a block's declaration can refer to, and where findings go."""

    source: Source
    scope: Scope
    hooks: Mapping[str, Hook]
    """Actions, too."""
    events: Collection[str]
    """Those of the app before the built-in ones."""
    partial: frozenset[str]
    """Hooks with a mistake in their declaration: what parameters they take is not certain."""
    packages: Packages
    unclear: UncertainNames
    found: list[Diagnostic]


def node(place: Place, declared: BlockDecl) -> Node | None:
    """Resolve a block, or give None where its kind does not exist."""
    kind = find(place.source, declared, place.packages, place.unclear, place.found)
    if kind is None:
        return None
    package, block = kind
    given = {a.name.text: a for a in once_each(place.source, declared.arguments, place.found)}
    hook_param = next((p for p in block.params if isinstance(p, HookParam)), None)
    own = [param.name for param in block.params]
    strange = {name: argument.name for name, argument in given.items() if name not in own}
    hook = None
    if hook_param:
        slip = _slip(hook_param.name, strange) if hook_param.name not in given else None
        if slip and hook_param.required:
            unknown = value_errors.unknown_argument(
                place.source, slip, f"`{block.name}`", own, given
            )
            place.found.append(unknown)
            del strange[slip.text]
        else:
            hook = _hook(place, declared, hook_param, given)
    passes = hook_param is not None and hook_param.passes
    passed = hook.parameters if passes and hook and hook.name not in place.partial else ()
    uncertain = passes and (hook is None or hook.name in place.partial)
    for param in passed:
        strange.pop(param.name, None)
    if not uncertain:
        known = [*own, *(param.name for param in passed)]
        place.found.extend(
            value_errors.unknown_argument(place.source, name, f"`{block.name}`", known, given)
            for name in strange.values()
        )
    return Node(
        name=declared.name.text,
        block=block,
        package=package,
        values=tuple(
            (param.name, _value(place, declared, param, given.get(param.name), strange))
            for param in block.params
            if isinstance(param, Param)
        ),
        choices=tuple(
            (param.name, _choose(place, param, given.get(param.name)))
            for param in block.params
            if isinstance(param, Choice)
        ),
        hook=hook,
        passed=_passed(place, declared, passed, given, strange),
        event=next(
            (
                _event(place, declared, param, given.get(param.name), strange)
                for param in block.params
                if isinstance(param, EventParam)
            ),
            None,
        ),
        declaration=_declaration(declared),
        span=declared.span,
        name_span=declared.name.span,
    )


def _value(
    place: Place,
    declared: BlockDecl,
    param: Param,
    argument: Argument | None,
    strange: Mapping[str, Name],
) -> Plain | None:
    if argument is None:
        if param.required and not _slip(param.name, strange):
            _missing(place, declared, param.name, EXAMPLES[param.type])
        return param.default
    value = typed(place.source, param.name, argument.value, param.type, place.found, ours=True)
    if param.least is not None and isinstance(value, int | float) and value < param.least:
        rule = at_least(param.least, param.type)
        span = argument.value.span
        place.found.append(value_errors.out_of_range(place.source, span, param.name, rule))
    return value


def _choose(place: Place, param: Choice, argument: Argument | None) -> Choose:
    """Resolve one of the runtime's functions, or a hook of the app in its place."""
    default = Choose(name=param.default, hook=None, is_given=False)
    if argument is None:
        return default
    name = _name(place, argument.value)
    options = list(param.options)
    if name is None:
        example = f"{param.name}: {param.default}"
        span = argument.value.span
        place.found.append(
            value_errors.wrong_type(
                place.source, span, param.name, "a name", example, _unquoted(argument, options)
            )
        )
        return default
    if name.text in param.options:
        return Choose(name=name.text, hook=None)
    if param.hook and name.text in place.hooks:
        return Choose(name=name.text, hook=_of_kind(place, name, param.hook))
    if param.hook and place.unclear.may_declare(name.text):
        return default
    hook = param.hook.value if param.hook else None
    hooks = [each.name for each in place.hooks.values() if each.kind is param.hook]
    place.found.append(
        value_errors.unknown_option(
            place.source, name.span, param.name, name.text, options, [*options, *hooks], hook
        )
    )
    return default


def _event(
    place: Place,
    declared: BlockDecl,
    param: EventParam,
    argument: Argument | None,
    strange: Mapping[str, Name],
) -> str | None:
    """Resolve the event that a block waits for."""
    known = list(place.events)
    if argument is None:
        if param.required and not _slip(param.name, strange):
            _missing(place, declared, param.name, known[0])
        return None
    name = _name(place, argument.value)
    if name is None:
        example = f"{param.name}: {known[0]}"
        mended = _unquoted(argument, known)
        span = argument.value.span
        place.found.append(
            value_errors.wrong_type(
                place.source, span, param.name, "the name of an event", example, mended
            )
        )
        return None
    if name.text in place.events:
        return name.text
    if not place.unclear.may_declare(name.text):
        one = place.scope.get(name.text)
        role = one.role if one and one.role != EVENT else None
        place.found.append(event_errors.unknown_event(place.source, name, role, known))
    return None


def _hook(
    place: Place, declared: BlockDecl, param: HookParam, given: Mapping[str, Argument]
) -> Hook | None:
    argument = given.get(param.name)
    hooks = [hook.name for hook in place.hooks.values() if hook.kind is param.kind]
    example = hooks[0] if hooks else f"my_{param.kind.value}"
    if argument is None:
        if param.required:
            _missing(place, declared, param.name, example)
        return None
    name = _name(place, argument.value)
    if name is None:
        role = f"the name of {_ROLES[param.kind]}"
        example, mended = f"{param.name}: {example}", _unquoted(argument, hooks)
        span = argument.value.span
        place.found.append(
            value_errors.wrong_type(place.source, span, param.name, role, example, mended)
        )
        return None
    return _of_kind(place, name, param.kind)


def _unquoted(argument: Argument, names: Sequence[str]) -> str | None:
    """Return the name that stands in quotes, if it is one of these."""
    value = argument.value
    return value.value if isinstance(value, Text) and value.value in names else None


def _of_kind(place: Place, name: Name, kind: HookKind) -> Hook | None:
    """Return the hook of that name, if it is one of that kind."""
    hook, declared = place.hooks.get(name.text), place.scope.get(name.text)
    if hook and hook.kind is kind:
        return hook
    if place.unclear.may_declare(name.text):
        return None
    if declared:
        place.found.append(
            value_errors.wrong_hook(
                place.source, name.span, name.text, _ROLES[kind], declared.role, declared.name.span
            )
        )
    else:
        known = [hook.name for hook in place.hooks.values() if hook.kind is kind]
        place.found.append(
            value_errors.unknown_hook(place.source, name.span, name.text, kind.value, known)
        )
    return None


def _passed(
    place: Place,
    declared: BlockDecl,
    parameters: Sequence[Parameter],
    given: Mapping[str, Argument],
    strange: Mapping[str, Name],
) -> tuple[tuple[str, Plain], ...]:
    """Resolve the hook's own parameters, written beside it."""
    passed = []
    for parameter in parameters:
        argument = given.get(parameter.name)
        value = parameter.default
        if argument:
            value = typed(place.source, parameter.name, argument.value, parameter.type, place.found)
        elif value is None and not _slip(parameter.name, strange):
            _missing(place, declared, parameter.name, EXAMPLES[parameter.type])
        if value is not None:
            passed.append((parameter.name, value))
    return tuple(passed)


def _slip(name: str, strange: Mapping[str, Name]) -> Name | None:
    """Return an argument that means this parameter and is misspelt: told as that."""
    meant = near(name, strange)
    return strange[meant[0]] if meant else None


def _missing(place: Place, declared: BlockDecl, name: str, example: str) -> None:
    owner, span = f"`{declared.kind.text}`", declared.name.span
    place.found.append(value_errors.missing_argument(place.source, span, owner, name, example))


def _name(place: Place, value: Value) -> Name | None:
    """Return a value as a name: a hook may be called `yes`."""
    match value:
        case Name():
            return value
        case Bool():
            return Name(text=place.source.quote(value.span), span=value.span)
        case _:
            return None


def _declaration(declared: BlockDecl) -> str:
    prefix = f"{declared.prefix.text}." if declared.prefix else ""
    arguments = ", ".join(f"{a.name.text}: {written(a.value)}" for a in declared.arguments)
    kind = f"{declared.name.text} = {prefix}{declared.kind.text}"
    return f"{kind}({arguments})" if arguments else kind
