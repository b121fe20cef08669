"""The central store of the actions' results (thesis 6.1.3): append-only, across missions."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Generic, NamedTuple, TypeVar, overload

from .model import NO_RESULT, Mission, Trip

M = TypeVar("M", bound=Mission[Any])
T = TypeVar("T", bound=Trip)


class Result(NamedTuple, Generic[M, T]):
    """The result of one action, identified by (mission, trip, round, attempt)."""

    mission: M
    trip: T
    round: int
    attempt: int
    value: object


class View(Sequence[Result[Any, Any]]):
    """The first so many results, read-only: nothing is copied for each evaluation."""

    def __init__(self, results: Sequence[Result[Any, Any]], count: int) -> None:
        self._results, self._count = results, count

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> Result[Any, Any]: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Result[Any, Any]]: ...
    def __getitem__(self, index: int | slice) -> Result[Any, Any] | Sequence[Result[Any, Any]]:
        if isinstance(index, slice):
            return tuple(self._results[number] for number in range(self._count)[index])
        return self._results[range(self._count)[index]]  # an IndexError is its own

    def __repr__(self) -> str:
        return repr(tuple(self))


class Results(NamedTuple, Generic[M, T]):
    """The results that an evaluator gets."""

    new: Sequence[Result[M, T]]
    """The mission's results since its last evaluation."""
    all: Sequence[Result[M, T]]
    """The results of all missions."""


class ResultStore:
    """Stores the results; those of one mission are a linked list, headed by `mission.last_result`."""

    def __init__(self) -> None:
        self._results: list[Result[Any, Any]] = []
        self._before: list[int] = []
        """For each result, the number of the previous one of its mission."""

    def __len__(self) -> int:
        return len(self._results)

    def add(
        self, mission: Mission[Any], trip: Trip | None, round_: int, attempt: int, value: object
    ) -> int:
        """Store the result of an action, and return its number."""
        self._results.append(Result(mission, trip, round_, attempt, value))
        self._before.append(mission.last_result)
        return len(self._results) - 1

    @property
    def newest(self) -> object:
        """The value of the latest result."""
        return self._results[-1].value

    def so_far(self) -> View:
        """Return all results up to now."""
        return View(self._results, len(self._results))

    def for_evaluator(self, mission: Mission[Any]) -> Results[Any, Any]:
        """Return what a mission's evaluator gets now."""
        new: list[Result[Any, Any]] = []
        last, mission.last_result = mission.last_result, NO_RESULT
        while last != NO_RESULT:
            new.append(self._results[last])
            last = self._before[last]
        return Results(tuple(reversed(new)), self.so_far())
