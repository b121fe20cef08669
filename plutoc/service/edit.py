"""An operation → the smallest text edits that do it."""

from __future__ import annotations

from dataclasses import dataclass

from plutoc.diagnostic import Fix
from plutoc.service.document import Document
from plutoc.service.operations import Operation


class CannotEdit(Exception):
    """An operation cannot be done on this text. The message is a sentence for a person."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Edited:
    """What an operation changes."""

    edits: tuple[Fix, ...]
    """Of the source: in its order, none overlapping."""
    hooks: tuple[Fix, ...] = ()
    """Of hooks.py."""
    names: tuple[str, ...] = ()
    """The blocks that are new, to be selected."""


def edit(document: Document, operation: Operation) -> Edited:
    """Return the edits that do an operation; raise `CannotEdit` where it cannot be done."""
    raise NotImplementedError
