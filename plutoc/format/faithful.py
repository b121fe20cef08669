"""Whether two sources say the same: what keeps a mistake of the formatter from doing harm."""

from __future__ import annotations

import re
from dataclasses import fields, is_dataclass

from plutoc.syntax.tree import File

_PLACES = frozenset({"source", "span"})
_KEPT = re.compile(r'"(?:[^"\\\n]|\\[^\n])*"|#[^\n]*|[^\s,]')


def same_meaning(one: File, other: File) -> bool:
    """Say whether two trees differ at most in places."""
    return _unplaced(one) == _unplaced(other)


def same_writing(one: str, other: str) -> bool:
    """Say whether two sound texts differ at most in commas and in blanks around words.

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
