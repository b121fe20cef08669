"""Fields of missions and trips that exist because a block of the graph, or the app, needs them."""

from __future__ import annotations

import re
from collections.abc import Container, Iterable
from dataclasses import dataclass
from datetime import time
from enum import Enum

from .plain import number_of, plain_of
from .quantities import Type
from .text import bounded, shown


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
    ALONG = "along"  # an action on the way


@dataclass(frozen=True, slots=True, kw_only=True)
class Field:
    """A field that the user of an app fills in."""

    name: str
    on: Entity
    type: FieldType | Type
    label: str  # its label on a screen
    doc: str = ""
    """A sentence for pages. In a generated package it stands beside the attribute instead."""
    default: int | float | str | None = None
    hint: str = ""  # what to write, of a field that must be filled in

    def wanted(self, value: object, evaluators: Container[str]) -> str:
        """Return what a value must be that a hook has set, if it is not that."""
        plain = plain_of(value)
        is_left_out = value is None and self.default is None
        if is_left_out or (type(plain) is bool and self.type is FieldType.ROUNDS):
            return ""
        if self.type is FieldType.EVALUATOR:
            is_right = type(plain) is str and plain in evaluators
            return "" if is_right else "an evaluator's name"
        return "" if number_of(value) is not None else "a number"

    def kept(self, value: object) -> object:
        """Return a value as it is kept that a hook has set: as plain data."""
        return plain_of(value)


def wrong_field(
    fields: Iterable[Field], entity: Entity, of: object, evaluators: Container[str]
) -> str | None:
    """Return what is wrong with a field that a hook has set, or None.

    A number, a truth or a text of another library becomes a plain one there.
    """
    for field in fields:
        if field.on is not entity:
            continue
        value = getattr(of, field.name, None)
        if wanted := field.wanted(value, evaluators):
            there = bounded(shown(value), _LONGEST)
            return f"{field.name} must be {wanted}, and a hook has put {there} there"
        put_plain(of, field.name, value)
    return None


def put_plain(of: object, name: str, value: object) -> None:
    """Put a plain number, truth or text in the place of another library's, if it is one."""
    plain = plain_of(value)
    if plain is not None and type(plain) is not type(value):
        setattr(of, name, plain)


def time_of_day(value: object) -> float:
    """Read "08:00", or TOML's own 08:00:00, as seconds since midnight."""
    written = f"{value:%H:%M:%S}" if isinstance(value, time) else value
    match = _TIME_OF_DAY.fullmatch(written) if isinstance(written, str) else None
    if match is None:
        raise ValueError('is not a time of day: write it like "08:00"')
    return int(match[1]) * 3600.0 + int(match[2]) * 60.0 + int(match[3] or 0)


_LONGEST = 100
_TIME_OF_DAY = re.compile(r"([01]?\d|2[0-3]):([0-5]\d)(?::([0-5]\d))?")
