"""The parts of an app: for a list of symbols, for folding, for colours by meaning."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from plutoc.service.document import Document
from plutoc.service.symbols import Role
from plutoc.source import Span
from plutoc.syntax.fragment import tokens_of
from plutoc.syntax.tokens import SOFT_KINDS, WORDS, span
from plutoc.syntax.tree import (
    ActionDecl,
    BadStatement,
    BlockDecl,
    CategoryDecl,
    EventDecl,
    FieldsDecl,
    HookDecl,
    Name,
    Parameter,
    Statement,
)

_COMMENTS = re.compile(r"(?:^[ \t]*#[^\n]*\n?){2,}", re.MULTILINE)
_KEYWORDS = SOFT_KINDS | {word.upper() for word in WORDS}


@dataclass(frozen=True, slots=True, kw_only=True)
class Symbol:
    """A declaration in the outline."""

    name: str
    detail: str
    role: Role
    span: Span
    name_span: Span
    children: tuple[Symbol, ...] = ()


def outline(document: Document) -> tuple[Symbol, ...]:
    """Return the app with what it declares, in the order of the source."""
    app = document.file.app
    children = tuple(one for statement in app.statements for one in _declared(statement))
    if not app.name.text:
        return children
    whole = app.span if app.span.start <= app.name.span.start else app.name.span
    title = app.title.value if app.title else ""
    whole = Span(whole.start, max((whole.end, *(one.span.end for one in children))))
    return (
        Symbol(
            name=app.name.text,
            detail=title,
            role=Role.APP,
            span=whole,
            name_span=app.name.span,
            children=children,
        ),
    )


def _declared(one: Statement) -> Iterator[Symbol]:
    match one:
        case FieldsDecl():
            for field in one.fields:
                detail = f"{one.on} has, {field.type.text}"
                yield _symbol(field.name, detail, Role.FIELD, field)
        case CategoryDecl():
            yield _symbol(one.name, ", ".join(name.text for name in one.can), Role.CATEGORY, one)
        case EventDecl():
            yield _symbol(one.name, "event", Role.EVENT, one)
        case ActionDecl():
            yield _symbol(one.name, "action", Role.ACTION, one)
        case HookDecl():
            yield _symbol(one.name, one.kind, Role(one.kind), one)
        case BlockDecl():
            prefix = f"{one.prefix.text}." if one.prefix else ""
            yield _symbol(one.name, prefix + one.kind.text, Role.BLOCK, one)
        case BadStatement(name=Name() as name) if name.span.start >= one.span.start:
            yield _symbol(name, "cannot be read", Role.BLOCK, one)


def _symbol(name: Name, detail: str, role: Role, one: Statement | Parameter) -> Symbol:
    return Symbol(name=name.text, detail=detail, role=role, span=one.span, name_span=name.span)


@dataclass(frozen=True, slots=True, kw_only=True)
class Fold:
    """A stretch that can be folded to its first line."""

    span: Span
    is_comment: bool = False


def folds(document: Document) -> tuple[Fold, ...]:
    """Return what can be folded: the app, statements of several lines, comments of several lines."""
    text, app = document.text, document.file.app
    stretches = [one.span for one in (app, *app.statements)]
    long = [one for one in stretches if "\n" in text[one.start : one.end].rstrip()]
    comments = [Span(*match.span()) for match in _COMMENTS.finditer(text)]
    return (
        *(Fold(span=one) for one in dict.fromkeys(long)),
        *(Fold(span=one, is_comment=True) for one in comments),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Coloured:
    """A word, and what it is: a name by its role, else one of the language's words."""

    span: Span
    role: Role | None
    declares: bool = False


def coloured(document: Document) -> tuple[Coloured, ...]:
    """Return the names of an app and the words of the language, in the order of the source."""
    names = {one.span.start: one for one in document.names}
    found = [
        Coloured(span=one.span, role=one.role, declares=one.declares) for one in names.values()
    ]
    found += (
        Coloured(span=span(token), role=None)
        for token in tokens_of(document.text)
        if token.type in _KEYWORDS and span(token).start not in names
    )
    return tuple(sorted(found, key=lambda one: one.span.start))
