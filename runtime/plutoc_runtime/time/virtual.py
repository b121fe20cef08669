"""Virtual time: the clock jumps to the next event, so a day is simulated in a moment."""

from __future__ import annotations

from typing import TypeVar

from .future import Future
from .told import Stuck, ToldTime

T = TypeVar("T")


class VirtualTime(ToldTime):
    """A kernel that runs by itself."""

    def run(self, done: Future[T], until: float | None = None) -> bool:
        """Run until this future is set, or until a time; return whether it was set."""
        done.watch(self._stop)
        while not done.is_set and self.crashed is None:
            self.over = False
            when = self.next_time()
            if when is None:
                waiting = ", ".join(sorted(task.name for task in self.tasks))
                raise Stuck(f"nothing will ever happen again; waiting: {waiting}")
            if until is not None and when > until:
                self.now = until
                return False
            self.now = when
            self.drain()
            if self.settled is not None:
                self.settled()
        if self.crashed is not None:
            raise self.crashed
        return True

    def _stop(self, _: object) -> None:
        self.over = True
