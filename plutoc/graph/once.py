"""A name that is declared nowhere is told once, however often it is used."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace

from plutoc.diagnostic import Diagnostic
from plutoc.graph.wording import related
from plutoc_runtime.domain.text import counted

_OF_THE_APP = frozenset({"P1011", "P1021", "P1022", "P1024", "P1032"})
"""Codes of names that an app declares itself: one missing declaration is one mistake."""
_MOST_PLACES = 3


def each_name_once(found: Iterable[Diagnostic]) -> list[Diagnostic]:
    """Tell of a name that is declared nowhere once, with the places where it is used besides."""
    once: dict[str | int, list[Diagnostic]] = {}
    for i, diagnostic in enumerate(found):
        shared = diagnostic.code in _OF_THE_APP
        key = diagnostic.source.quote(diagnostic.span) if shared else i
        once.setdefault(key, []).append(diagnostic)
    return [_with_places(first, more) for first, *more in once.values()]


def _with_places(first: Diagnostic, more: Sequence[Diagnostic]) -> Diagnostic:
    if not more:
        return first
    left = len(more) - _MOST_PLACES
    labels = ["here, too"] * min(len(more), _MOST_PLACES)
    if left > 0:
        labels[-1] = f"here, too, and in {counted(left, 'more place')}"
    places = tuple(
        related(other.source, other.span, label) for other, label in zip(more, labels, strict=False)
    )
    return replace(first, related=(*first.related, *places))
