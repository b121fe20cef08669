"""Results of an app whose own actions all declare what they give: for type checkers alone.

An app's evaluators get a `Result` and `Results` of domain/model.py, which have the same parts.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Generic, NamedTuple, TypeVar

from ..domain.model import Mission, Trip

M = TypeVar("M", bound=Mission[Any])
T = TypeVar("T", bound=Trip)
V = TypeVar("V")


class TypedResult(NamedTuple, Generic[M, T, V]):
    """The result of one action, identified by (mission, trip, round, attempt)."""

    mission: M
    trip: T
    round: int
    attempt: int
    value: V


class TypedResults(NamedTuple, Generic[M, T, V]):
    """The results that an evaluator gets."""

    new: Sequence[TypedResult[M, T, V]]
    """The mission's results since its last evaluation."""
    all: Sequence[TypedResult[M, T, V]]
    """The results of all missions."""
