"""A kernel within a kernel that can be killed: the brain dies, the drones and their gateway live on."""

from __future__ import annotations

from collections.abc import Callable, Coroutine, Sequence
from typing import Any, TypeVar

from pluto_fleet.shared.time.kernel import Call, EventKind, Kernel, Key, Task, Timer

T = TypeVar("T")


class Mortal(Kernel):
    """Runs everything on its host, at its host's time and in its order, until it is killed."""

    def __init__(self, host: Kernel) -> None:
        # nothing of a kernel's own is needed: everything is the host's
        self._host, self._mine = host, dict[Task[Any], None]()
        self.alive = True
        self.settled: Callable[[], object] | None = None
        host.settled = self._settle

    def kill(self) -> None:
        """Let nothing of it run on, as when a process is killed; not from one of its own events."""
        self.alive = False
        self._host.settled = None
        for task in self._mine:
            if not task.is_set:
                task.drop()
        self._mine.clear()

    def _settle(self) -> None:
        if self.alive and self.settled is not None:
            self.settled()

    @property
    def now(self) -> float:
        """The host's time."""
        return self._host.now

    @now.setter
    def now(self, _: float) -> None:
        raise AttributeError("time is the host's")

    @property
    def at_the_end(self) -> Callable[[], object] | None:
        """What is called when all else of this instant is done."""
        return self._host.at_the_end

    @at_the_end.setter
    def at_the_end(self, call: Callable[[], object] | None) -> None:
        self._host.at_the_end = None if call is None else self._while_alive(call)

    def time(self) -> float:
        """Return the host's time."""
        return self._host.time()

    def at(self, when: float, kind: EventKind, key: Key, call: Call) -> Timer:
        """Call this at a time, unless it is cancelled, or the kernel killed."""
        return self._host.at(when, kind, key, self._while_alive(call))

    def schedule(self, when: float, kind: EventKind, key: Key, call: Call) -> None:
        """Call this at a time, unless the kernel is killed."""
        self._host.schedule(when, kind, key, self._while_alive(call))

    def spawn(self, coroutine: Coroutine[Any, Any, T], key: Key, name: str) -> Task[T]:
        """Set a coroutine on its way."""
        task = self._host.spawn(coroutine, key, name)
        self._mine[task] = None
        if len(self._mine) > 2 * len(self._host.tasks) + 100:
            self._mine = {task: None for task in self._mine if not task.is_set}
        return task

    def under_way(self) -> Sequence[Task[Any]]:
        """Return its own coroutines that have not ended."""
        return [task for task in self._mine if not task.is_set]

    def crash(self, error: BaseException) -> None:
        """An error that no coroutine caught stops the host as well: it is a mistake of ours."""
        self._host.crash(error)

    def _while_alive(self, call: Callable[[], object]) -> Call:
        def called() -> None:
            if self.alive:
                call()

        return called
