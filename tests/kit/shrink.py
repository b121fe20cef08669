"""Makes what shows something smaller, as long as it shows it: any plain value, and any app's source."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import MISSING, fields, is_dataclass, replace
from enum import Enum
from typing import Any, TypeVar

T = TypeVar("T")

TRIES = 600


def shrunk(
    case: T,
    smaller: Callable[[T], Iterator[T]],
    shows: Callable[[T], bool],
    tries: int = TRIES,
) -> T:
    """Return the smallest case that is come to, by taking the first smaller one each time."""
    again = True
    while again:
        again = False
        for each in smaller(case):
            tries -= 1
            if tries < 0:
                return case
            if shows(each):
                case, again = each, True
                break
    return case


def simpler(value: Any) -> Iterator[Any]:
    """Yield a value with one thing less in it, wherever that can be: of a tuple something is left."""
    match value:
        case Enum():
            first = next(iter(type(value)))
            yield from [first] if value is not first else []
        case Mapping():
            for name in value:
                yield {other: kept for other, kept in value.items() if other != name}
        case tuple() if all(is_dataclass(each) or isinstance(each, tuple) for each in value):
            for number, each in enumerate(value):
                if len(value) > 1:
                    yield without(value, number)
                yield from ((*value[:number], less, *value[number + 1 :]) for less in simpler(each))
        case _ if is_dataclass(value):
            yield from _plain(value)
            for field in fields(value):
                for less in simpler(getattr(value, field.name)):
                    yield replace(value, **{field.name: less})  # type: ignore[type-var]


def _plain(value: Any) -> Iterator[Any]:
    """Yield what is made without saying anything, if that can be, and is something else."""
    if all(f.default is not MISSING or f.default_factory is not MISSING for f in fields(value)):
        plain = type(value)()
        yield from [plain] if plain != value else []


_WORDS = (
    "category",
    "action",
    "event",
    "creator",
    "evaluator",
    "modifier",
    "policy",
    "mission",
    "trip",
)


def smaller_sources(text: str) -> Iterator[str]:
    """Yield an app's source with an arrow, a block or a declaration less: most are refused."""
    lines = text.splitlines()
    for number in range(2, len(lines) - 1):
        name = re.match(r"  (\w+) = ", lines[number])
        if name is not None:
            yield from _without_block(lines, name[1])
        elif "->" in lines[number] or lines[number].split()[0] in _WORDS:
            yield "\n".join(without(lines, number)) + "\n"


def _without_block(lines: list[str], name: str) -> Iterator[str]:
    """Take a block out: with all its arrows, or by leading on what led to it."""
    mention = re.compile(rf"\b{name}\b")
    yield "\n".join(line for line in lines if not mention.search(line)) + "\n"
    targets = [
        line.split(" -> ")[1].split()[0] for line in lines if line.startswith(f"  {name} -> ")
    ]
    for target in dict.fromkeys(targets):
        if target[0] != "[" and target != name:
            kept = [line for line in lines if not re.match(rf"  {name} (=|->) ", line)]
            yield "\n".join(mention.sub(target, line) for line in kept) + "\n"


def without(values: Sequence[T], number: int) -> tuple[T, ...]:
    """Return all values but one."""
    return (*values[:number], *values[number + 1 :])
