"""A text that knows where its lines may be broken, and how wide it may be.

After Wadler's "A prettier printer": a group is written on one line if it fits there, with what
follows it up to the next possible break; otherwise all its own breaks become newlines.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True, slots=True)
class Break:
    """A newline if the group around it is broken, else this text; without one, a newline always."""

    flat: str | None


@dataclass(frozen=True, slots=True)
class IfBroken:
    """A text that stands only in a broken group."""

    text: str


@dataclass(frozen=True, slots=True)
class Remark:
    """A comment at the end of a line. It breaks the groups around it, and takes no room."""

    text: str


@dataclass(frozen=True, slots=True)
class Indent:
    """What is indented once more, from its first newline on."""

    content: Document


@dataclass(frozen=True, slots=True)
class Group:
    """What is written on one line, or broken at all its breaks."""

    content: Document


Document: TypeAlias = "str | Break | IfBroken | Remark | Indent | Group | tuple[Document, ...]"

NEWLINE, SPACE, NOTHING = Break(None), Break(" "), Break("")

_Todo = tuple[int, bool, Document]
"""An indentation, whether the group is broken, and what is still to be written."""


def written(document: Document, *, indent: int, step: int, width: int) -> str:
    """Write a document that begins at a column; every newline indents by `step` a level."""
    out: list[str] = []
    column = indent
    todo: list[_Todo] = [(indent, True, document)]
    while todo:
        level, broken, part = todo.pop()
        match part:
            case str():
                out.append(part)
                column += len(part)
            case Break(flat):
                if not broken and flat is not None:
                    out.append(flat)
                    column += len(flat)
                else:
                    out.append("\n" + " " * level)
                    column = level
            case IfBroken(text):
                if broken:
                    out.append(text)
                    column += len(text)
            case Remark(text):
                out.append("  " + text)
            case Indent(content):
                todo.append((level + step, broken, content))
            case Group(content):
                todo.append((level, not _fits(content, todo, width - column), content))
            case _:
                todo.extend((level, broken, child) for child in reversed(part))
    return "".join(out)


def _fits(document: Document, rest: Sequence[_Todo], room: int) -> bool:
    """Return whether there is room for a document, and for what follows on its line."""
    todo: list[tuple[bool, Document]] = [(False, document)]
    following = len(rest)
    while room >= 0:
        if not todo:
            if not following:
                return True
            following -= 1
            todo.append(rest[following][1:])
        broken, part = todo.pop()
        match part:
            case str():
                room -= len(part)
            case Break(None) | Remark():
                return broken
            case Break(str(flat)):
                if broken:
                    return True
                room -= len(flat)
            case IfBroken(text):
                room -= len(text) if broken else 0
            case Indent(content):
                todo.append((broken, content))
            case Group(content):
                todo.append((False, content))
            case tuple():
                todo.extend((broken, child) for child in reversed(part))
    return False
