"""The central store of what actions gave (thesis 6.1.3): append-only, across missions."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
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


_WIDTH = len(Result._fields)


class SoFar(Sequence[Result[Any, Any]]):
    """The results that there are by now: a view of all that ever come, not a copy."""

    __slots__ = ("_count", "_values")

    def __init__(self, values: list[Any]) -> None:
        self._values, self._count = values, len(values) // _WIDTH

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> Result[Any, Any]: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Result[Any, Any]]: ...
    def __getitem__(self, index: int | slice) -> Result[Any, Any] | Sequence[Result[Any, Any]]:
        places = range(self._count)[index]  # an IndexError is its own
        if isinstance(places, range):
            return tuple(self._at(place) for place in places)
        return self._at(places)

    def __iter__(self) -> Iterator[Result[Any, Any]]:
        return map(self._at, range(self._count))

    def _at(self, place: int) -> Result[Any, Any]:
        return Result(*self._values[_WIDTH * place : _WIDTH * (place + 1)])


class Results(NamedTuple, Generic[M, T]):
    """What an evaluator gets to judge."""

    new: tuple[Result[M, T], ...]
    """The mission's results since its evaluator was last asked."""
    all: Sequence[Result[M, T]]
    """Every result of the app, of all missions."""


class ResultStore:
    """Where results are kept.

    Most are never looked at again, and there may be millions: so they are kept as the plain values
    of their fields, one result behind the other, and made into results for whoever looks.
    """

    def __init__(self) -> None:
        self.values: list[Any] = []
        self.new: defaultdict[Mission[Any], list[int]] = defaultdict(list)
        """Where the values begin that each mission has brought since its evaluator was asked."""

    def so_far(self) -> SoFar:
        """Return every result there is by now."""
        return SoFar(self.values)

    def for_evaluator(self, mission: Mission[Any]) -> Results[Any, Any]:
        """Return what a mission's evaluator gets now."""
        values = self.values
        new = (Result(*values[start : start + _WIDTH]) for start in self.new.pop(mission, ()))
        return Results(tuple(new), self.so_far())
