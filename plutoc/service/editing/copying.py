"""Blocks copied as Pluto text, and Pluto text put into an app."""

from __future__ import annotations

import re
from collections.abc import Sequence

from plutoc.service.editing.declarations import (
    Declaration,
    added,
    declarations,
    declared,
    free_name,
    statements_in,
    taken,
)
from plutoc.service.editing.draft import Draft
from plutoc.service.editing.fields import taken_in
from plutoc.service.editing.flows import CannotEdit, among
from plutoc.service.editing.flows import added as with_flow
from plutoc.source import Source, Span
from plutoc.syntax.tree import (
    BlockDecl,
    FieldsDecl,
    File,
    FlowDecl,
    RequiresDecl,
    ResultDecl,
    Statement,
    VersionDecl,
)


def copied(draft: Draft, names: Sequence[str]) -> str:
    """Return blocks, and the edges among them, as Pluto text."""
    blocks = [declared(draft.file, name) for name in dict.fromkeys(names)]
    lines = [draft.text(block.span) for block in blocks if isinstance(block, BlockDecl)]
    if len(lines) < len(blocks) or not lines:
        raise CannotEdit("only blocks are copied")
    return "\n".join([*lines, *among(draft.file, names)]) + "\n"


def pasted(draft: Draft, text: str) -> tuple[Draft, tuple[str, ...]]:
    """Put statements into an app; return the names of the blocks that came in.

    A block whose name is taken gets the next number. What else is declared already stays as it is:
    an app has one action of a name.
    """
    source, statements = statements_in(text)
    if not statements:
        raise CannotEdit("there is nothing to paste")
    blocks = [one.name.text for one in statements if isinstance(one, BlockDecl)]
    twice = next((name for name in blocks if blocks.count(name) > 1), None)
    if twice:
        raise CannotEdit(f"what is to be pasted declares `{twice}` twice")
    used, known = taken(draft.file), {each.name.text for each in declarations(draft.file)}
    called = {name: free_name(_without_number(name, used), used) for name in blocks}
    last = ""
    for one in statements:
        if isinstance(one, VersionDecl | RequiresDecl) or _is_known(one, known):
            continue
        if isinstance(one, FieldsDecl) and taken_in(draft, one) is not None:
            continue
        if isinstance(one, ResultDecl) and _is_said(one, draft.file):
            continue
        written = _renamed(source, one, called)
        if isinstance(one, FlowDecl):
            name = one.stops[0].names[0].text
            draft = with_flow(draft, written, last or called.get(name, name))
            last = called.get(name, name)
        else:
            draft = added(draft, written, type(one))
    return draft, tuple(called.values())


def _without_number(name: str, used: set[str]) -> str:
    """Return a name that is taken without its number, from which it is counted on."""
    return re.sub(r"_\d+$", "", name) if name.lower() in used else name


def _is_known(one: Statement, known: set[str]) -> bool:
    """Whether it declares, and is no block, what the app declares already."""
    return (
        isinstance(one, Declaration) and not isinstance(one, BlockDecl) and one.name.text in known
    )


def _is_said(one: ResultDecl, file: File) -> bool:
    """Whether an app says already how results of this action are shown so."""
    said = [each for each in file.app.statements if isinstance(each, ResultDecl)]
    return (one.action.text, one.way.text) in [(s.action.text, s.way.text) for s in said]


def _renamed(source: Source, one: Statement, called: dict[str, str]) -> str:
    """Return a statement's text with the names that its blocks have here, and the comment beside it."""
    text, at = "", one.span.start
    match one:
        case BlockDecl():
            names = [one.name]
        case FlowDecl():
            names = [name for stop in one.stops for name in stop.names]
        case _:
            names = []
    for name in names:
        text += source.quote(Span(at, name.span.start)) + called.get(name.text, name.text)
        at = name.span.end
    line_end = source.text.find("\n", one.span.end)
    return text + source.quote(Span(at, line_end)).rstrip()
