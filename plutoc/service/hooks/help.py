"""Completion and hover in hooks.py: what missions, trips, drones and the rest offer.

It is being typed, and need not be Python yet: nothing is run, and nothing parsed as a whole.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from plutoc.block import HookKind
from plutoc.emit.stubs import exports_of, stubs
from plutoc.graph.model import Graph
from plutoc.hooks.expected import PASSED
from plutoc.service.answers import Hover, Item, Sort
from plutoc.service.document import Document
from plutoc.service.hooks.names import Around, around, chain_before
from plutoc.service.hooks.types import HookType, Member, types_of
from plutoc.service.reading.hover import of_hook
from plutoc.source import Span

_DEFINING = re.compile(r"(?:^|\n)[ \t]*(?:async[ \t]+)?(?:def[ \t]+)?$")
_IMPORTING = re.compile(r"from[ \t]+\.[ \t]+import[ \t]+(?:\([^)]*|[\w, \t]*)$")
_CALL = re.compile(r"\b([A-Z]\w*)\($")


def complete(document: Document, text: str, offset: int) -> tuple[Item, ...]:
    """Return what may stand at a place of the text of an app's hooks.py."""
    start = _word_start(text, offset)
    if _is_said(text, start):
        return ()
    types = types_of(document.graph)
    place = around(text, offset, types, passed_to(document.graph))
    found = _found(document, text, start, place, types)
    prefix = text[start:offset].lower()
    end = offset
    while end < len(text) and (text[end].isalnum() or text[end] == "_"):
        end += 1
    return tuple(
        Item(
            label=name,
            insert=insert,
            span=Span(start, end),
            kind=sort,
            detail=detail,
            doc=doc,
        )
        for name, insert, sort, detail, doc in found
        if name.lower().startswith(prefix)
    )


_Found = tuple[str, str, Sort, str, str]


def _found(
    document: Document, text: str, start: int, place: Around, types: Mapping[str, HookType]
) -> Iterator[_Found]:
    before, exports = text[:start], exports_of(document.graph, former=True)
    if before.endswith("."):
        chain = chain_before(text, start - 1)
        for member in place.members(place.type_of(chain)) if chain else ():
            sort = Sort.METHOD if member.signature else Sort.ATTRIBUTE
            yield member.name, member.name, sort, member.signature or member.type, member.doc
        return
    if _IMPORTING.search(before):
        for name in exports:
            yield name, name, Sort.TYPE, "", types[name].doc if name in types else ""
        return
    if not place.name or _DEFINING.search(before):
        yield from _stubs(document, text, before)
    if before.endswith("def "):
        return
    called = _called(text, start)
    if called in types:
        for member in types[called].members:
            if member.settable:
                yield f"{member.name}=", f"{member.name}=", Sort.PARAMETER, member.type, member.doc
    for name, annotation in place.parameters.items():
        kind = place.type_of(name)
        doc = types[kind].doc if kind in types else ""
        yield name, name, Sort.PARAMETER, annotation or kind, doc
    for name in exports:
        if name in types:
            yield name, name, Sort.TYPE, "", types[name].doc


def _stubs(document: Document, text: str, before: str) -> Iterator[_Found]:
    """Give the hooks that the file does not define yet, each as a whole function."""
    if document.checked is None:
        return
    begun = re.search(r"[^\n]*$", before)
    said = begun[0].strip() if begun else ""
    for stub in stubs(document.checked):
        if re.search(rf"\bdef[ \t]+{stub.name}\b", text):
            continue
        body = "\n    ".join(stub.lines)
        head = f"{stub.coroutine}def {stub.name}{stub.signature}:"
        if said and not head.startswith(said):
            head = head.removeprefix("async ")
        insert = f"{head}\n    {body}\n".removeprefix(said).lstrip()
        yield stub.name, insert, Sort.HOOK, "a hook of the app", of_hook(document, stub.name)


def hover(document: Document, text: str, offset: int) -> Hover | None:
    """Return what is to be known about a place of the text of an app's hooks.py."""
    start = _word_start(text, offset)
    word = re.match(r"[^\W\d]\w*", text[start:])
    if word is None or _is_said(text, start):
        return None
    types = types_of(document.graph)
    place = around(text, offset, types, passed_to(document.graph))
    said = _said(document, text, start, word[0], place, types)
    return Hover(markdown=said, span=Span(start, start + len(word[0]))) if said else None


def _said(
    document: Document,
    text: str,
    start: int,
    word: str,
    place: Around,
    types: Mapping[str, HookType],
) -> str:
    if text[:start].endswith("."):
        owner = place.type_of(chain_before(text, start - 1))
        member = place.member(owner, word)
        return _of_member(owner.removeprefix("type "), member) if member else ""
    if word in passed_to(document.graph):
        return of_hook(document, word)
    if word in types:
        return _code(f"class {word}") + f"\n\n{types[word].doc}"
    kind = place.type_of(word)
    if kind in types:
        return _code(f"{word}: {kind}") + f"\n\n{types[kind].doc}"
    return _code(f"{word}: {kind}") if kind and not kind.startswith("type ") else ""


def _of_member(owner: str, member: Member) -> str:
    return _code(member.signature or f"{owner}.{member.name}: {member.type}") + f"\n\n{member.doc}"


def _code(text: str) -> str:
    return f"```python\n{text}\n```"


def passed_to(graph: Graph) -> dict[str, tuple[str, ...]]:
    """Return what each hook gets by position."""
    found = {hook.name: PASSED[hook.kind] for hook in graph.hooks}
    return found | {action.name: PASSED[HookKind.ACTION] for action in graph.actions}


def _word_start(text: str, offset: int) -> int:
    start = min(max(offset, 0), len(text))
    while start and (text[start - 1].isalnum() or text[start - 1] == "_"):
        start -= 1
    return start


def _is_said(text: str, at: int) -> bool:
    """Return whether a place lies in a comment, or in a text of its line."""
    line = text[text.rfind("\n", 0, at) + 1 : at]
    quote, filled = "", False
    for i, char in enumerate(line):
        if quote:
            quote = "" if char == quote and line[i - 1] != "\\" else quote
        elif char in "\"'":
            quote, filled = char, line[:i].endswith(("f", "F"))
        elif char == "#":
            return True
    return bool(quote) and not (filled and line.rfind("{") > line.rfind("}"))


def _called(text: str, at: int) -> str:
    """Return the type in whose call a place lies, if it is one."""
    depth = 0
    for i in range(at - 1, max(at - 2_000, -1), -1):
        depth += (text[i] in ")]}") - (text[i] in "([{")
        if depth < 0:
            match = _CALL.search(text[: i + 1])
            return match[1] if match else ""
    return ""
