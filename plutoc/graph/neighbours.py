"""Two wrong names beside a line break that are one mistake: torn in two, or in each other's place."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

from plutoc.diagnostic import Diagnostic, in_order
from plutoc.source import Source

_NAMES = frozenset({"P1002", "P1012", "P1024", "P1028", "P1032"})
_BREAK = re.compile(r"[ \t]*(#[^\n]*)?\r?\n(?:\s|#[^\n]*\n)*")
_LETTERS = ("", *"_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789")
"""What may have stood between two halves of a name: nothing, or what another sign replaced."""


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
