"""The central store of what actions gave (thesis 6.1.3): append-only, across missions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from typing import Any, Generic, NamedTuple, TypeVar, overload

from .model import Mission, Trip

R = TypeVar("R")
M = TypeVar("M", bound=Mission[Any])
T = TypeVar("T", bound=Trip)


class Result(NamedTuple, Generic[M, T]):
    """What one action gave; (mission, trip, round, attempt) tells it from all others."""

    mission: M
    trip: T
    round: int
    attempt: int
    value: object


class SoFar(Sequence[R]):
    """The first so many of a list that only grows: a view, not a copy."""

    __slots__ = ("_count", "_list")

    def __init__(self, growing: list[R]) -> None:
        self._list, self._count = growing, len(growing)

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> R: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[R]: ...
    def __getitem__(self, index: int | slice) -> R | Sequence[R]:
        if isinstance(index, slice):
            return tuple(self._list[place] for place in range(*index.indices(self._count)))
        if not -self._count <= index < self._count:
            raise IndexError(index)
        return self._list[index if index >= 0 else index + self._count]

    def __iter__(self) -> Iterator[R]:
        return islice(self._list, self._count)


class Results(NamedTuple, Generic[M, T]):
    """What an evaluator gets to judge."""

    new: tuple[Result[M, T], ...]
    """The mission's results since its evaluator was last asked."""
    all: Sequence[Result[M, T]]
    """Every result of the app, of all missions."""


class ResultStore:
    """Where results are kept."""

    def __init__(self) -> None:
        self.results: list[Result[Any, Any]] = []
        self._new: dict[Mission[Any], list[Result[Any, Any]]] = {}
        """What each mission has brought since its evaluator was last asked."""

    def add(self, mission: Mission[Any], trip: Trip, value: object) -> None:
        """Keep what the trip's action gave."""
        result = Result(mission, trip, mission.round, trip.attempt, value)
        self.results.append(result)
        new = self._new.get(mission)
        if new is None:
            self._new[mission] = [result]
        else:
            new.append(result)

    def for_evaluator(self, mission: Mission[Any]) -> Results[Any, Any]:
        """Return what a mission's evaluator gets now."""
        return Results(new=tuple(self._new.pop(mission, ())), all=SoFar(self.results))
