"""Group commit: while one batch of entries is written, the next one is collected."""

from __future__ import annotations

from collections.abc import Callable
from threading import Condition, Thread
from typing import TYPE_CHECKING

from .errors import JournalError

if TYPE_CHECKING:
    from .store import Entry, Store

OnDurable = Callable[[int], object]
OnFailure = Callable[[JournalError], object]


class Writer:
    """Writes entries in a thread of its own; adding one does not wait for the disk.

    `on_durable` and `on_failure` are called in that thread. After a failure nothing is written any
    more, and no further entry is reported as durable.
    """

    def __init__(self, store: Store, on_durable: OnDurable, on_failure: OnFailure) -> None:
        self._store, self._on_durable, self._on_failure = store, on_durable, on_failure
        self._changed = Condition()
        self._entries: list[Entry] = []
        self._added = self._durable = store.seq
        self._over = False
        self._thread = Thread(target=self._work, name="journal", daemon=True)
        self._thread.start()

    def add(self, entry: Entry) -> int:
        """Add an entry and return its number; it is durable once `on_durable` was called with that number."""
        with self._changed:
            self._entries.append(entry)
            self._added += 1
            if len(self._entries) == 1:
                self._changed.notify_all()
            return self._added

    def flush(self) -> None:
        """Wait until all added rows are durable; raise a `JournalError` if that fails."""
        with self._changed:
            number = self._added
            while self._durable < number:
                if self._store.failure is not None:
                    raise self._store.failure
                self._changed.wait()

    def close(self) -> None:
        """Write the rest, and end the thread; the store stays open."""
        with self._changed:
            self._over = True
            self._changed.notify_all()
        self._thread.join()

    def _work(self) -> None:
        changed = self._changed
        while True:
            with changed:
                while not (self._entries or self._over):
                    changed.wait()
                entries = self._entries
                self._entries = []
                over = self._over and not entries
            if over:
                return
            try:
                self._store.append(entries)
            except JournalError as failure:
                with changed:
                    changed.notify_all()
                self._on_failure(failure)
                return
            with changed:
                self._durable += len(entries)
                changed.notify_all()
            self._on_durable(self._durable)
