"""The central store of what actions gave (thesis 6.1.3): append-only, across missions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from .model import Mission, Trip

M = TypeVar("M", bound=Mission[Any])
T = TypeVar("T", bound=Trip)


@dataclass(frozen=True, slots=True, kw_only=True)
class Result(Generic[M, T]):
    """What one action gave; (mission, trip, round, attempt) tells it from all others."""

    mission: M
    trip: T
    round: int
    attempt: int
    value: object


@dataclass(frozen=True, slots=True, kw_only=True)
class Results(Generic[M, T]):
    """What an evaluator gets to judge."""

    new: tuple[Result[M, T], ...]
    """The mission's results since its evaluator was last asked."""
    all: tuple[Result[M, T], ...]
    """Every result of the app, of all missions."""


class ResultStore:
    """Where results are kept."""

    def __init__(self) -> None:
        self.results: list[Result[Any, Any]] = []
        self._judged: dict[Mission[Any], int] = {}

    def add(self, mission: Mission[Any], trip: Trip, value: object) -> None:
        """Keep what the trip's action gave."""
        self.results.append(
            Result(
                mission=mission,
                trip=trip,
                round=mission.round,
                attempt=trip.attempt,
                value=value,
            )
        )

    def for_evaluator(self, mission: Mission[Any]) -> Results[Any, Any]:
        """Return what a mission's evaluator gets now."""
        since = self._judged.get(mission, 0)
        self._judged[mission] = len(self.results)
        new = tuple(result for result in self.results[since:] if result.mission is mission)
        return Results(new=new, all=tuple(self.results))
