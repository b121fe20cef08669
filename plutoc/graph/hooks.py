"""Actions and hooks: the code that a developer adds, as declared."""

from __future__ import annotations

import keyword
from collections.abc import Collection, Sequence

from plutoc.block import IN_GRAPH, HookKind
from plutoc.diagnostic import Diagnostic
from plutoc.graph import built_in, errors, event_errors, names, value_errors
from plutoc.graph.model import Action, Event, Hook, Parameter
from plutoc.graph.names import Style
from plutoc.graph.scope import ACTION, ALONG, EVENT, HOOK_ROLES
from plutoc.graph.values import typed, written
from plutoc.source import Source
from plutoc.syntax import tree
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.domain.status import Status

REPEATS = ("safe", "once", "ask")
LAST_WORDS = (*REPEATS, ALONG)
"""What an action can end with."""
PHOTO = "photo"
RETURNS = (*(kind.value for kind in Type), PHOTO)
"""What an action can give: what its parameters can be, or a photo."""

_ALREADY_THERE = {
    ACTION: frozenset({"drone", "trip", "context"}),
    EVENT: frozenset({"name", "id", "time", "at", "track", "mission", "trip", "drone"}),
    HOOK_ROLES["evaluator"]: frozenset({"mission", "results", "run", "status", "hook", "block"}),
    HOOK_ROLES["modifier"]: frozenset({"mission", "context", "run", "status", "hook", "block"}),
}
"""What a hook, or the step that calls it, gets besides its parameters; what an event has anyway."""


def action(source: Source, declared: tree.ActionDecl, found: list[Diagnostic]) -> Action:
    """Resolve an action of the app's own."""
    repeat, returns = declared.repeat, declared.returns
    if returns is not None and returns.text not in RETURNS:
        swapped = repeat is not None and returns.text in LAST_WORDS and repeat.text in RETURNS
        meant = f"`-> {repeat.text} {returns.text}`" if repeat and swapped else None
        found.append(errors.unknown_type(source, returns, RETURNS, meant))
    elif repeat is not None and repeat.text not in LAST_WORDS:  # of two wrong words one is told
        found.append(errors.unknown_repeat(source, repeat, LAST_WORDS, RETURNS))
    along = repeat is not None and repeat.text == ALONG
    if along and declared.takes is not None:
        found.append(event_errors.takes_along(source, declared.takes.span, declared.name.text))
    given = parameters(source, declared.parameters, ACTION, found)
    return Action(
        name=declared.name.text,
        parameters=given,
        returns=returns.text if returns and returns.text in RETURNS else None,
        repeat="safe" if along else repeat.text if repeat else "once",
        along=along,
        takes=None if along else _takes(source, declared, given, found),
        declaration=_declaration(declared),
        span=declared.name.span,
    )


def along_built_in(source: Source, declared: tree.ActionDecl, found: list[Diagnostic]) -> str:
    """Return the built-in action that is declared to be done on the way, too."""
    name = declared.name
    if name.text not in built_in.ALONG:
        found.append(event_errors.never_along(source, name, built_in.ALONG))
    elif declared.parameters or declared.returns or declared.takes:
        found.append(event_errors.only_along(source, declared.span, name.text))
    return name.text


def event(source: Source, declared: tree.EventDecl, found: list[Diagnostic]) -> Event:
    """Resolve an event of the app's own."""
    fields = ", ".join(map(declaration, declared.fields))
    return Event(
        name=declared.name.text,
        fields=parameters(source, declared.fields, EVENT, found, "a field of an event"),
        declaration=f"event {declared.name.text}{f'({fields})' if fields else ''}",
        span=declared.name.span,
    )


def _takes(
    source: Source,
    declared: tree.ActionDecl,
    given: Sequence[Parameter],
    found: list[Diagnostic],
) -> float | str | None:
    """Return the seconds that an action takes, or the name of the parameter that says so."""
    takes = declared.takes
    if takes is None:
        return None
    if isinstance(takes, tree.Name):
        timed = [one.name for one in given if one.type is Type.TIME]
        if takes.text in timed:
            return takes.text
        if not any(
            takes.text == one.name.text and _TYPES.get(one.type.text) is None
            for one in declared.parameters
        ):
            found.append(errors.unknown_duration(source, takes, [one.name for one in given], timed))
        return None
    seconds = typed(source, "takes", takes, Type.TIME, found, ours=True)
    if seconds is not None and not float(seconds) > 0.0:
        found.append(value_errors.out_of_range(source, takes.span, "takes", "more than 0 s"))
    return None if seconds is None else float(seconds)


