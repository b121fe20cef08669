"""What hooks can ask of missions, trips, drones and the rest: read from the brain's own classes."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cache
from inspect import cleandoc
from pkgutil import get_data

from plutoc.emit import reactions
from plutoc.emit.model_file import all_fields, python_type, values_of
from plutoc.emit.modules import EmbedError
from plutoc.emit.python import PYTHON, UNITS
from plutoc.emit.reactions import ANY
from plutoc.emit.stubs import EXPORTS
from plutoc.graph.model import Graph, Parameter
from plutoc_runtime.domain.fields import Entity

_MODEL = "._runtime.domain.model"
_ASIDE = {"LiveDrone": ("release", "is_of"), "Drone": ("telemetry", "index"), "Category": ()}
"""What is there for the brain itself."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Member:
    """An attribute or a method of a type, or one of an enumeration's values."""

    name: str
    type: str
    """As it is annotated; of a method, what it returns."""
    doc: str
    signature: str = ""
    """Of a method: what stands in its parentheses, and what comes out."""
    settable: bool = False
    """It can be given where such an object is made."""


@dataclass(frozen=True, slots=True, kw_only=True)
class HookType:
    """A type that hooks are written with."""

    name: str
    doc: str
    members: tuple[Member, ...] = field(default=())
    is_enum: bool = False


def types_of(graph: Graph) -> Mapping[str, HookType]:
    """Return the types that an app's package exports, with the fields that its graph brings in."""
    found = dict(_types())
    try:
        own = all_fields(graph)
    except EmbedError:  # two blocks disagree, which is told elsewhere
        own = ()
    for name, entity in (("Mission", Entity.MISSION), ("Trip", Entity.TRIP)):
        added = tuple(
            Member(name=one.name, type=python_type(one), doc=one.doc, settable=True)
            for one in own
            if one.on is entity
        )
        plain = found[name]
        found[name] = HookType(name=name, doc=plain.doc, members=plain.members + added)
    if values := values_of(graph):
        plain = found["Result"]
        members = (
            replace(one, type=" | ".join(values)) if one.name == "value" else one
            for one in plain.members
        )
        found["Result"] = HookType(name="Result", doc=plain.doc, members=tuple(members))
    return found | _events(graph)


def _events(graph: Graph) -> dict[str, HookType]:
    """Return the class of all events, and those of the app's own with their fields."""
    if not graph.reacts:
        return {}
    body = _module(reactions.HOME).body
    base = _type(next(one for one in body if isinstance(one, ast.ClassDef) and one.name == ANY))
    found = {ANY: base}
    for event in graph.events:
        name = reactions.class_names(graph)[event.name]
        fields = (
            Member(name=one.name, type=PYTHON[one.type], doc=_unit(one), settable=True)
            for one in event.fields
        )
        doc = f"The event {event.name}."
        found[name] = HookType(name=name, doc=doc, members=(*base.members, *fields))
    return found


def _unit(field: Parameter) -> str:
    return f"Of the app's own{f', {UNITS[field.type]}' if field.type in UNITS else ''}."


@cache
def _types() -> Mapping[str, HookType]:
    wanted = {name: home if "._runtime" in home else _MODEL for name, home in EXPORTS.items()}
    wanted["Waiting"] = EXPORTS["Assignment"]
    found: dict[str, HookType] = {}
    for home in dict.fromkeys(wanted.values()):
        names = {name for name, place in wanted.items() if place == home}
        for node in _module(home).body:
            if isinstance(node, ast.ClassDef) and node.name in (
                *names,
                "TripStatus",
                "DroneStatus",
            ):
                found[node.name] = _type(node)
    found["Point"] = HookType(
        name="Point", doc="A place: x, y and z in metres, in the map's frame."
    )
    found["Assignment"] = HookType(
        name="Assignment",
        doc="Which waiting trips get which drones: a mapping, or pairs; none: all wait. Or `Again`.",
    )
    return found


def _module(home: str) -> ast.Module:
    path = home.removeprefix("._runtime.").replace(".", "/")
    return ast.parse(get_data("plutoc_runtime", f"{path}.py") or b"")


def _type(node: ast.ClassDef) -> HookType:
    is_enum = any(ast.unparse(base) == "Enum" for base in node.bases)
    members = [one for one in _members(node) if one.name not in _ASIDE.get(node.name, ())]
    return HookType(
        name=node.name, doc=ast.get_docstring(node) or "", members=tuple(members), is_enum=is_enum
    )


def _members(node: ast.ClassDef) -> Iterator[Member]:
    for one, behind in zip(node.body, (*node.body[1:], None), strict=True):
        match one:
            case ast.AnnAssign(target=ast.Name(id=name), annotation=kind, value=value):
                written = ast.unparse(value) if value else ""
                if "repr=False" not in written:
                    settable = "init=False" not in written
                    doc = _text_of(behind)
                    yield Member(name=name, type=ast.unparse(kind), doc=doc, settable=settable)
            case ast.Assign(targets=[ast.Name(id=name)]) if not name.startswith("_"):
                yield Member(name=name, type=node.name, doc=_text_of(behind))
            case ast.FunctionDef() | ast.AsyncFunctionDef() if not one.name.startswith("_"):
                yield _method(one)


def _method(one: ast.FunctionDef | ast.AsyncFunctionDef) -> Member:
    returns = ast.unparse(one.returns) if one.returns else "None"
    is_property = any(ast.unparse(each) == "property" for each in one.decorator_list)
    given = ast.unparse(one.args).removeprefix("self").removeprefix(", ")
    word = "async " if isinstance(one, ast.AsyncFunctionDef) else ""
    return Member(
        name=one.name,
        type=returns,
        doc=ast.get_docstring(one) or "",
        signature="" if is_property else f"{word}def {one.name}({given}) -> {returns}",
    )


def _text_of(node: ast.stmt | None) -> str:
    """Return what an attribute's own docstring says."""
    match node:
        case ast.Expr(value=ast.Constant(value=str() as text)):
            return cleandoc(text)
    return ""
