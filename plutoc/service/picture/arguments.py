"""The values that blocks and categories take, as a form shows them."""

from __future__ import annotations

from collections.abc import Iterable

from plutoc.block import AnyParam, Choice, EventParam, HookParam, Param
from plutoc.graph.built_in import EVENTS
from plutoc.graph.model import Action, Hook, Node, Parameter, Plain
from plutoc.service.document import Document
from plutoc.syntax.texts import quoted
from plutoc.syntax.tree import BlockDecl
from plutoc_runtime.domain.quantities import UNITS, Type, units_of

Data = dict[str, object]


def arguments_of(declared: BlockDecl, node: Node | None, document: Document) -> list[Data]:
    """Return what a block takes, with what is written; of an unknown kind, what is written alone."""
    quote = document.source.quote
    written = {one.name.text: quote(one.value.span) for one in declared.arguments}
    if node is None:
        return [_unknown(name, text) for name, text in written.items()]
    graph = document.graph
    hooks: tuple[Hook | Action, ...] = (*graph.hooks, *graph.actions)
    events = [event.name for event in graph.events]
    found = [argument(one, written.pop(one.name, None), hooks, events) for one in node.block.params]
    passes = any(isinstance(one, HookParam) and one.passes for one in node.block.params)
    if node.hook is not None and passes:
        for own in node.hook.parameters:
            if own.name in {one["name"] for one in found}:
                continue
            text = written.pop(own.name, None)
            found.append({**parameter_of(own), "written": text, "of_hook": True})
    return [*found, *(_unknown(name, text) for name, text in written.items())]


def argument(
    param: AnyParam,
    written: str | None = None,
    hooks: Iterable[Hook | Action] = (),
    events: Iterable[str] = (),
) -> Data:
    """Return one value that a block or a category takes."""
    data: Data = {"name": param.name, "written": written, "doc": param.doc, "of_hook": False}
    match param:
        case Param():
            default = None if param.default is None else as_written(param.default, param.type)
            return data | _typed(param.type, default) | {"required": param.required}
        case Choice():
            own = [one.name for one in hooks if _kind(one) == (param.hook and param.hook.value)]
            return data | {
                "type": "choice",
                "default": param.default,
                "required": False,
                "units": [],
                "choices": [*param.options, *own],
                "hook": param.hook.value if param.hook else None,
            }
        case HookParam():
            return data | {
                "type": param.kind.value,
                "default": None,
                "required": param.required,
                "units": [],
                "choices": [one.name for one in hooks if _kind(one) == param.kind.value],
                "hook": param.kind.value,
            }
        case EventParam():
            return data | {
                "type": "event",
                "default": None,
                "required": param.required,
                "units": [],
                "choices": [*events, *EVENTS],
                "hook": None,
            }


def parameter_of(one: Parameter) -> Data:
    """Return a parameter that a hook declares."""
    default = None if one.default is None else as_written(one.default, one.type)
    shape = {"name": one.name, "written": None, "doc": "", "of_hook": True}
    return shape | _typed(one.type, default) | {"required": one.default is None}


def _typed(kind: Type, default: str | None) -> Data:
    return {
        "type": kind.value,
        "default": default,
        "units": list(units_of(kind)),
        "choices": ["yes", "no"] if kind is Type.BOOL else None,
        "hook": None,
    }


def _unknown(name: str, written: str) -> Data:
    return {
        "name": name,
        "written": written,
        "doc": "",
        "of_hook": False,
        "type": "",
        "default": None,
        "required": False,
        "units": [],
        "choices": None,
        "hook": None,
    }


def _kind(hook: Hook | Action) -> str:
    return hook.kind.value if isinstance(hook, Hook) else "action"


def as_written(value: Plain, kind: Type) -> str:
    """Return a value in SI units as an app writes it, in the unit that makes it shortest."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return quoted(value)
    units = units_of(kind)
    if not units:
        return f"{value:g}"
    numbers = [(f"{(value - UNITS[unit][2]) / UNITS[unit][1]:.10g}", unit) for unit in units]
    plain = [one for one in numbers if "e" not in one[0]] or numbers
    number, unit = min(plain, key=lambda one: (len(one[0].strip("-")), units.index(one[1])))
    return f"{number} {unit}"
