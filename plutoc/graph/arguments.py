"""What is written in the parentheses of a declaration."""

from __future__ import annotations

from collections.abc import Sequence

from plutoc.diagnostic import Diagnostic
from plutoc.graph import value_errors
from plutoc.source import Source
from plutoc.syntax.tree import Argument


def once_each(
    source: Source, arguments: Sequence[Argument], found: list[Diagnostic]
) -> list[Argument]:
    """Return the arguments without those that are given a second time."""
    first: dict[str, Argument] = {}
    for argument in arguments:
        before = first.setdefault(argument.name.text, argument)
        if before is not argument:
            found.append(value_errors.argument_twice(source, argument.name, before.name.span))
    return list(first.values())
