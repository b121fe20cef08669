"""`model.py`: the missions and trips of the app, with its fields and categories."""

from __future__ import annotations

from dataclasses import dataclass

from plutoc.emit import reactions
from plutoc.emit.modules import EmbedError
from plutoc.emit.python import (
    PYTHON as OWN_PYTHON,
)
from plutoc.emit.python import (
    UNITS,
    Import,
    annotation,
    builtins_alias,
    call,
    docstring,
    import_lines,
    items,
    literal,
    names,
    python_result,
    shadows,
)
from plutoc.emit.render import render
from plutoc.emit.stubs import has_policies
from plutoc.graph import model as graph_model
from plutoc.graph.categories import PARAMS
from plutoc.graph.model import AppField, Graph
from plutoc_runtime.domain.fields import Entity, Field, FieldType
from plutoc_runtime.domain.own_fields import OwnField
from plutoc_runtime.domain.quantities import Type
from plutoc_runtime.events.declared import TRIP_FIELDS, AlongField, TrackField

PYTHON: dict[FieldType, str] = {
    FieldType.TIME: "float | None",
    FieldType.INT: "int",
    FieldType.ROUNDS: "int | bool",
    FieldType.TIME_OF_DAY: "float | None",
    FieldType.EVALUATOR: "str | None",
}
"""The Python type of each type of field."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Attribute:
    """One line of a class, and its docstring."""

    name: str
    type: str
    default: str | None
    """None: it must be given."""
    doc: str


@dataclass(frozen=True, slots=True, kw_only=True)
class CategoryEntry:
    """A category, below the declaration that it comes from."""

    declaration: str
    written: str


def model_file(graph: Graph) -> str:
    """Return the text of `model.py`, not yet formatted."""
    fields = all_fields(graph)
    return render(
        "model.py",
        app=graph.name,
        imports=import_lines(
            [
                *_imports(fields, has_policies(graph)),
                *_imports_of_results(graph),
                *reactions.imports(graph),
            ]
        ),
        policies=has_policies(graph),
        result=_generic("Result", graph),
        results=_generic("Results", graph),
        mission=_attributes(fields, Entity.MISSION),
        trip=_attributes(fields, Entity.TRIP),
        events=reactions.classes(graph),
        fields=[_field(field) for field in fields],
        categories=[
            CategoryEntry(declaration=category.declaration, written=_category(category))
            for category in graph.categories
        ],
    )


def _imports(fields: tuple[Field, ...], policies: bool) -> list[Import]:
    imports = [
        *names("dataclasses", "dataclass"),
        *names("._runtime.domain", "model"),
        *names("._runtime.domain.fields", "Field"),
        *names("._runtime.domain.model", "Category"),
    ]
    if fields:
        imports += names("._runtime.domain.fields", "Entity")
    if any(isinstance(field.type, FieldType) for field in fields):
        imports += names("._runtime.domain.fields", "FieldType")
    if any(isinstance(field, AlongField) for field in fields):
        imports += names("._runtime.events.declared", "Along", "AlongField")
    if any(isinstance(field, TrackField) for field in fields):
        imports += names("._runtime.events.declared", "TrackField")
        imports += names("._runtime.domain.quantities", "Type")
    if any(isinstance(field, OwnField) for field in fields):
        imports += names("._runtime.domain.own_fields", "OwnField")
        imports += names("._runtime.domain.quantities", "Type")
    if policies:
        imports += names("._runtime.fleet", "own_policy")
    taken = {field.name for field in fields}
    if shadows(taken, (python_type(field) for field in fields)):
        alias = builtins_alias(taken)
        imports.append(Import(module="builtins", alias=None if alias == "builtins" else alias))
    return imports


def values_of(graph: Graph) -> tuple[str, ...]:
    """Return the Python types of what actions give; none, where one of the app's own does not say."""
    if not graph.actions or any(action.returns is None for action in graph.actions):
        return ()
    own = (python_result(action.returns) for action in graph.actions if action.returns)
    return tuple(dict.fromkeys(("float", "Photo", *own, "None")))


