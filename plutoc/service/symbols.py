"""The names of an app: where each is declared, and everywhere it stands."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

from plutoc.graph.built_in import EVENTS
from plutoc.graph.model import END, START
from plutoc.graph.scope import is_built_in_along
from plutoc.source import Span
from plutoc.syntax.tree import (
    ActionDecl,
    BlockDecl,
    Bool,
    CategoryDecl,
    EventDecl,
    FieldsDecl,
    File,
    FlowDecl,
    HookDecl,
    List,
    Name,
    Parameter,
    ResultDecl,
    Value,
)


class Role(Enum):
    """What a name stands for."""

    APP = "app"
    PREFIX = "package"
    CATEGORY = "category"
    ACTION = "action"
    EVALUATOR = "evaluator"
    MODIFIER = "modifier"
    POLICY = "policy"
    CREATOR = "creator"
    EVENT = "event"
    BLOCK = "block"
    KIND = "kind of block"
    FIELD = "field"
    PARAMETER = "parameter"
    TYPE = "type"
    STATUS = "status"
    TERMINAL = "start or end"
    OPTION = "value"
    WAY = "way to show results"


HOOKS = frozenset({Role.ACTION, Role.EVALUATOR, Role.MODIFIER, Role.POLICY, Role.CREATOR})
"""What is a function in hooks.py."""
DECLARED = HOOKS | {Role.PREFIX, Role.CATEGORY, Role.EVENT, Role.BLOCK}
"""What an app declares by name, once for the whole app: these can be renamed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Occurrence:
    """A name where it stands."""

    name: str
    role: Role
    span: Span
    declares: bool = False
    owner: str = ""
    """Of a parameter: the block, category or hook that it belongs to; of a field: `mission` or `trip`."""


def occurrences(file: File) -> tuple[Occurrence, ...]:
    """Return all names of a source that can be read, in their order."""
    roles = _declared(file)
    return tuple(sorted(_all(file, roles), key=lambda one: one.span.start))


def at(found: tuple[Occurrence, ...], offset: int) -> Occurrence | None:
    """Return the name in which, or right behind which, a cursor stands."""
    inside = (one for one in found if one.span.start <= offset <= one.span.end)
    return max(inside, key=lambda one: one.span.start, default=None)


def same(found: tuple[Occurrence, ...], one: Occurrence) -> tuple[Occurrence, ...]:
    """Return every place where what this name stands for is named, its declaration included."""
    return tuple(
        other
        for other in found
        if (other.name, other.role, other.owner) == (one.name, one.role, one.owner)
    )


def _declared(file: File) -> dict[str, Role]:
    """Return what each declared name stands for; the first declaration counts."""
    roles: dict[str, Role] = {}
    for use in file.uses:
        roles.setdefault((use.alias or use.package).text, Role.PREFIX)
    for statement in file.app.statements:
        match statement:
            case CategoryDecl():
                roles.setdefault(statement.name.text, Role.CATEGORY)
            case EventDecl():
                roles.setdefault(statement.name.text, Role.EVENT)
            case ActionDecl():
                roles.setdefault(statement.name.text, Role.ACTION)
            case HookDecl():
                roles.setdefault(statement.name.text, Role(statement.kind))
            case BlockDecl():
                roles.setdefault(statement.name.text, Role.BLOCK)
    return roles


