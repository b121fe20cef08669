"""What a client asks without changing anything."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from plutoc.editor import asked as read
from plutoc.editor.app_files import AppFiles
from plutoc.editor.asked import Asked, Refused
from plutoc.editor.history import File
from plutoc.editor.wire import Wire
from plutoc.explain.pages import code_meant, codes, page
from plutoc.service import hook_help
from plutoc.service.complete import complete
from plutoc.service.hook_types import types_of
from plutoc.service.hover import hover
from plutoc.service.ports import targets
from plutoc.service.symbols import Occurrence, at, occurrences, same
from plutoc.source import Span

Data = dict[str, object]


def _complete(files: AppFiles, asked: Asked) -> Data:
    """What may stand at a place of the app, or of hooks.py."""
    wire, place = _place(files, asked)
    if read.file(asked) is File.APP:
        found = complete(files.document, place)
    else:
        found = hook_help.complete(files.document, wire.shown, place)
    return {
        "items": [
            {
                "label": one.label,
                "insert": one.insert,
                "kind": one.kind.value,
                "detail": one.detail,
                "doc": one.doc,
                **_span(wire, one.span),
            }
            for one in found
        ]
    }


def _hover(files: AppFiles, asked: Asked) -> Data:
    """What is to be known about a place of the app, or of hooks.py."""
    wire, place = _place(files, asked)
    if read.file(asked) is File.APP:
        found = hover(files.document, place)
    else:
        found = hook_help.hover(files.document, wire.shown, place)
    if found is None:
        return {"markdown": "", "from": 0, "to": 0}
    return {"markdown": found.markdown, **_span(wire, found.span)}


def _place(files: AppFiles, asked: Asked) -> tuple[Wire, int]:
    """Return the text that is meant, and the place in it."""
    if read.file(asked) is File.APP:
        wire = Wire(files.document.text)
    else:
        wire = Wire(files.hooks.text if files.hooks else "", marked=False)
    offset = read.number(asked, "offset")
    if not 0 <= offset <= wire.length:
        raise Refused("offset must be a place in the text")
    return wire, wire.in_file(offset)


_GIVEN = {
    "mission": "Mission",
    "trip": "Trip",
    "drone": "Drone",
    "context": "Context",
    "results": "Results",
}
"""What hooks are given, by the names that stubs have."""


def _entities(files: AppFiles, _: Asked) -> Data:
    """What hooks are given, and what each has."""
    types = types_of(files.document.graph)
    return {
        "entities": [
            {
                "name": name,
                "doc": types[kind].doc.partition("\n")[0],
                "attributes": [
                    {"name": one.name, "type": one.signature or one.type, "doc": one.doc}
                    for one in types[kind].members
                ],
            }
            for name, kind in _GIVEN.items()
        ]
    }


def _named(files: AppFiles, asked: Asked) -> tuple[tuple[Occurrence, ...], Occurrence | None]:
    document = files.document
    found = occurrences(document.file)
    place = read.number(asked, "offset")
    if place < 0:
        raise Refused("offset must be a place in the text")
    return found, at(found, Wire(document.text).in_file(place))


def _definition(files: AppFiles, asked: Asked) -> Data:
    """Where a name is declared; a hook's function is told besides."""
    found, one = _named(files, asked)
    declared = [each for each in same(found, one) if each.declares] if one else []
    return {"places": _places(files, declared)}


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


QUESTIONS: Mapping[str, Callable[[AppFiles, Asked], Data]] = {
    "complete": _complete,
    "hover": _hover,
    "entities": _entities,
    "definition": _definition,
    "references": _references,
    "ports": _ports,
    "explain": _explain,
}