def _declaration(declared: tree.ActionDecl) -> str:
    given = ", ".join(map(declaration, declared.parameters))
    given = f"({given})" if given else ""
    returns = f" -> {declared.returns.text}" if declared.returns else ""
    repeat = f" {declared.repeat.text}" if declared.repeat else ""
    takes = f" takes {written(declared.takes)}" if declared.takes else ""
    return f"action {declared.name.text}{given}{returns}{repeat}{takes}"


def declaration(one: tree.Parameter) -> str:
    """Return a parameter as it is declared: canonical, texts left out."""
    default = f" = {written(one.default)}" if one.default else ""
    return f"{one.name.text}: {one.type.text}{default}"


def hook(source: Source, declared: tree.HookDecl, found: list[Diagnostic]) -> Hook:
    """Resolve an evaluator, a modifier, a policy or a creator."""
    emitted = {status for _, status in statuses(source, declared.emits, found)}
    for name in declared.writes:
        if not names.is_well_formed(name.text):
            found.append(errors.malformed_name(source, name))
        elif not names.has_style(name.text, Style.SNAKE):
            found.append(errors.wrong_style(source, name, "an attribute", Style.SNAKE))
    return Hook(
        kind=HookKind(declared.kind),
        name=declared.name.text,
        parameters=parameters(source, declared.parameters, HOOK_ROLES[declared.kind], found),
        emits=tuple(status for status in IN_GRAPH if status in emitted),
        writes=tuple(dict.fromkeys(name.text for name in declared.writes)),
        span=declared.name.span,
    )


def statuses(
    source: Source,
    written: Sequence[tree.Name],
    found: list[Diagnostic],
    accepted: Collection[Status] = IN_GRAPH,
) -> list[tuple[tree.Name, Status]]:
    """Return the statuses that are named, each once and with its name.

    `accepted` are those that may stand here: of others, nothing is proposed.
    """
    named = {name.text for name in written}
    legal = [each.value for each in IN_GRAPH if each in accepted and each.value not in named]
    resolved: dict[Status, tree.Name] = {}
    for name in written:
        status = Status.__members__.get(name.text)
        if status is None:
            found.append(errors.unknown_status(source, name, legal))
        elif status not in IN_GRAPH:
            found.append(errors.status_outside_graph(source, name))
        elif status in resolved:
            found.append(errors.named_twice(source, name, resolved[status]))
        else:
            resolved[status] = name
    return [(name, status) for status, name in resolved.items()]


def parameters(
    source: Source,
    declared: Sequence[tree.Parameter],
    role: str,
    found: list[Diagnostic],
    what: str = "a parameter",
) -> tuple[Parameter, ...]:
    """Resolve parameters, or fields. One of an unknown type is left out: the error is told."""
    first: dict[str, tree.Parameter] = {}
    resolved = []
    for parameter in declared:
        name = parameter.name
        before = first.setdefault(name.text.lower(), parameter)
        if before is parameter:
            _check_name(source, name, role, found, what)
        else:
            same = before.name.text == name.text
            found.append(
                errors.declared_twice(source, name, what, before.name, what)
                if same
                else errors.differs_in_case_only(source, name, before.name)
            )
        kind = _TYPES.get(parameter.type.text)
        if kind is None:
            found.append(errors.unknown_type(source, parameter.type))
            continue
        default = (
            typed(source, name.text, parameter.default, kind, found) if parameter.default else None
        )
        resolved.append(Parameter(name=name.text, type=kind, default=default))
    return tuple(resolved)


_TYPES = {kind.value: kind for kind in Type}


def _check_name(
    source: Source, name: tree.Name, role: str, found: list[Diagnostic], what: str
) -> None:
    """Check a parameter's name: it becomes a keyword of a Python call, so Python's are not free."""
    if not names.is_well_formed(name.text):
        found.append(errors.malformed_name(source, name))
    elif keyword.iskeyword(name.text):
        found.append(errors.reserved_name(source, name, names.reserved(name.text) or ""))
    elif name.text in _ALREADY_THERE.get(role, ()):
        found.append(errors.clashing_parameter(source, name, role))
    elif not names.has_style(name.text, Style.SNAKE):
        found.append(errors.wrong_style(source, name, what, Style.SNAKE))
