"""`model.py`: the missions and trips of the app, with its fields and categories."""

from __future__ import annotations

from plutoc.emit.fields import fields_of, python_type
from plutoc.emit.imports import Import, import_lines, names
from plutoc.emit.python import annotation, builtins_alias, call, docstring, items, literal, shadows
from plutoc.emit.render import render
from plutoc.frozen import frozen
from plutoc.graph import model as graph_model
from plutoc.graph.categories import PARAMS
from plutoc.graph.model import Graph
from plutoc_runtime.domain.fields import Entity, Field


@frozen
class Attribute:
    """One line of a class, and its docstring."""

    name: str
    type: str
    default: str
    doc: str


@frozen
class CategoryEntry:
    """A category, below the declaration that it comes from."""

    declaration: str
    written: str


@frozen
class ModelFile:
    """What the template places."""

    app: str
    imports: list[str]
    mission: list[Attribute]
    trip: list[Attribute]
    fields: list[str]
    categories: list[CategoryEntry]


def model_file(graph: Graph) -> str:
    """Return the text of `model.py`, not yet formatted."""
    fields = fields_of(graph)
    return render(
        "model.py",
        ModelFile(
            app=graph.name,
            imports=import_lines(_imports(fields)),
            mission=_attributes(fields, Entity.MISSION),
            trip=_attributes(fields, Entity.TRIP),
            fields=[_field(field) for field in fields],
            categories=[
                CategoryEntry(declaration=category.declaration, written=_category(category))
                for category in graph.categories
            ],
        ),
    )


def _imports(fields: tuple[Field, ...]) -> list[Import]:
    imports = [
        *names("dataclasses", "dataclass"),
        *names("._runtime.domain", "model", "results"),
        *names("._runtime.domain.fields", "Field"),
        *names("._runtime.domain.model", "Category"),
    ]
    if fields:
        imports += names("._runtime.domain.fields", "Entity", "FieldType")
    taken = {field.name for field in fields}
    if shadows(taken, (python_type(field) for field in fields)):
        alias = builtins_alias(taken)
        imports.append(Import(module="builtins", alias=None if alias == "builtins" else alias))
    return imports


def _attributes(fields: tuple[Field, ...], entity: Entity) -> list[Attribute]:
    taken = {field.name for field in fields}
    return [
        Attribute(
            name=field.name,
            type=annotation(python_type(field), taken),
            default=literal(field.default),
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
        f"type=FieldType.{field.type.name}",
        f"label={literal(field.label)}",
    ]
    if field.default is not None:
        arguments.append(f"default={literal(field.default)}")
    return call("Field", arguments)


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
