"""Source → its text in canonical form."""

from __future__ import annotations

from plutoc.diagnostic import Rejected
from plutoc.format.canonical import canonical
from plutoc.format.faithful import same_meaning, same_writing
from plutoc.source import Source
from plutoc.syntax.parse import LARGEST, parse

_BOM = "\ufeff"


class Outgrown(Exception):
    """In canonical form the source would be larger than the compiler reads."""


class Unfaithful(Exception):
    """The formatter has made a mistake, and noticed: its text does not say what the source says."""


def format_source(source: Source) -> str:
    """Return a source in canonical form; raise `Rejected` with every mistake in its syntax.

    What is returned was read again: it has the same tree, and the same comments between the same
    words.
    """
    file = parse(source)
    text = source.text.removeprefix(_BOM)
    formatted = canonical(text)
    if len(formatted.encode()) > LARGEST:
        raise Outgrown
    try:
        again = parse(Source(source.path, formatted))
    except Rejected as rejected:
        raise Unfaithful(f"{source.path} could not be read again: {rejected}") from rejected
    if not (same_meaning(file, again) and same_writing(text, formatted)):
        raise Unfaithful(f"{source.path} would not say the same; it was not changed")
    return formatted