def _all(file: File, roles: dict[str, Role]) -> Iterator[Occurrence]:
    if file.app.name.text:
        yield _named(file.app.name, Role.APP, declares=True)
    for use in file.uses:
        yield _named(use.alias or use.package, Role.PREFIX, declares=True)
    hooks = {s.name.text: s for s in file.app.statements if isinstance(s, HookDecl | ActionDecl)}
    known = {name: role for name, role in roles.items() if role in {*HOOKS, Role.EVENT}}
    of_missions = {f.name.text for s in fields_of(file) if s.on == "mission" for f in s.fields}
    for statement in file.app.statements:
        match statement:
            case FieldsDecl():
                for field in statement.fields:
                    yield _named(field.name, Role.FIELD, declares=True, owner=statement.on)
                    yield _named(field.type, Role.TYPE)
            case ResultDecl():
                yield _named(statement.action, Role.ACTION)
                yield _named(statement.way, Role.WAY)
                for argument in statement.arguments:
                    yield _named(argument.name, Role.PARAMETER, owner=statement.way.text)
            case CategoryDecl():
                yield _named(statement.name, Role.CATEGORY, declares=True)
                for argument in statement.arguments:
                    yield _named(argument.name, Role.PARAMETER, owner=Role.CATEGORY.value)
                yield from (_named(name, Role.ACTION) for name in statement.can)
            case EventDecl():
                yield _named(statement.name, Role.EVENT, declares=True)
                yield from _parameters(statement.fields, statement.name.text)
            case ActionDecl():
                own = not is_built_in_along(statement)
                yield _named(statement.name, Role.ACTION, declares=own)
                yield from _parameters(statement.parameters, statement.name.text)
                if statement.returns:
                    yield _named(statement.returns, Role.TYPE)
                if statement.repeat:
                    yield _named(statement.repeat, Role.OPTION)
                if isinstance(statement.takes, Name):
                    yield _named(statement.takes, Role.PARAMETER, owner=statement.name.text)
            case HookDecl():
                yield _named(statement.name, Role(statement.kind), declares=True)
                yield from _parameters(statement.parameters, statement.name.text)
                yield from (_named(name, Role.STATUS) for name in statement.emits)
                for name in statement.writes:
                    if name.text in of_missions:
                        yield _named(name, Role.FIELD, owner="mission")
                    else:
                        yield _named(name, Role.OPTION)
            case BlockDecl():
                yield from _block(statement, known, hooks, file)
            case FlowDecl():
                yield from _flow(statement, roles)


def fields_of(file: File) -> list[FieldsDecl]:
    """Return the statements that declare fields."""
    return [one for one in file.app.statements if isinstance(one, FieldsDecl)]


def _block(
    block: BlockDecl, known: dict[str, Role], hooks: dict[str, HookDecl | ActionDecl], file: File
) -> Iterator[Occurrence]:
    yield _named(block.name, Role.BLOCK, declares=True)
    if block.prefix:
        yield _named(block.prefix, Role.PREFIX)
    yield _named(block.kind, Role.KIND)
    written = [file.source.quote(argument.value.span) for argument in block.arguments]
    called = [hooks[text] for text in written if text in hooks]
    passed = {each.name.text: hook.name.text for hook in called for each in hook.parameters}
    owner = f"{block.prefix.text}.{block.kind.text}" if block.prefix else block.kind.text
    for argument in block.arguments:
        name = argument.name.text
        yield _named(argument.name, Role.PARAMETER, owner=passed.get(name, owner))
        if name == "event" and isinstance(argument.value, Name):
            yield _named(argument.value, Role.EVENT)
        else:
            yield from _value(argument.value, known, file)


def _flow(flow: FlowDecl, roles: dict[str, Role]) -> Iterator[Occurrence]:
    for stop in flow.stops:
        for name in stop.names:
            declared = roles.get(name.text, Role.EVENT if name.text in EVENTS else Role.BLOCK)
            role = Role.EVENT if declared is Role.EVENT else Role.BLOCK
            yield _named(name, Role.TERMINAL if name.text in (START, END) else role)
    for status in flow.guard.statuses if flow.guard else ():
        yield _named(status, Role.STATUS)


def _parameters(parameters: tuple[Parameter, ...], owner: str) -> Iterator[Occurrence]:
    for parameter in parameters:
        yield _named(parameter.name, Role.PARAMETER, declares=True, owner=owner)
        yield _named(parameter.type, Role.TYPE)


def _value(value: Value, known: dict[str, Role], file: File) -> Iterator[Occurrence]:
    match value:
        case Name():
            yield _named(value, known.get(value.text, Role.OPTION))
        case Bool():  # a hook may be called `yes`
            name = file.source.quote(value.span)
            if name in known:
                yield Occurrence(name=name, role=known[name], span=value.span)
        case List():
            for item in value.items:
                yield from _value(item, known, file)


def _named(name: Name, role: Role, *, declares: bool = False, owner: str = "") -> Occurrence:
    return Occurrence(name=name.text, role=role, span=name.span, declares=declares, owner=owner)
