"""A value or an error that is set once, and what waits for it."""

from __future__ import annotations

from collections.abc import Callable, Generator
from typing import Any, Generic, TypeVar, cast

T = TypeVar("T")

Watcher = Callable[[Any], object]  # called with the future when it is set


class Future(Generic[T]):
    """A value that is set once; any number of coroutines may await it."""

    __slots__ = ("_value", "_watchers", "error", "is_set")

    def __init__(self) -> None:
        self.is_set = False
        self.error: BaseException | None = None
        self._value: Any = None
        self._watchers: list[Watcher] | None = None
        """Those that wait, in their order; most futures never have any."""

    def set(self, value: T) -> None:
        """Set the value; only the first call counts."""
        if self.is_set:
            return
        self.is_set = True
        self._value = value
        watchers = self._watchers
        if watchers is not None:
            self._watchers = None
            for watcher in watchers:
                watcher(self)

    def fail(self, error: BaseException) -> None:
        """Set an error, which is raised wherever it is awaited; only the first call counts."""
        if not self.is_set:
            self.error = error
            self.set(cast("T", None))

    def watch(self, watcher: Watcher) -> None:
        """Call this with the future when it is set; at once if it is."""
        if self.is_set:
            watcher(self)
        elif self._watchers is None:
            self._watchers = [watcher]
        else:
            self._watchers.append(watcher)

    def unwatch(self, watcher: Watcher) -> None:
        """Remove a watcher; one that is not there is ignored."""
        if self._watchers is not None and watcher in self._watchers:
            self._watchers.remove(watcher)

    def result(self) -> T:
        """Return the value, or raise the error; only once it is set."""
        if self.error is not None:
            raise self.error
        value: T = self._value
        return value

    def __await__(self) -> Generator[Future[Any], None, T]:
        if not self.is_set:
            yield self
        if self.error is not None:
            raise self.error
        value: T = self._value
        return value
