"""What an evaluator says of a mission."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .model import Trip


@dataclass(frozen=True, slots=True, kw_only=True)
class Verdict:
    """An evaluator's judgement. It never sets a status: the runtime does, from this."""

    ok: bool = True
    """False with nothing to redo and nothing to add: the mission has FAILED."""
    redo: tuple[Trip, ...] = ()
    """Completed trips of this mission that must be flown again."""
    add: tuple[Trip, ...] = ()
    """New trips for this mission; they are not repeated by a later round."""
    log: tuple[str, ...] = ()
    """Lines for the console."""
    fail: str | None = None
    """The mission has FAILED, and this is why."""
