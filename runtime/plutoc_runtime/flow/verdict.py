"""What an evaluator says of a mission."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from ..domain.model import Trip


class Verdict(NamedTuple):
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

    @property
    def asks_nothing(self) -> bool:
        """Whether there is nothing to fly and nothing to write: by far the most frequent."""
        return self.redo is _NOTHING and self.add is _NOTHING and self.log is _NOTHING


_NOTHING = ()
