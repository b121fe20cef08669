"""Something that may be meant at a place, before it is tried."""

from __future__ import annotations

from dataclasses import dataclass

from plutoc.service.answers import Sort


@dataclass(frozen=True, slots=True, kw_only=True)
class Candidate:
    """Something that may stand in a hole, in one of several forms: the first legal one counts."""

    label: str
    kind: Sort
    forms: tuple[str, ...] = ()
    """What is written; without any, the label."""
    detail: str = ""
    doc: str = ""
    rank: int = 0
    """The smaller, the likelier."""
    judged: bool = False
    """The checks of the graph can tell how well it fits."""
