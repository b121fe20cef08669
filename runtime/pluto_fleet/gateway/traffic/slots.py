"""The soonest way along a course while others have parts of it for themselves.

A drone is given a stretch as a whole, from where it rests to where it rests next: everything of it must
be free when it departs, and stay so until it has left it. Short stretches are free sooner than long ones.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import inf
from typing import NamedTuple

from .courses import Course

Times = tuple[float, float]
Taken = Mapping[int, Sequence[Times]]
"""For pieces of a course: from when until when others have them."""


class Stretch(NamedTuple):
    """A part of a course that is flown in one go."""

    first: int
    """The piece at whose end the drone rests before."""
    last: int
    """The piece at whose end it rests then."""
    begins: float


class _Rest(NamedTuple):
    """A drone rests at the end of a piece."""

    since: float
    until: float
    """When somebody else must have that piece."""
    way: tuple[Stretch, ...]


Found = tuple[float, tuple[Stretch, ...]]
"""When a drone is at the end of its course, and how it gets there."""


def at_once(course: Course, taken: Taken, until: float) -> Found | None:
    """Return when a drone can be at the end without a rest; None: it cannot.

    `until`: when it must have left the place where it is.
    """
    end = len(course.pieces) - 1
    begins = _departure(course, 0, end, taken, 0.0, until)
    if begins is None:
        return None
    return begins + course.seconds, (Stretch(0, end, begins),)


def soonest(course: Course, taken: Taken, until: float, before: float) -> Found | None:
    """Return when a drone can be at the end, resting as often as it must; None: not before that."""
    places, least, end = course.rests, course.least, course.rests[-1]
    best: Found | None = None
    rests: dict[int, list[_Rest]] = {0: [_Rest(0.0, until, ())]}
    for number, first in enumerate(places[:-1]):
        for rest in rests.get(first, ()):
            if rest.since + least[first] >= before:
                continue
            for last in places[number + 1 : number + 3]:
                lasts = course.times(first, last)[-1]
                for opens, closes in _gaps(taken.get(last, ())) if last < end else _ANY:
                    since = max(rest.since, opens)
                    begins = _departure(course, first, last, taken, since, rest.until)
                    if begins is None or begins + lasts + least[last] >= before:
                        break
                    then = begins + lasts
                    way = (*rest.way, Stretch(first, last, begins))
                    if last == end:
                        before, best = then, (then, way)
                    elif then < closes:
                        _add(rests.setdefault(last, []), _Rest(then, closes, way))
    return best


_ANY: tuple[Times, ...] = ((0.0, inf),)


def _add(rests: list[_Rest], new: _Rest) -> None:
    """Keep those rests that are better than all others in something."""
    if any(one.since <= new.since and one.until >= new.until for one in rests):
        return
    rests[:] = [one for one in rests if one.since < new.since or one.until > new.until]
    rests.append(new)


def _departure(
    course: Course, first: int, last: int, taken: Taken, since: float, until: float
) -> float | None:
    """Return when a stretch may begin; None: not before the drone must be gone from where it is.

    Whether the place of the next rest is free for long enough is for others to say.
    """
    times = course.times(first, last)
    forbidden: list[Times] = []
    for piece in range(first + 1, last + (last == len(course.pieces) - 1)):
        for comes, goes in taken.get(piece, ()):
            if goes > since:
                forbidden.append((comes - times[piece - first], goes))
    begins = since
    forbidden.sort()
    for comes, goes in forbidden:
        if comes >= begins:
            break
        begins = max(begins, goes)
    return begins if begins + times[0] <= until else None


def _gaps(taken: Sequence[Times]) -> Iterator[Times]:
    """Yield from when until when a piece is free."""
    opens = 0.0
    for comes, goes in sorted(taken):
        if comes > opens:
            yield opens, comes
        opens = max(opens, goes)
    yield opens, inf
