"""What an app holds, and what an operation makes of that: worked out apart from the service."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace

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
from plutoc.source import Source, Span
from plutoc.syntax.parse import read
from plutoc.syntax.tree import BlockDecl, FieldsDecl, FlowDecl

Edge = tuple[str, str, frozenset[str], bool]


@dataclass(frozen=True, kw_only=True)
class App:
    """An app's content: nothing of how it is laid out."""

    title: str | None
    uses: frozenset[str]
    blocks: dict[str, tuple[str, dict[str, str]]]
    """Kind and arguments, as written."""
    edges: frozenset[Edge]
    fields: tuple[tuple[str, tuple[str, ...]], ...]
    """The app's own fields in their order: `mission.patient`, and its words."""
    others: frozenset[tuple[str, ...]]
    """The other statements: their words."""


def app_of(text: str) -> App:
    """Read an app with the compiler's own parser; a text with mistakes in its syntax is refused."""
    source = Source("a.pluto", text)
    file, found = read(source)
    assert not found, [one.message for one in found]
    blocks, edges, fields, others = {}, [], [], []
    for one in file.app.statements:
        if isinstance(one, BlockDecl):
            kind = f"{one.prefix.text}.{one.kind.text}" if one.prefix else one.kind.text
            values = {a.name.text: _bare(source, a.value.span) for a in one.arguments}
            assert one.name.text not in blocks
            blocks[one.name.text] = (kind, values)
        elif isinstance(one, FlowDecl):
            for i, (left, right) in enumerate(zip(one.stops, one.stops[1:], strict=False)):
                guard = one.guard if i == len(one.stops) - 2 else None
                when = frozenset(n.text for n in guard.statuses) if guard else frozenset()
                edges += [
                    (
                        a.text,
                        b.text,
                        when,
                        (b.text == "end" and not when) or bool(guard and guard.otherwise),
                    )
                    for a in left.names
                    for b in right.names
                ]
        elif isinstance(one, FieldsDecl):
            fields += [
                (f"{one.on}.{each.name.text}", _words(_bare(source, each.span)))
                for each in one.fields
            ]
        else:
            others.append(_words(_bare(source, one.span)))
    assert len(fields) == len(dict(fields)), "a field is there twice"
    assert len(edges) == len(set(edges)), "an edge is there twice"
    return App(
        title=file.app.title.value if file.app.title else None,
        uses=frozenset(source.quote(use.span) for use in file.uses),
        blocks=blocks,
        edges=frozenset(edges),
        fields=tuple(fields),
        others=frozenset(others),
    )


def edge(arrow: Arrow) -> Edge:
    """Return an edge as the model has it."""
    at_end = arrow.target == "end" and not arrow.when
    return arrow.source, arrow.target, frozenset(arrow.when), at_end or arrow.otherwise


