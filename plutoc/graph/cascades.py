"""Suppressing follow-up errors: one mistake is reported once."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Sequence
from dataclasses import replace

from plutoc.diagnostic import Diagnostic, Related, in_order
from plutoc.source import Source
from plutoc_runtime.domain.text import counted

_OF_THE_APP = frozenset({"P1011", "P1021", "P1022", "P1024", "P1032"})
"""Codes of names that an app declares itself: one missing declaration is one mistake."""
_MOST_PLACES = 3


_NAMES = frozenset({"P1002", "P1012", "P1024", "P1028", "P1032"})
_BREAK = re.compile(r"[ \t]*(#[^\n]*)?\r?\n(?:\s|#[^\n]*\n)*")
_LETTERS = ("", *"_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789")
"""What may have stood between two halves of a name: nothing, or what another sign replaced."""


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
        Related(other.source, other.span, label) for other, label in zip(more, labels, strict=False)
    )
    return replace(first, related=(*first.related, *places))


def told_once(
    source: Source, found: Sequence[Diagnostic], names: Collection[str], fixed: Collection[str]
) -> list[Diagnostic]:
    """Leave out what is wrong only because the name right before it is.

    `names` are those of blocks; `fixed` are words that no app can use as it likes, kinds and
    statuses: where one of them begins a line, it has changed places with the word before.
    """
    left: list[Diagnostic] = []
    for diagnostic in in_order(found):
        before = left[-1] if left else None
        if before is None or not _is_one(source, before, diagnostic, names, fixed):
            left.append(diagnostic)
    return left


def _is_one(
    source: Source,
    one: Diagnostic,
    other: Diagnostic,
    names: Collection[str],
    fixed: Collection[str],
) -> bool:
    if one.code not in _NAMES or other.code not in _NAMES:
        return False
    middle = source.text[one.span.end : other.span.start]
    left, right = source.quote(one.span), source.quote(other.span)
    if middle in ("\n", "\r\n") or len(middle) == 1:
        whole = [left + letter + right for letter in _LETTERS]
        if any(word in names or word in fixed for word in whole):
            return True
    return right in fixed and _BREAK.fullmatch(middle) is not None
