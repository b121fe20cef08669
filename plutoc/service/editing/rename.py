"""Another name for what an app declares: in its source, and in hooks.py where it is a function."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass

from plutoc.diagnostic import Fix
from plutoc.graph.built_in import ACTIONS
from plutoc.graph.names import Style, has_style, is_well_formed, reserved
from plutoc.hooks.module import Function, name_span, node_span
from plutoc.hooks.python import Unreadable, parsed
from plutoc.service.document import Document
from plutoc.service.editing import fields
from plutoc.service.editing.declarations import taken
from plutoc.service.editing.flows import CannotEdit
from plutoc.service.symbols import DECLARED, HOOKS, Occurrence, Role, occurrences
from plutoc.source import Source, Span


@dataclass(frozen=True, slots=True, kw_only=True)
class Renamed:
    """The edits of a source and of its hooks.py."""

    edits: tuple[Fix, ...]
    hooks: tuple[Fix, ...]
    note: str = ""
    """What is left to people."""


def renamed(document: Document, name: str, new: str) -> Renamed:
    """Return the edits that rename what an app declares; raise `CannotEdit` where that cannot be."""
    if fields.is_field(name):
        edits_of_field, of_hooks = fields.renamed(document, name, new)
        old = name.partition(".")[2]
        note = f"Missions files are not changed: where one has `{old}`, write `{new}`; `check` tells each"
        return Renamed(edits=edits_of_field, hooks=of_hooks, note=note if new != old else "")
    found = occurrences(document.file)
    one = next(
        (each for each in found if each.declares and each.name == name and each.role in DECLARED),
        None,
    )
    if one is None:
        raise CannotEdit(f"the app declares no `{name}`")
    check_new_name(document, one, new)
    if new == name:
        return Renamed(edits=(), hooks=())
    edits = []
    for each in found:
        if (each.name, each.role) == (name, one.role):
            alias = each.declares and each.role is Role.PREFIX and not _has_alias(document, name)
            edits.append(Fix(span=each.span, text=f"{name} as {new}" if alias else new))
    hooks = _in_hooks(document.hooks, name, new) if one.role in HOOKS else ()
    return Renamed(edits=tuple(edits), hooks=hooks)


def check_new_name(document: Document, one: Occurrence, new: str) -> None:
    """Raise `CannotEdit` if something cannot be called so."""
    whose = reserved(new)
    if not is_well_formed(new):
        raise CannotEdit(f"`{new}` is no name: a name is made of letters, digits and underscores")
    if whose:
        raise CannotEdit(f"`{new}` cannot be a name: it is {whose}")
    if not has_style(new, Style.SNAKE):
        raise CannotEdit(f"the name of {one.role.value} is written in small letters: snake_case")
    if one.role in HOOKS and new.lower() in ACTIONS:
        raise CannotEdit(f"`{new}` is an action that every app has")
    if new.lower() in taken(document.file) - {one.name.lower()}:
        raise CannotEdit(f"`{new}` is declared already")


def _has_alias(document: Document, name: str) -> bool:
    return any(use.alias and use.alias.text == name for use in document.file.uses)


def _in_hooks(hooks: Source | None, name: str, new: str) -> tuple[Fix, ...]:
    """Rename a function, where the module calls it by its name, and what is asked of it after a crash."""
    if hooks is None:
        return ()
    try:
        module = parsed(hooks)
    except Unreadable:
        raise CannotEdit(f"{hooks.path} cannot be read as Python: mend it first") from None
    top = {each.name for each in module.body if isinstance(each, Function)}
    if new in top:
        raise CannotEdit(f"{hooks.path} defines `{new}` already")
    fixes = []
    for old, called in ((name, new), (f"{name}_done", f"{new}_done")):
        if old in top:
            fixes += [Fix(span=span, text=called) for span in _named(hooks, module, old)]
    return tuple(sorted(fixes, key=lambda fix: fix.span))


def _named(hooks: Source, module: ast.Module, name: str) -> Iterator[Span]:
    """Find a function's name where it is defined, and wherever it means that function."""
    for node in module.body:
        if isinstance(node, Function) and node.name == name:
            yield name_span(hooks, node)
    for used in _uses(module, name):
        yield node_span(hooks, used)


def _uses(node: ast.AST, name: str) -> Iterator[ast.Name]:
    """Find the uses of a module's name, but not where a function has a variable of its own so called."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, Function | ast.Lambda) and _hides(child, name):
            continue
        if isinstance(child, ast.Name) and child.id == name:
            yield child
        yield from _uses(child, name)


def _hides(function: ast.AST, name: str) -> bool:
    for node in ast.walk(function):
        if isinstance(node, ast.arg) and node.arg == name:
            return True
        if isinstance(node, ast.Name) and node.id == name and isinstance(node.ctx, ast.Store):
            return True
    return False