def _generic(name: str, graph: Graph) -> str:
    values = " | ".join(values_of(graph))
    return f"Typed{name}[Mission, Trip, {values}]" if values else f"model.{name}[Mission, Trip]"


def _imports_of_results(graph: Graph) -> tuple[Import, ...]:
    if not values_of(graph):
        return ()
    typed = names("._runtime.hooks.typed_results", "TypedResult", "TypedResults")
    return (*names("._runtime.domain.model", "Photo"), *typed)


def _attributes(fields: tuple[Field, ...], entity: Entity) -> list[Attribute]:
    taken = {field.name for field in fields}
    return [
        Attribute(
            name=field.name,
            type=annotation(python_type(field), taken),
            default=None if field.hint else literal(field.default),
            doc=docstring(field.doc),
        )
        for field in fields
        if field.on is entity
    ]


def _field(field: Field) -> str:
    """Return what a program needs to know of a field; its sentence is the attribute's."""
    arguments = [
        f"name={literal(field.name)}",
        f"on=Entity.{field.on.name}",
        f"type={type(field.type).__name__}.{field.type.name}",
        f"label={literal(field.label)}",
    ]
    if field.default is not None:
        arguments.append(f"default={literal(field.default)}")
    if isinstance(field, AlongField):
        arguments.append(f"actions={items(map(literal, field.actions))}")
    return call(type(field).__name__, arguments)


def _category(category: graph_model.Category) -> str:
    """Return what differs from the defaults, which are the runtime's as well."""
    arguments = [f"name={literal(category.name)}"]
    for param in PARAMS:
        value = getattr(category, param.name)
        if value != param.default:
            arguments.append(f"{param.name}={literal(value)}")
    if category.actions is not None:
        actions = items(map(literal, category.actions), "{}") if category.actions else ""
        arguments.append(f"actions=frozenset({actions})")
    return call("Category", arguments)


def all_fields(graph: Graph) -> tuple[Field, ...]:
    """Return every field: missions' before trips', and the blocks' before the app's own."""
    found = (*fields_of(graph), *map(own_field, graph.fields))
    return tuple(field for entity in Entity for field in found if field.on is entity)


def own_field(field: AppField) -> OwnField:
    """Return a field of the app's own as its package has it."""
    return OwnField(
        name=field.name,
        on=field.on,
        type=field.type,
        label=field.name.replace("_", " ").capitalize(),
        doc=f"Of the app's own{f', {UNITS[field.type]}' if field.type in UNITS else ''}.",
        default=field.default,
    )


def fields_of(graph: Graph) -> tuple[Field, ...]:
    """Return every field of a block once: missions' before trips', each in the order of the blocks."""
    found: dict[tuple[Entity, str], Field] = {}
    for node in graph.nodes:
        for field in node.block.needs:
            same = found.setdefault((field.on, field.name), field)
            if same.type is not field.type:
                raise EmbedError(
                    f"two blocks of the graph want different things of a {field.on.value}'s "
                    f"{field.name}: {same.type.value} and {field.type.value} ({node.name})"
                )
    if any(node.block.launches for node in graph.nodes):
        if graph.reacts or graph.along or graph.follows:
            found.update(((Entity.TRIP, field.name), field) for field in TRIP_FIELDS)
        if graph.along:
            found[Entity.TRIP, "along"] = _along(graph)
    return tuple(field for entity in Entity for field in found.values() if field.on is entity)


def _along(graph: Graph) -> AlongField:
    return AlongField(
        name="along",
        on=Entity.TRIP,
        type=FieldType.ALONG,
        label="On the way",
        doc="What is done on the way to the target.",
        actions=graph.along,
    )


def python_type(field: Field) -> str:
    """Return the annotation of a field."""
    if isinstance(field, AlongField):
        return "Along | None"
    if isinstance(field, TrackField) and field.type is Type.TEXT:
        return "str | None"
    if isinstance(field.type, Type):
        return OWN_PYTHON[field.type]
    written = PYTHON[field.type]
    optional = field.default is None and "None" not in written
    return f"{written} | None" if optional else written
