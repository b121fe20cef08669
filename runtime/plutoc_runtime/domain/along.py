"""What is done on the way, from a trip's launch to the end of its last leg."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from .actions import Plain
from .fields import Field


@dataclass(frozen=True, slots=True, kw_only=True)
class Along:
    """An action on the way: one of the app's own once, a built-in one every so often."""

    action: str
    parameters: Mapping[str, Plain] = field(default_factory=dict)
    metres: float | None = None
    seconds: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class AlongField(Field):
    """The trip's field that says what is done on the way."""

    actions: tuple[str, ...]
    """Those that can be."""
