"""Group commit: while one batch of rows is written, the next one is collected."""

from __future__ import annotations

from collections.abc import Callable
from threading import Condition, Thread
from typing import TYPE_CHECKING

from .errors import JournalError

if TYPE_CHECKING:
    from .store import Store

OnDurable = Callable[[int], object]
OnFailure = Callable[[JournalError], object]


class Writer:
    """Writes rows in a thread of its own; adding one does not wait for the disk.

    `on_durable` and `on_failure` are called in that thread. After a failure nothing is written any
    more, and no further row is reported as durable.
    """

    def __init__(self, store: Store, on_durable: OnDurable, on_failure: OnFailure) -> None:
        self._store, self._on_durable, self._on_failure = store, on_durable, on_failure
        self._changed = Condition()
        self._rows: list[str] = []
        self._snapshot: tuple[int, str] | None = None
        self._added = self._durable = store.seq
        self._over = False
        self._thread = Thread(target=self._work, name="journal", daemon=True)
        self._thread.start()

    def add(self, row: str) -> int:
        """Add a row and return its number; it is durable once `on_durable` was called with that number."""
        with self._changed:
            self._rows.append(row)
            self._added += 1
            if len(self._rows) == 1:
                self._changed.notify_all()
            return self._added

    def snapshot(self, state: str) -> None:
        """Store a snapshot of the rows added so far; of several pending ones only the last."""
        with self._changed:
            self._snapshot = self._added, state
            self._changed.notify_all()

    def flush(self) -> None:
        """Wait until all added rows are durable; raise a `JournalError` if that fails."""
        with self._changed:
            number = self._added
            while self._snapshot is not None or self._durable < number:
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
                while not (self._rows or self._snapshot or self._over):
                    changed.wait()
                rows, self._rows = self._rows, []
                snapshot = self._snapshot
                over = self._over and not rows and snapshot is None
            if over:
                return
            try:
                self._write(rows, snapshot)
            except JournalError as failure:
                with changed:
                    changed.notify_all()
                self._on_failure(failure)
                return
            with changed:
                self._durable += len(rows)
                if self._snapshot is snapshot:
                    self._snapshot = None
                changed.notify_all()
            if rows:
                self._on_durable(self._durable)

    def _write(self, rows: list[str], snapshot: tuple[int, str] | None) -> None:
        if snapshot is None:
            self._store.append(rows)
            return
        number, state = snapshot
        before = number - self._durable
        if before:
            self._store.append(rows[:before])
        self._store.snapshot(state)
        if rows[before:]:
            self._store.append(rows[before:])
