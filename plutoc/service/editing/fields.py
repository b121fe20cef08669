"""Fields of an app's own, one by one: written anew, taken out, and renamed where hooks use them.

A field is called `mission.patient` or `trip.note` here: names of declarations have no point in them.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from plutoc.diagnostic import Fix
from plutoc.graph.fields import TAKEN
from plutoc.graph.names import Style, has_style, is_well_formed, reserved
from plutoc.hooks.module import node_span
from plutoc.hooks.python import Unreadable, at, column_of, parsed
from plutoc.service.document import Document
from plutoc.service.editing.draft import Draft
from plutoc.service.editing.flows import CannotEdit
from plutoc.service.hooks.help import passed_to
from plutoc.service.hooks.names import around, chain_before
from plutoc.service.hooks.types import types_of
from plutoc.service.symbols import Role, fields_of, occurrences
from plutoc.source import Source, Span
from plutoc.syntax.parse import read
from plutoc.syntax.tokens import OWNERS
from plutoc.syntax.tree import FieldsDecl, HookDecl, Parameter
from plutoc_runtime.domain.fields import Entity

_TYPES = {"mission": "Mission", "trip": "Trip"}
"""The class of an entity, as hooks.py has it."""


def is_field(name: str) -> bool:
    """Return whether this is how a field is called here."""
    return name.partition(".")[0] in OWNERS and "." in name


def rewritten(draft: Draft, name: str, text: str) -> Draft:
    """Put another text in the place of a field's declaration."""
    statement, field = _declared(draft, name)
    source = Source("", f"pluto 1\napp a {{\n{statement.on} has {text.strip()}\n}}\n")
    file, found = read(source)
    new = file.app.statements[0] if len(file.app.statements) == 1 else None
    if found or not isinstance(new, FieldsDecl) or len(new.fields) != 1:
        why = found[0].message if found else "one field stands here, as in `patient: text`"
        raise CannotEdit(f"this is no field: {why}")
    written = source.quote(new.fields[0].span)
    if written != text.strip():
        raise CannotEdit("a field has no comment of its own here: write that in the text")
    if new.fields[0].name.text != field.name.text:
        raise CannotEdit(
            f"this declares `{new.fields[0].name.text}`: to rename `{field.name.text}` everywhere,"
            " rename it"
        )
    return draft.changed(Fix(span=field.span, text=written))


def without(draft: Draft, name: str) -> Draft:
    """Take a field out with the comma that belongs to it; the last one, with its statement."""
    statement, field = _declared(draft, name)
    hooks = [one for one in draft.file.app.statements if isinstance(one, HookDecl)]
    for each in hooks if statement.on == "mission" else ():
        if any(one.text == field.name.text for one in each.writes):
            raise CannotEdit(f"`{each.name.text}` writes `{field.name.text}`: change it first")
    i = statement.fields.index(field)
    if len(statement.fields) == 1:
        return draft.changed(draft.without(statement))
    if i > 0:
        span = Span(statement.fields[i - 1].span.end, field.span.end)
    else:
        span = Span(field.span.start, statement.fields[1].span.start)
    return draft.changed(Fix(span=span, text=""))


def _declared(draft: Draft, name: str) -> tuple[FieldsDecl, Parameter]:
    on, _, called = name.partition(".")
    for statement in fields_of(draft.file):
        for field in statement.fields if statement.on == on else ():
            if field.name.text == called:
                return statement, field
    raise CannotEdit(f"the app declares no field `{called}` of {on}s")


def taken_in(draft: Draft, text: FieldsDecl) -> str | None:
    """Return a field of this statement that the app declares already."""
    there = {
        f.name.text.lower() for s in fields_of(draft.file) if s.on == text.on for f in s.fields
    }
    return next((f.name.text for f in text.fields if f.name.text.lower() in there), None)


def renamed(document: Document, name: str, new: str) -> tuple[tuple[Fix, ...], tuple[Fix, ...]]:
    """Return the edits of the source and of hooks.py that rename a field."""
    on, _, old = name.partition(".")
    found = [one for one in occurrences(document.file) if one.role is Role.FIELD]
    places = [one.span for one in found if (one.owner, one.name) == (on, old)]
    if not any(one.declares and (one.owner, one.name) == (on, old) for one in found):
        raise CannotEdit(f"the app declares no field `{old}` of {on}s")
    if new == old:
        return (), ()
    others = {one.name.lower() for one in found if one.owner == on} - {old.lower()}
    _check(document, Entity(on), new, others)
    hooks = tuple(Fix(span=one, text=new) for one in _in_hooks(document, on, old))
    return tuple(Fix(span=one, text=new) for one in places), hooks


def _check(document: Document, on: Entity, new: str, others: set[str]) -> None:
    """Raise `CannotEdit` if no field can be called so."""
    whose = reserved(new)
    if not is_well_formed(new) or not has_style(new, Style.SNAKE):
        raise CannotEdit(f"`{new}` is no name of a field: it is written in snake_case")
    if whose:
        raise CannotEdit(f"`{new}` cannot be a name: it is {whose}")
    needs = (need for node in document.graph.nodes for need in node.block.needs)
    if new in TAKEN[on] or any((need.on, need.name) == (on, new) for need in needs):
        raise CannotEdit(f"every {on.value} of this app has a `{new}` already")
    if new.lower() in others:
        raise CannotEdit(f"`{new}` is declared already")


def _in_hooks(document: Document, on: str, name: str) -> list[Span]:
    """Find where hooks.py uses a field, as far as it is clear of what: `mission.patient`, `Trip(note=…)`."""
    hooks = document.hooks
    if hooks is None:
        return []
    try:
        module = parsed(hooks)
    except Unreadable:
        raise CannotEdit(f"{hooks.path} cannot be read as Python: mend it first") from None
    return sorted(_uses(document, hooks, module, on, name))


def _uses(
    document: Document, hooks: Source, module: ast.Module, on: str, name: str
) -> Iterator[Span]:
    types, passed = types_of(document.graph), passed_to(document.graph)
    for node in ast.walk(module):
        match node:
            case ast.Attribute(attr=attr) if attr == name:
                end = node_span(hooks, node).end
                point = hooks.text.rfind(".", 0, end)
                chain = chain_before(hooks.text, point)
                around_it = around(hooks.text, point, types, passed)
                if chain and around_it.type_of(chain) == _TYPES[on]:
                    yield Span(end - len(name), end)
            case ast.Call(func=ast.Name(id=called), keywords=keywords) if called == _TYPES[on]:
                for one in keywords:
                    if one.arg == name:
                        column = column_of(hooks.line(one.lineno), one.col_offset)
                        yield at(hooks, one.lineno, column, len(name))
