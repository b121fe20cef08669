"""The verdict of an evaluator on a mission."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from ..domain.model import Trip


class Verdict(NamedTuple):
    """An evaluator's verdict; the runtime sets the mission's status from it."""

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
        """Whether there is nothing to fly and nothing to log: by far the most frequent case."""
        return self.redo is _NOTHING and self.add is _NOTHING and self.log is _NOTHING


_NOTHING = ()
