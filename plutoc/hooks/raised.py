"""The events that hooks raise: `context.emit("intruder", kind="dog")`."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping

from plutoc.check.model import Checked
from plutoc.diagnostic import Diagnostic
from plutoc.graph.built_in import EVENTS
from plutoc.graph.model import Event, Parameter
from plutoc.graph.names import near
from plutoc.hooks import errors
from plutoc.hooks.module import node_span
from plutoc.hooks.python import parsed
from plutoc.source import Source
from plutoc_runtime.domain.quantities import Type

_OF_ALL = frozenset({"id", "at", "track"})
"""What can be said of each event."""
_SET = frozenset({"time", "mission", "trip", "drone"})
"""What else each event has: the app sets it."""


def raised(checked: Checked, hooks: Source) -> Iterator[Diagnostic]:
    """Find what is wrong where a hook raises an event."""
    events = {event.name: event for event in checked.graph.events}
    for call, name in _calls(hooks):
        if name.value in events:
            yield from _of_fields(hooks, call, events[name.value])
        elif name.value not in EVENTS:
            known = [*events, *EVENTS]
            meant = next(iter(near(str(name.value), known)), None)
            span = node_span(hooks, name)
            yield errors.unknown_event(hooks, span, str(name.value), meant)


def unraised(checked: Checked, hooks: Source) -> Iterator[Diagnostic]:
    """Warn of events of the app's own that hooks.py neither raises nor names."""
    for event in checked.graph.events:
        if event.span and not re.search(rf"""["'`]{event.name}["'`]""", hooks.text):
            yield errors.unraised(checked.graph.source, event.span, event.name, hooks.path)


def _calls(hooks: Source) -> Iterator[tuple[ast.Call, ast.Constant]]:
    for node in ast.walk(parsed(hooks)):
        match node:
            case ast.Call(
                func=ast.Attribute(attr="emit", value=ast.Name(id="context")),
                args=[ast.Constant(value=str()) as name, *_],
            ):
                yield node, name


def _of_fields(hooks: Source, call: ast.Call, event: Event) -> Iterator[Diagnostic]:
    fields = {field.name: field for field in event.fields}
    if any(keyword.arg is None for keyword in call.keywords):
        return  # `**` may say anything
    given = {keyword.arg: keyword.value for keyword in call.keywords if keyword.arg}
    for name, value in given.items():
        span = node_span(hooks, value)
        if name in fields:
            wanted = _wanted(fields[name], value)
            if wanted:
                yield errors.wrong_event_field(hooks, span, event.name, name, wanted)
        elif name in _SET:
            yield errors.set_event_field(hooks, span, event.name, name)
        elif name not in _OF_ALL:
            meant = next(iter(near(name, fields)), None)
            yield errors.unknown_event_field(hooks, span, event.name, name, meant)
    missing = [name for name, one in fields.items() if one.default is None and name not in given]
    if missing:
        yield errors.missing_event_field(hooks, node_span(hooks, call), event.name, missing)


_PLAIN: Mapping[Type, tuple[type, ...]] = {
    Type.BOOL: (bool,),
    Type.TEXT: (str,),
    Type.INT: (int,),
}


def _wanted(field: Parameter, value: ast.expr) -> str | None:
    """Return what a field must be, where a constant is surely something else."""
    if not isinstance(value, ast.Constant):
        return None
    fits = _PLAIN.get(field.type, (int, float))
    right = isinstance(value.value, fits) and (bool in fits or not isinstance(value.value, bool))
    return None if right else errors.WANTED.get(field.type, "a number")
