"""An operation → the smallest text edits that do it."""

from __future__ import annotations

from dataclasses import dataclass, replace

from plutoc.diagnostic import Fix
from plutoc.graph.model import END, START
from plutoc.service.document import Document
from plutoc.service.editing import declarations as declared
from plutoc.service.editing import fields
from plutoc.service.editing import flows as edges
from plutoc.service.editing.copying import copied, pasted
from plutoc.service.editing.draft import Draft
from plutoc.service.editing.flows import CannotEdit
from plutoc.service.editing.operations import (
    AddBlock,
    Arrow,
    Bracket,
    Connect,
    Declare,
    Disconnect,
    Duplicate,
    Move,
    Operation,
    Paste,
    Redirect,
    RemoveBlocks,
    RemoveDeclaration,
    Rename,
    Rewrite,
    SetArgument,
    SetGuard,
    SetTitle,
)
from plutoc.service.editing.rename import renamed
from plutoc.syntax.tree import (
    ActionDecl,
    BlockDecl,
    CategoryDecl,
    EventDecl,
    FieldsDecl,
    FlowDecl,
    HookDecl,
    ResultDecl,
)

__all__ = ["CannotEdit", "Edited", "edit"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Edited:
    """What an operation changes."""

    edits: tuple[Fix, ...]
    """Of the source: in its order, none overlapping."""
    hooks: tuple[Fix, ...] = ()
    """Of hooks.py."""
    names: tuple[str, ...] = ()
    """The blocks that are new, to be selected."""
    note: str = ""
    """What is left to people."""


def edit(document: Document, operation: Operation) -> Edited:
    """Return the edits that do an operation; raise `CannotEdit` where it cannot be done.

    They change no statement but those that the operation names, and no comment is lost.
    """
    before = Draft.of(document.source)
    if isinstance(operation, Rename):
        change = renamed(document, operation.name, operation.new)
        return Edited(edits=change.edits, hooks=change.hooks, note=change.note)
    draft, names = _done(before, operation)
    return Edited(edits=draft.edits(document.source), names=names)


def _done(draft: Draft, operation: Operation) -> tuple[Draft, tuple[str, ...]]:
    match operation:
        case AddBlock():
            draft, name = declared.new_block(
                draft, operation.kind, operation.name, dict(operation.arguments)
            )
            return draft, (name,)
        case Duplicate():
            return pasted(draft, copied(draft, operation.names))
        case Paste():
            return pasted(draft, operation.text)
        case _:
            return _changed(draft, operation), ()


def _changed(draft: Draft, operation: Operation) -> Draft:
    match operation:
        case RemoveBlocks(names=names):
            blocks = [_block(draft, name).name.text for name in dict.fromkeys(names)]
            draft = edges.without_blocks(draft, blocks)
            for name in blocks:
                draft = declared.without(draft, name)
        case Connect(arrow=arrow):
            _check_ends(draft, arrow)
            draft = edges.connected(draft, arrow)
        case Disconnect(arrow=arrow):
            draft = edges.disconnected(draft, arrow)
        case Redirect(arrow=arrow):
            new = replace(
                arrow,
                source=operation.source or arrow.source,
                target=operation.target or arrow.target,
                otherwise=arrow.otherwise or (arrow.target == END and not arrow.when),
            )
            _check_ends(draft, new)
            draft = edges.redirected(draft, arrow, new)
        case SetGuard(arrow=arrow, when=when, otherwise=otherwise):
            new = replace(arrow, when=when, otherwise=otherwise and not when)
            _check_ends(draft, new)
            draft = edges.guarded(draft, arrow, new)
        case Bracket(source=source, targets=targets):
            draft = edges.bracketed(draft, source, targets)
        case SetArgument(owner=owner, parameter=parameter, value=value):
            draft = declared.with_argument(draft, owner, parameter, value)
        case SetTitle(title=title):
            draft = declared.with_title(draft, title)
        case Rewrite(name=name, text=text) if fields.is_field(name):
            draft = fields.rewritten(draft, name, text)
        case Rewrite(name=name, text=text):
            draft = declared.rewritten(draft, name, text)
        case Move(name=name, before=before):
            draft = declared.moved(draft, name, before)
        case Declare(text=text):
            draft = _declare(draft, text)
        case RemoveDeclaration(name=name) if fields.is_field(name):
            draft = fields.without(draft, name)
        case RemoveDeclaration(name=name):
            draft = _remove(draft, name)
    return draft


def _block(draft: Draft, name: str) -> BlockDecl:
    one = declared.declared(draft.file, name)
    if not isinstance(one, BlockDecl):
        raise CannotEdit(f"`{name}` is not a block")
    return one


def _check_ends(draft: Draft, arrow: Arrow) -> None:
    """Raise `CannotEdit` where an edge cannot be, in any app."""
    if arrow.target == START:
        raise CannotEdit("no edge leads to `start`: every mission begins there once")
    if arrow.source == END:
        raise CannotEdit("no edge leaves `end`: missions are over there")
    begins = arrow.source == START or declared.is_event(draft.file, arrow.source)
    if begins and edges.guard_text(arrow):
        raise CannotEdit(
            f"an edge from `{arrow.source}` has no guard: nothing has happened there yet"
        )
    if not begins:
        _block(draft, arrow.source)
    if arrow.target != END:
        _block(draft, arrow.target)


def _declare(draft: Draft, text: str) -> Draft:
    _, statements = declared.statements_in(text)
    one = statements[0] if len(statements) == 1 else None
    if isinstance(one, FieldsDecl):
        twice = fields.taken_in(draft, one)
        if twice is not None:
            raise CannotEdit(f"`{twice}` is declared already")
        return declared.added(draft, declared.one_ending(text).strip(), FieldsDecl)
    if isinstance(one, ResultDecl):
        return declared.added(draft, declared.one_ending(text).strip(), ResultDecl)
    if not isinstance(one, CategoryDecl | EventDecl | ActionDecl | HookDecl | BlockDecl):
        raise CannotEdit("this is not one declaration")
    if one.name.text.lower() in declared.taken(draft.file):
        raise CannotEdit(f"`{one.name.text}` is declared already")
    return declared.added(draft, declared.one_ending(text).strip(), type(one))


def _remove(draft: Draft, name: str) -> Draft:
    """Take a declaration out that nothing needs; an action with all that is said of it elsewhere."""
    one = declared.declared(draft.file, name)
    if isinstance(one, BlockDecl):
        raise CannotEdit(f"`{name}` is a block: it is removed with its edges")
    for each in declared.declarations(draft.file):
        given = each.arguments if isinstance(each, BlockDecl) else ()
        if any(draft.source.quote(argument.value.span) == name for argument in given):
            raise CannotEdit(f"`{each.name.text}` uses `{name}`: change or remove that first")
    flows = (each for each in draft.file.app.statements if isinstance(each, FlowDecl))
    if isinstance(one, EventDecl) and any(
        name == each.text for flow in flows for stop in flow.stops for each in stop.names
    ):
        raise CannotEdit(f"the event `{name}` leads somewhere: remove that edge first")
    for statement in reversed(draft.file.app.statements):
        if isinstance(statement, CategoryDecl) and name in [can.text for can in statement.can]:
            draft = _cannot_any_more(draft, statement, name)
        elif isinstance(statement, ResultDecl) and statement.action.text == name:
            draft = draft.changed(draft.without(statement))
    return declared.without(draft, name)


def _cannot_any_more(draft: Draft, category: CategoryDecl, action: str) -> Draft:
    left = [can.text for can in category.can if can.text != action]
    if not left:
        raise CannotEdit(f"`{category.name.text}` can do nothing but `{action}`: change it first")
    listed = category.can[0].span.to(category.can[-1].span)
    return draft.changed(Fix(span=listed, text=", ".join(left)))
