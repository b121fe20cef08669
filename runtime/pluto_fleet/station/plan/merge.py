"""Taking a change of a plan back while others draw on it: missions and trips are merged by their keys."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ...shared.domain.errors import PlutoError

if TYPE_CHECKING:
    from .shape import Shape

Part = tuple[str, ...]
"""What of a plan is meant, by keys from the outside in: a mission, a field of it, a trip in it, an order."""

_GONE: Any = object()
_ORDER = "in this order"
"""No field has a blank in its name."""


class Collision(PlutoError):
    """Two changes concern the same."""


def merged(base: Sequence[Shape], mine: Sequence[Shape], theirs: Sequence[Shape]) -> list[Shape]:
    """Return the missions with both changes, from base to mine and from base to theirs.

    Raises `Collision` where they say different things of the same.
    """
    if theirs == base:
        return [*mine]
    if mine == base:
        return [*theirs]
    olds, mines, others = _by_key(base), _by_key(mine), _by_key(theirs)
    found: dict[str, Shape] = {}
    for key in {**others, **mines}:
        one = _merged(olds.get(key, _GONE), mines.get(key, _GONE), others.get(key, _GONE))
        if one is not _GONE:
            found[key] = one
    return [found[key] for key in _order([*olds], [*mines], [*others]) if key in found]


def _merged(base: Any, mine: Any, theirs: Any) -> Any:
    if mine == base:
        return theirs
    if theirs in (base, mine):
        return mine
    if not all(isinstance(one, dict) for one in (base, mine, theirs)):
        raise Collision("it was changed in another way meanwhile")
    found = {}
    for key in {**theirs, **mine}:
        values = base.get(key, _GONE), mine.get(key, _GONE), theirs.get(key, _GONE)
        of_trips = key == "trips" and _GONE not in values
        one = merged(*values) if of_trips else _merged(*values)
        if one is not _GONE:
            found[key] = one
    return found


def _order(base: Sequence[str], mine: Sequence[str], theirs: Sequence[str]) -> list[str]:
    """Return all keys in the order of the one who has moved some; what the other has added follows its neighbour."""
    moved, moved_too = _moves(base, mine), _moves(base, theirs)
    if moved and moved_too and _moves(mine, theirs):
        raise Collision("the order was changed in another way meanwhile")
    lead, other = (mine, theirs) if moved else (theirs, mine)
    found = [*lead]
    for before, key in zip(("", *other), other, strict=False):
        if key not in lead:
            found.insert(found.index(before) + 1 if before else 0, key)
    return found


def _moves(some: Sequence[str], others: Sequence[str]) -> bool:
    """Whether what is in both is in another order."""
    here, there = set(some), set(others)
    return [key for key in some if key in there] != [key for key in others if key in here]


def touched(before: Sequence[Shape], after: Sequence[Shape]) -> Iterator[Part]:
    """Yield what a change concerns: what came or went is one part, of what stays each field is one."""
    olds, news = _by_key(before), _by_key(after)
    if _moves([*olds], [*news]):
        yield (_ORDER,)
    for key in {**olds, **news}:
        old, new = olds.get(key), news.get(key)
        if old is None or new is None:
            yield (key,)
        elif old is not new and old != new:
            yield from ((key, *part) for part in _fields(old, new))


def _fields(old: Mapping[str, Any], new: Mapping[str, Any]) -> Iterator[Part]:
    for name in {**old, **new}:
        if name == "trips":
            yield from ((name, *part) for part in touched(old[name], new[name]))
        elif old.get(name, _GONE) != new.get(name, _GONE):
            yield (name,)


def first_shared(some: Iterable[Part], others: Iterable[Part]) -> Part | None:
    """Return a part of the first that one of the others is, is in, or has in it; None: they are apart."""
    whole = set(others)
    inside = {part[:depth] for part in whole for depth in range(1, len(part) + 1)}
    for part in some:
        if part in inside or any(part[:depth] in whole for depth in range(1, len(part))):
            return part
    return None


def _by_key(shapes: Sequence[Shape]) -> dict[str, Shape]:
    return {str(shape["key"]): shape for shape in shapes}
