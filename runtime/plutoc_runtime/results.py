"""The central store of what actions gave (thesis 6.1.3): append-only, across missions."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from itertools import islice, starmap
from typing import Any, Generic, NamedTuple, TypeVar, overload

from .model import Mission, Trip

M = TypeVar("M", bound=Mission[Any])
T = TypeVar("T", bound=Trip)


class Result(NamedTuple, Generic[M, T]):
    """What one action gave; (mission, trip, round, attempt) tells it from all others."""

    mission: M
    trip: T
    round: int
    attempt: int
    value: object


Row = tuple[Mission[Any], Trip, int, int, object]
"""A result as it is kept: most are never looked at, and a plain tuple is made far faster."""


class SoFar(Sequence[Result[Any, Any]]):
    """The first so many of the rows that only grow, as results: a view, not a copy."""

    __slots__ = ("_count", "_rows")

    def __init__(self, rows: list[Row]) -> None:
        self._rows, self._count = rows, len(rows)

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> Result[Any, Any]: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Result[Any, Any]]: ...
    def __getitem__(self, index: int | slice) -> Result[Any, Any] | Sequence[Result[Any, Any]]:
        places = range(self._count)[index]  # an IndexError is its own
        if isinstance(places, range):
            return tuple(Result(*self._rows[place]) for place in places)
        return Result(*self._rows[places])

    def __iter__(self) -> Iterator[Result[Any, Any]]:
        return starmap(Result, islice(self._rows, self._count))


class Results(NamedTuple, Generic[M, T]):
    """What an evaluator gets to judge."""

    new: tuple[Result[M, T], ...]
    """The mission's results since its evaluator was last asked."""
    all: Sequence[Result[M, T]]
    """Every result of the app, of all missions."""


class ResultStore:
    """Where results are kept."""

    def __init__(self) -> None:
        self.rows: list[Row] = []
        self.new: defaultdict[Mission[Any], list[Row]] = defaultdict(list)
        """What each mission has brought since its evaluator was last asked."""

    def so_far(self) -> SoFar:
        """Return every result there is by now."""
        return SoFar(self.rows)

    def for_evaluator(self, mission: Mission[Any]) -> Results[Any, Any]:
        """Return what a mission's evaluator gets now."""
        new = tuple(starmap(Result, self.new.pop(mission, ())))
        return Results(new, self.so_far())
