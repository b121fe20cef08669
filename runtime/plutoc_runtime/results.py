"""The central store of what actions gave (thesis 6.1.3): append-only, across missions."""

from __future__ import annotations

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
_STEP = _WIDTH + 1
"""Behind the values of a result stands where the mission's result before it begins."""


class View(Sequence[Result[Any, Any]]):
    """Some of the results, by where their values begin; made only for whoever looks at them."""

    __slots__ = ("_starts", "_values")

    def __init__(self, values: list[Any], starts: Sequence[int]) -> None:
        self._values, self._starts = values, starts

    def __len__(self) -> int:
        return len(self._starts)

    @overload
    def __getitem__(self, index: int) -> Result[Any, Any]: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Result[Any, Any]]: ...
    def __getitem__(self, index: int | slice) -> Result[Any, Any] | Sequence[Result[Any, Any]]:
        if isinstance(index, slice):
            return tuple(map(self._at, self._starts[index]))
        return self._at(self._starts[index])  # an IndexError is its own

    def __iter__(self) -> Iterator[Result[Any, Any]]:
        return map(self._at, self._starts)

    def __repr__(self) -> str:
        return repr(tuple(self))

    def _at(self, start: int) -> Result[Any, Any]:
        return Result(*self._values[start : start + _WIDTH])


class Results(NamedTuple, Generic[M, T]):
    """What an evaluator gets to judge."""

    new: Sequence[Result[M, T]]
    """The mission's results since its evaluator was last asked."""
    all: Sequence[Result[M, T]]
    """Every result of the app, of all missions."""


class ResultStore:
    """Where results are kept.

    Most are never looked at again, and there may be millions: so they are kept as the plain values
    of their fields, one result behind the other, and made into results for whoever looks. Those of
    one mission are a chain that `mission.last_result` begins.
    """

    def __init__(self) -> None:
        self.values: list[Any] = []

    @property
    def newest(self) -> object:
        """What the action gave that was done last."""
        return self.values[-2]

    def so_far(self) -> View:
        """Return every result there is by now."""
        return View(self.values, range(0, len(self.values), _STEP))

    def for_evaluator(self, mission: Mission[Any]) -> Results[Any, Any]:
        """Return what a mission's evaluator gets now."""
        new: list[int] = []
        while mission.last_result is not None:
            new.append(mission.last_result)
            mission.last_result = self.values[mission.last_result + _WIDTH]
        return Results(View(self.values, new[::-1]), self.so_far())
