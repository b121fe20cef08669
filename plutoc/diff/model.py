"""A change in meaning, as a value: one fact, its sentence, and where it stands in both sources."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from plutoc.check.model import Checked
from plutoc.diagnostic import Diagnostic
from plutoc.graph.model import Node
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


@dataclass(frozen=True, slots=True, kw_only=True)
class Version:
    """One of the two apps."""

    checked: Checked
    warnings: tuple[Diagnostic, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
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


def one_sided(
    kind: str,
    importance: Importance,
    sentence: str,
    *,
    is_new: bool,
    blocks: tuple[str, ...] = (),
    fact: Fact = None,
    spans: tuple[Span, ...] = (),
) -> Change:
    """Return a change whose fact and places are in one of the apps only."""
    return Change(
        kind=kind,
        importance=importance,
        sentence=sentence,
        blocks=blocks,
        before=None if is_new else fact,
        after=fact if is_new else None,
        was=() if is_new else spans,
        now=spans if is_new else (),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Difference:
    """All that changed in meaning from one source to another, most important first."""

    old: Source
    new: Source
    changes: tuple[Change, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Reroute:
    """Missions leave a block with these statuses for somewhere else than before."""

    old: Node
    new: Node
    statuses: tuple[Status, ...]
    before: tuple[str, ...]
    """Blocks of the old app, by their names there, or `end`."""
    after: tuple[str, ...]

    @property
    def forks(self) -> bool:
        """Return whether missions are in several places at once, before or after."""
        return len(self.before) > 1 or len(self.after) > 1
