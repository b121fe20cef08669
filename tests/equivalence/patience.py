"""Breaks a run off that goes round for ever: some graphs lead missions round without end or time."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from plutoc_runtime.flow.run import Run

AT_ONCE = 3_000
"""Calls of blocks at one instant. Four missions with patient hooks need a few hundred."""


class Spins(RuntimeError):
    """A mission goes round in its graph for ever, and no time passes."""


class Patience:
    """Counts the blocks that are called at one instant."""

    def __init__(self) -> None:
        self.now, self.calls = 0.0, 0

    def counted(self, step: Callable[..., object]) -> Callable[..., object]:
        """Return a block's step that is counted."""

        def call(run: Run[Any], *given: object, **named: object) -> object:
            now = run.core.kernel.now
            self.calls = self.calls + 1 if now == self.now else 1
            self.now = now
            if self.calls > AT_ONCE:
                raise Spins
            return step(run, *given, **named)

        return call
