"""Fields of missions and trips that exist only because a block of the graph needs them."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Entity(Enum):
    """What a field belongs to."""

    MISSION = "mission"
    TRIP = "trip"


class FieldType(Enum):
    """What a field holds, and how a plan file writes it."""

    TIME = "time"  # seconds, or "3 min"
    INT = "int"
    ROUNDS = "rounds"  # how many more; true = until stopped
    TIME_OF_DAY = "time of day"  # "08:00"; inside, seconds since midnight
    EVALUATOR = "evaluator"  # the name of one of the app's evaluators


PYTHON: dict[FieldType, str] = {
    FieldType.TIME: "float | None",
    FieldType.INT: "int",
    FieldType.ROUNDS: "int | bool",
    FieldType.TIME_OF_DAY: "float | None",
    FieldType.EVALUATOR: "str | None",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Field:
    """A field that the user of an app fills in."""

    name: str
    on: Entity
    type: FieldType
    label: str
    """As a screen asks for it."""
    doc: str = ""
    """A sentence for pages. In a generated package it stands beside the attribute instead."""
    default: int | float | None = None
