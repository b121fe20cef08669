"""What a client asks without changing anything."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from plutoc.editor import asked as read
from plutoc.editor.app_files import AppFiles
from plutoc.editor.asked import Asked, Refused
from plutoc.editor.history import File
from plutoc.editor.wire import Wire
from plutoc.explain.pages import code_meant, codes, page
from plutoc.hooks.module import read as read_hooks
from plutoc.hooks.python import Unreadable
from plutoc.service.completion.complete import complete
from plutoc.service.hooks import help as hook_help
from plutoc.service.hooks.types import types_of
from plutoc.service.picture.ports import targets
from plutoc.service.reading.hover import hover
from plutoc.service.symbols import HOOKS, Occurrence, at, same
from plutoc.source import Span

Data = dict[str, object]


def _complete(files: AppFiles, asked: Asked) -> Data:
    file, wire, offset = _place(files, asked)
    if file is File.APP:
        items = complete(files.document, offset)
    else:
        items = hook_help.complete(files.document, wire.text, offset)
    return {
        "items": [
            {
                "label": one.label,
                "insert": one.insert,
                **_span(wire, one.span),
                "kind": one.kind.value,
                "detail": one.detail,
                "doc": one.doc,
            }
            for one in items
        ]
    }


def _hover(files: AppFiles, asked: Asked) -> Data:
    file, wire, offset = _place(files, asked)
    if file is File.APP:
        found = hover(files.document, offset)
    else:
        found = hook_help.hover(files.document, wire.text, offset)
    if found is None:
        return {"markdown": ""} | _span(wire, Span(offset, offset))
    return {"markdown": found.markdown} | _span(wire, found.span)


def _place(files: AppFiles, asked: Asked) -> tuple[File, Wire, int]:
    """Return which text is meant, and where in it; of hooks.py, as Python reads it."""
    file, place = read.file(asked), read.number(asked, "offset")
    hooks = files.hooks
    if file is File.APP:
        wire = Wire(files.document.text)
    else:
        wire = Wire(hooks.text if hooks else "", marked=False)
    if not 0 <= place <= wire.length:
        raise Refused("offset must be a place in the text")
    return file, wire, wire.in_file(place)


def _named(files: AppFiles, asked: Asked) -> tuple[tuple[Occurrence, ...], Occurrence | None]:
    file, _, offset = _place(files, asked)
    names = files.document.names
    return names, at(names, offset) if file is File.APP else None


def _definition(files: AppFiles, asked: Asked) -> Data:
    """Say where a name is declared; of a hook, also where its function is."""
    found, one = _named(files, asked)
    declared = [each for each in same(found, one) if each.declares] if one else []
    function = hook_function(files, one.name) if one and one.role in HOOKS else None
    return {"places": [*_places(files, declared), *([function] if function else [])]}


def hook_function(files: AppFiles, name: str) -> Data | None:
    """Return where hooks.py defines a function, if it does."""
    hooks = files.hooks
    try:
        definition = read_hooks(hooks).defined.get(name) if hooks else None
    except Unreadable:
        return None
    if hooks is None or definition is None:
        return None
    start = sum(len(one) + 1 for one in hooks.text.split("\n")[: definition.lineno - 1])
    span = Span(start, start + len(hooks.line(definition.lineno)))
    wire = Wire(hooks.text, marked=False)
    at = _span(wire, span)
    return {"file": File.HOOKS.value, "line": definition.lineno, "offset": at["from"], **at}


def _references(files: AppFiles, asked: Asked) -> Data:
    found, one = _named(files, asked)
    return {"places": _places(files, same(found, one) if one else [])}


def _places(files: AppFiles, found: Sequence[Occurrence]) -> list[Data]:
    wire = Wire(files.document.text)
    return [_span(wire, one.span) | {"file": File.APP.value} for one in found]


def _span(wire: Wire, span: Span) -> Data:
    return {"from": wire.on_wire(span.start), "to": wire.on_wire(span.end)}


def _ports(files: AppFiles, asked: Asked) -> Data:
    source, when = read.text(asked, "source"), read.texts(asked, "when")
    return {"targets": dict(targets(files.document, source, when))}


def _explain(files: AppFiles, asked: Asked) -> Data:
    code = code_meant(read.text(asked, "code"))
    if code not in codes():
        raise Refused(f"there is no code {code}")
    found = page(code)
    return {"code": code, "title": found.title, "markdown": found.text}


_GIVEN = {
    "mission": "Mission",
    "trip": "Trip",
    "drone": "Drone",
    "context": "Context",
    "results": "Results",
    "result": "Result",
    "verdict": "Verdict",
}
"""What hooks are given or give, by the names that stubs have for it."""


def _entities(files: AppFiles, asked: Asked) -> Data:
    types = types_of(files.document.graph)
    found = [(name, types[kind]) for name, kind in _GIVEN.items() if kind in types]
    return {
        "entities": [
            {
                "name": name,
                "type": kind.name,
                "doc": kind.doc.partition("\n")[0],
                "attributes": [
                    {"name": one.name, "type": one.signature or one.type, "doc": one.doc}
                    for one in kind.members
                ],
            }
            for name, kind in found
        ]
    }


QUESTIONS: Mapping[str, Callable[[AppFiles, Asked], Data]] = {
    "complete": _complete,
    "hover": _hover,
    "definition": _definition,
    "references": _references,
    "ports": _ports,
    "entities": _entities,
    "explain": _explain,
}
