"""A change in meaning, as a value: one fact, its sentence, and where it stands in both sources."""

from __future__ import annotations

from enum import Enum

from plutoc.check.model import Checked
from plutoc.diagnostic import Diagnostic
from plutoc.frozen import frozen
from plutoc.source import Source, Span
from plutoc_runtime.domain.status import Status

Fact = bool | int | float | str | tuple[str, ...] | None
"""What a change leads from, or to: a value in SI units, names, or None where there is nothing."""

Spans = tuple[tuple[Span, ...], tuple[Span, ...]]
"""Places in the old source, and in the new one."""


class Importance(Enum):
    """How much hangs on a change, most first."""

    SAFETY = "safety"
    """What may happen to a drone in the air, and what becomes of failures."""
    MISSIONS = "missions"
    """Where missions go, and what they wait for."""
    PEOPLE = "people"
    """What people write in missions files, fleet files and hooks, and what they type."""
    FORM = "form"
    """Names and arrangement: no mission fares otherwise."""


@frozen
class Version:
    """One of the two apps."""

    checked: Checked
    warnings: tuple[Diagnostic, ...]


@frozen
class Change:
    """One change in meaning."""

    kind: str
    """One of those that docs/diff.md lists: for programs."""
    importance: Importance
    sentence: str
    """For people; names stand in backquotes. It begins small and ends without a full stop."""
    blocks: tuple[str, ...] = ()
    """What it is about, by its name in the new app, or in the old one where it is gone."""
    statuses: tuple[Status, ...] = ()
    before: Fact = None
    after: Fact = None
    was: tuple[Span, ...] = ()
    """Places in the old source."""
    now: tuple[Span, ...] = ()
    """Places in the new source."""


@frozen
class Difference:
    """All that changed in meaning from one source to another, most important first."""

    old: Source
    new: Source
    changes: tuple[Change, ...]
