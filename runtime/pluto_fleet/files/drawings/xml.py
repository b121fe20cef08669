"""Reading XML that anyone may have written: without entities of its own, and bounded."""

from __future__ import annotations

from xml.etree.ElementTree import Element, TreeBuilder
from xml.parsers.expat import ExpatError, ParserCreate

from .feature import CUT_OFF, Unusable

DEEPEST = 100
MOST_ELEMENTS = 500_000


def tree_of(text: str, what: str) -> Element:
    """Return the elements of a text; raise `Unusable` if it is no XML, or has a document type.

    Only a document type can declare entities: those that grow when they are read, and those that are other files.
    """
    builder = TreeBuilder()
    parser = ParserCreate("utf-8", " ")
    parser.buffer_text = True
    depth = 0
    count = 0

    def start(name: str, attributes: dict[str, str]) -> None:
        nonlocal depth, count
        depth += 1
        count += 1
        if depth > DEEPEST:
            raise Unusable(f"is nested deeper than {DEEPEST}")
        if count > MOST_ELEMENTS:
            raise Unusable(f"has more than {MOST_ELEMENTS:,} elements")
        builder.start(name, attributes)

    def end(name: str) -> None:
        nonlocal depth
        depth -= 1
        builder.end(name)

    def refuse(*_: object) -> None:
        raise Unusable(f"has a document type, which no {what} needs: take it out")

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    parser.CharacterDataHandler = builder.data
    parser.StartDoctypeDeclHandler = refuse
    parser.EntityDeclHandler = refuse
    try:
        parser.Parse(text.encode(), True)
    except ExpatError as error:
        raise Unusable(f"cannot be read as {what}: {error}{CUT_OFF}") from None
    root: Element = builder.close()
    return root


def local(tag: str) -> str:
    """Return the name of an element without its namespace."""
    return tag.rpartition(" ")[2]
