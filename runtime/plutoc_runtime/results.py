"""The central store of what actions gave (thesis 6.1.3): append-only, across missions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from .model import Mission, Trip


@dataclass(frozen=True, slots=True, kw_only=True)
class Result:
    """What one action gave; (mission, trip, round, attempt) tells it from all others."""

    mission: Mission[Any]
    trip: Trip
    round: int
    attempt: int
    value: object


@dataclass(frozen=True, slots=True, kw_only=True)
class Results:
    """What an evaluator gets to judge."""

    new: tuple[Result, ...]
    """The mission's results since its evaluator was last asked."""
    all: tuple[Result, ...]
    """Every result of the app, of all missions."""


class ResultStore:
    """Where results are kept."""

    def __init__(self) -> None:
        self.results: list[Result] = []
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

    def for_evaluator(self, mission: Mission[Any]) -> Results:
        """Return what a mission's evaluator gets now."""
        since = self._judged.get(mission, 0)
        self._judged[mission] = len(self.results)
        new = tuple(result for result in self.results[since:] if result.mission is mission)
        return Results(new=new, all=tuple(self.results))
