"""Source → its text in canonical form, which says the same."""

from __future__ import annotations

import re
from dataclasses import fields, is_dataclass

from plutoc.diagnostic import Rejected
from plutoc.format.canonical import canonical
from plutoc.source import LARGEST, Source
from plutoc.syntax.parse import parse
from plutoc.syntax.tree import ActionDecl, File

_BOM = "\ufeff"


_PLACES = frozenset({"source", "span"})
_KEPT = re.compile(r'"(?:[^"\\\n]|\\[^\n])*"|#[^\n]*|[^\s,]')


class TooLarge(Exception):
    """In canonical form the source would be larger than the compiler reads."""


class MeaningChanged(Exception):
    """The formatter has made a mistake, and noticed: its text does not say what the source says."""


def format_source(source: Source) -> str:
    """Return a source in canonical form; raise `Rejected` with every mistake in its syntax.

    What is returned was read again: it has the same tree, and the same comments between the same
    words.
    """
    file = parse(source)
    text = _results_first(source.text, file).removeprefix(_BOM)
    formatted = canonical(text)
    if len(formatted.encode()) > LARGEST:
        raise TooLarge
    try:
        again = parse(Source(source.path, formatted))
    except Rejected as rejected:
        raise MeaningChanged(f"{source.path} could not be read again: {rejected}") from rejected
    if not (same_meaning(file, again) and same_writing(text, formatted)):
        raise MeaningChanged(f"{source.path} would not say the same; it was not changed")
    return formatted


def _results_first(text: str, file: File) -> str:
    """Put what an action gives before the word that says whether it may be repeated.

    Comments stay where they stand, so that one behind that word comes before the arrow.
    """
    for one in reversed(file.app.statements):
        if isinstance(one, ActionDecl) and one.returns and one.repeat:
            word, end = one.repeat.span, one.returns.span.end
            if word.end < end:
                given = text[word.end : end]
                text = f"{text[: word.start]}{given} {one.repeat.text}{text[end:]}"
    return text


def same_meaning(one: File, other: File) -> bool:
    """Return whether two trees differ at most in places."""
    return _unplaced(one) == _unplaced(other)


def same_writing(one: str, other: str) -> bool:
    """Return whether two sound texts differ at most in commas and in blanks around words.

    So each text and each comment is there, and between the same words. This reads with a pattern of
    its own, so that it makes no mistake that the formatter makes.
    """
    return _kept(one) == _kept(other)


def _unplaced(node: object) -> object:
    if isinstance(node, tuple):
        return tuple(map(_unplaced, node))
    if is_dataclass(node):
        names = (field.name for field in fields(node) if field.name not in _PLACES)
        return (type(node), *(_unplaced(getattr(node, name)) for name in names))
    return node


def _kept(text: str) -> list[str]:
    return [part.rstrip(" \t\r") for part in _KEPT.findall(text)]
