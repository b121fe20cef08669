"""The central store of what actions gave (thesis 6.1.3): append-only, across missions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from struct import Struct
from typing import Any, Generic, NamedTuple, TypeVar, overload

from .model import NO_RESULT, Mission, Trip

M = TypeVar("M", bound=Mission[Any])
T = TypeVar("T", bound=Trip)


class Result(NamedTuple, Generic[M, T]):
    """What one action gave; (mission, trip, round, attempt) tells it from all others."""

    mission: M
    trip: T
    round: int
    attempt: int
    value: object


_COUNTS = Struct("3i")
"""Of a result its round, its attempt, and the number of the mission's result before it."""

_pack, _unpack, _SIZE = _COUNTS.pack, _COUNTS.unpack_from, _COUNTS.size

_BLOCK = 1024
"""So many results are kept together: nothing is ever moved to where there is more room."""


class View(Sequence[Result[Any, Any]]):
    """Some of the results, by their numbers; made only for whoever looks at them."""

    __slots__ = ("_numbers", "_store")

    def __init__(self, store: ResultStore, numbers: Sequence[int]) -> None:
        self._store, self._numbers = store, numbers

    def __len__(self) -> int:
        return len(self._numbers)

    @overload
    def __getitem__(self, index: int) -> Result[Any, Any]: ...
    @overload
    def __getitem__(self, index: slice) -> Sequence[Result[Any, Any]]: ...
    def __getitem__(self, index: int | slice) -> Result[Any, Any] | Sequence[Result[Any, Any]]:
        if isinstance(index, slice):
            return tuple(map(self._store.result, self._numbers[index]))
        return self._store.result(self._numbers[index])  # an IndexError is its own

    def __iter__(self) -> Iterator[Result[Any, Any]]:
        return map(self._store.result, self._numbers)

    def __repr__(self) -> str:
        return repr(tuple(self))


class Results(NamedTuple, Generic[M, T]):
    """What an evaluator gets to judge."""

    new: Sequence[Result[M, T]]
    """The mission's results since its evaluator was last asked."""
    all: Sequence[Result[M, T]]
    """Every result of the app, of all missions."""


class ResultStore:
    """Where results are kept.

    Most are never looked at again, and there may be millions: so they are kept as the plain values
    of their fields, and made into results for whoever looks. Those of one mission are a chain that
    `mission.last_result` begins.
    """

    def __init__(self) -> None:
        self._things: list[Any] = []
        """Mission, trip and value of each."""
        self._counts = bytearray()
        """The counts of each."""
        self._blocks: list[tuple[Sequence[Any], bytes | bytearray]] = [(self._things, self._counts)]
        """All of them; the last one is filled."""
        self._count, self._room = 0, _BLOCK

    def __len__(self) -> int:
        return self._count

    def add(
        self, mission: Mission[Any], trip: Trip | None, round_: int, attempt: int, value: object
    ) -> int:
        """Keep what an action gave, and return its number."""
        number = self._count
        if number == self._room:
            self._new_block()
        self._count = number + 1
        self._things += (mission, trip, value)
        self._counts += _pack(round_, attempt, mission.last_result)
        return number

    def _new_block(self) -> None:
        self._blocks[-1] = tuple(self._things), bytes(self._counts)  # nothing more comes to them
        self._things, self._counts = [], bytearray()
        self._blocks.append((self._things, self._counts))
        self._room += _BLOCK

    def result(self, number: int) -> Result[Any, Any]:
        """Return the result with this number."""
        (things, counts), place = self._blocks[number // _BLOCK], number % _BLOCK
        mission, trip, value = things[3 * place : 3 * place + 3]
        round_, attempt, _ = _unpack(counts, place * _SIZE)
        return Result(mission, trip, round_, attempt, value)

    @property
    def newest(self) -> object:
        """What the action gave that was done last."""
        return self.result(self._count - 1).value

    def so_far(self) -> View:
        """Return every result there is by now."""
        return View(self, range(self._count))

    def for_evaluator(self, mission: Mission[Any]) -> Results[Any, Any]:
        """Return what a mission's evaluator gets now."""
        new: list[int] = []
        blocks, last, mission.last_result = self._blocks, mission.last_result, NO_RESULT
        while last != NO_RESULT:
            new.append(last)
            last = _unpack(blocks[last // _BLOCK][1], last % _BLOCK * _SIZE)[2]
        new.reverse()
        return Results(View(self, new), self.so_far())