def after(app: App, operation: Operation, names: tuple[str, ...], now: App) -> App:
    """Return what an app is to hold after an operation.

    `names` are the names that new blocks were given: which are free is not asked here, only that
    they were. Of what a new block brings along (values that it cannot do without), it is taken from
    `now` that it came.
    """
    blocks, edges = dict(app.blocks), set(app.edges)
    assert not set(names) & blocks.keys(), "a name was taken"
    match operation:
        case AddBlock(kind=kind, arguments=arguments):
            (name,) = names
            values = now.blocks[name][1]
            assert arguments.items() <= values.items()
            added = now.others - app.others
            assert len(added) <= 1 and app.others <= now.others
            return replace(
                app, blocks={**blocks, name: (kind, values)}, others=now.others, uses=now.uses
            )
        case RemoveBlocks(names=gone):
            blocks = {name: one for name, one in blocks.items() if name not in gone}
            edges = {one for one in edges if one[0] not in gone and one[1] not in gone}
        case Duplicate(names=some):
            called = dict(zip(dict.fromkeys(some), names, strict=True))
            blocks |= {called[name]: blocks[name] for name in called}
            edges |= {
                (called[a], called[b], w, o) for a, b, w, o in edges if {a, b} <= called.keys()
            }
        case Paste(text=text):
            came = app_of(f"pluto 1\napp p {{\n{text}\n}}\n")
            called = dict(zip(came.blocks, names, strict=True))
            blocks |= {called[name]: one for name, one in came.blocks.items()}
            edges |= {(called.get(a, a), called.get(b, b), w, o) for a, b, w, o in came.edges}
            new = tuple(one for one in came.fields if one[0] not in dict(app.fields))
            app = replace(app, fields=app.fields + new)
        case Connect(arrow=arrow):
            edges.add(edge(arrow))
        case Disconnect(arrow=arrow):
            edges.remove(edge(arrow))
        case Redirect(arrow=arrow, source=source, target=target):
            edges.remove(edge(arrow))
            edges.add(
                edge(replace(arrow, source=source or arrow.source, target=target or arrow.target))
            )
        case SetGuard(arrow=arrow, when=when, otherwise=otherwise):
            edges.remove(edge(arrow))
            edges.add(edge(replace(arrow, when=when, otherwise=otherwise and not when)))
        case SetArgument(owner=owner, parameter=parameter, value=value) if owner in blocks:
            kind, values = blocks[owner]
            left = {name: one for name, one in values.items() if name != parameter}
            blocks[owner] = (kind, left if value is None else {**values, parameter: value})
        case SetTitle(title=title):
            return replace(app, title=title or None)
        case Declare(text=text):
            came = app_of(f"pluto 1\napp p {{\n{text}\n}}\n")
            return replace(
                app,
                blocks=blocks | came.blocks,
                fields=app.fields + came.fields,
                others=app.others | came.others,
            )
        case Rewrite(name=name, text=text) if "." in name:
            on = name.partition(".")[0]
            (field,) = app_of(f"pluto 1\napp p {{\n{on} has {text}\n}}\n").fields
            return replace(app, fields=tuple(field if f[0] == name else f for f in app.fields))
        case Rewrite(name=name, text=text):
            came = app_of(f"pluto 1\napp p {{\n{text}\n}}\n")
            if name in blocks:
                blocks |= came.blocks
            else:
                rest = {one for one in app.others if one[1] != name}
                return replace(app, others=frozenset(rest) | came.others)
        case RemoveDeclaration(name=name) if "." in name:
            assert name in dict(app.fields)
            assert not any(
                name == f"mission.{one}" for words in app.others for one in written(words)
            )
            return replace(app, fields=tuple(one for one in app.fields if one[0] != name))
        case RemoveDeclaration(name=name):
            rest = {_without(one, name) for one in app.others if one[1] != name}
            return replace(app, others=frozenset(rest))
        case Rename(name=name, new=new) if "." in name:
            return _field_renamed(app, name, new)
        case Rename(name=name, new=new):
            return _renamed(app, name, new)
        case Bracket() | Move():
            pass
        case _:
            return now  # a category's argument: compared as words by the caller's other rules
    return replace(app, blocks=blocks, edges=frozenset(edges))


def _renamed(app: App, name: str, new: str) -> App:
    def called(one: str) -> str:
        return new if one == name else one

    is_block = name in app.blocks
    return replace(
        app,
        blocks={
            called(b) if is_block else b: (
                kind,
                values if is_block else {p: called(value) for p, value in values.items()},
            )
            for b, (kind, values) in app.blocks.items()
        },
        edges=(
            frozenset((called(a), called(b), w, o) for a, b, w, o in app.edges)
            if is_block
            else app.edges
        ),
        others=app.others if is_block else frozenset(tuple(map(called, one)) for one in app.others),
    )


def _field_renamed(app: App, name: str, new: str) -> App:
    """Return the app with a field called otherwise where it is declared, and where modifiers write it."""
    on, _, old = name.partition(".")
    assert name in dict(app.fields)

    def called(words: tuple[str, ...]) -> tuple[str, ...]:
        those = written(words) if on == "mission" else ()
        kept = words[: len(words) - len(those)]
        return (*kept, *(new if word == old else word for word in those))

    return replace(
        app,
        fields=tuple(
            (f"{on}.{new}", (new, *words[1:])) if one == name else (one, words)
            for one, words in app.fields
        ),
        others=frozenset(map(called, app.others)),
    )


def written(words: tuple[str, ...]) -> tuple[str, ...]:
    """Return what stands behind `writes` of a modifier."""
    is_modifier = words[0] == "modifier" and "writes" in words
    return words[words.index("writes") + 1 :] if is_modifier else ()


def _without(words: tuple[str, ...], action: str) -> tuple[str, ...]:
    """A category that cannot do an action any more."""
    if words[0] != "category" or "can" not in words:
        return words
    at = words.index("can")
    left = [word for word in words[at + 1 :] if word not in (",", action)]
    listed = [part for word in left for part in (word, ",")][:-1]
    return (*words[: at + 1], *listed)


def _bare(source: Source, span: Span) -> str:
    """Return a text without comments, its blanks as the formatter writes them."""
    text = source.quote(span)
    for comment in comments(text):
        text = text.replace(comment, "", 1)
    return " ".join(text.split())


def _words(text: str) -> tuple[str, ...]:
    words = re.findall(r'"(?:[^"\\]|\\.)*"|[^\s,():]+|[,():]', text)
    while words and words[-1] == ",":
        words.pop()
    return tuple(words)


def comments(text: str) -> list[str]:
    """Return the comments of a text: what stands behind `#` outside of quotes."""
    found = re.findall(r'"(?:[^"\\\n]|\\[^\n])*"|(#[^\n]*)', text)
    return sorted(one.rstrip() for one in found if one)
