"""`mission has …` and `trip has …`: the fields of an app's own."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from plutoc.diagnostic import Diagnostic
from plutoc.graph import errors as errors_of_names
from plutoc.graph import field_errors as errors
from plutoc.graph.hooks import declaration, parameters
from plutoc.graph.model import AppField, Node
from plutoc.source import Source
from plutoc.syntax.tree import FieldsDecl, Name, Parameter, Statement
from plutoc_runtime.domain.fields import Entity
from plutoc_runtime.domain.model import Mission, Trip


def _attributes(of: type) -> frozenset[str]:
    return frozenset(name for name in dir(of) if not name.startswith("_"))


TAKEN: Mapping[Entity, frozenset[str]] = {
    Entity.MISSION: _attributes(Mission)
    | {"trip", "area", "list", "deadline", "window", "after", "late"}
    | {"key", "launched", "ended"},
    Entity.TRIP: _attributes(Trip) | {"priority", "key", "x", "y", "z"},
}
"""What a mission or a trip has anyway: its attributes, what plans say of it, and the station."""


def fields(
    source: Source,
    statements: Sequence[Statement],
    nodes: Sequence[Node],
    found: list[Diagnostic],
) -> tuple[AppField, ...]:
    """Resolve the fields of an app's own. One of an unknown type is left out: the error is told."""
    return tuple(
        one for on in Entity for one in _of(on, source, declared(statements, on), nodes, found)
    )


def declared(statements: Sequence[Statement], on: Entity) -> list[Parameter]:
    """Return the fields that are declared for missions, or for trips."""
    several = (s for s in statements if isinstance(s, FieldsDecl) and s.on == on.value)
    return [field for statement in several for field in statement.fields]


def _of(
    on: Entity,
    source: Source,
    written: Sequence[Parameter],
    nodes: Sequence[Node],
    found: list[Diagnostic],
) -> Iterator[AppField]:
    role = f"a field of {on.value}s"
    first = {one.name.text: one for one in _once_each(source, written, role, found)}
    for one in first.values():
        _check_free(on, source, one.name, nodes, found)
    resolved = {
        one.name: one for one in parameters(source, list(first.values()), role, found, role)
    }
    for name, one in first.items():
        if name in resolved:
            yield AppField(
                on=on,
                name=name,
                type=resolved[name].type,
                default=resolved[name].default,
                declaration=declaration(one),
                span=one.name.span,
            )


def _once_each(
    source: Source, written: Sequence[Parameter], role: str, found: list[Diagnostic]
) -> Iterator[Parameter]:
    """Yield those that are not declared before; of a line that stands twice it is told once."""
    first: dict[str, Parameter] = {}
    told: set[tuple[int, int]] = set()
    for one in written:
        before = first.setdefault(one.name.text, one)
        if before is one:
            yield one
            continue
        lines = tuple(source.position(each.span.start)[0] for each in (before, one))
        if lines not in told or lines[0] == lines[1]:
            found.append(errors_of_names.declared_twice(source, one.name, role, before.name, role))
        told.add((lines[0], lines[1]))


def _check_free(
    on: Entity, source: Source, name: Name, nodes: Sequence[Node], found: list[Diagnostic]
) -> None:
    for node in nodes:
        if any(need.on is on and need.name == name.text for need in node.block.needs):
            found.append(errors.field_of_a_block(source, name, on, node))
            return
    if name.text in TAKEN[on]:
        found.append(errors.taken_field(source, name, on))
