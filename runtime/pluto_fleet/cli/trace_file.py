"""The file of `--trace`: every event, whole or not at all."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import BadInput

from ..journal.event_line import line

if TYPE_CHECKING:
    from plutoc_runtime.domain.trace import Event


@contextmanager
def trace_file(path: Path | None) -> Iterator[Callable[[Event], None]]:
    """Give a function that keeps an event; the file gets its name once everything is in it."""
    if path is None:
        yield _forget
        return
    trace = _Trace(path)
    try:
        yield trace.write
        trace.finish()
    finally:
        trace.drop()


def _forget(event: Event) -> None:
    pass


class _Trace:
    """A trace on its way into a file."""

    def __init__(self, path: Path) -> None:
        self._path = path
        try:
            self._whole = Path(os.path.realpath(path))  # a link stays a link
            if path.is_dir():
                raise IsADirectoryError(0, "it is a folder")
            # a pipe or a device cannot be replaced: it is written to as it is
            replaceable = path.is_file() or not path.exists()
            part = self._whole.with_name(f".{self._whole.name}.{os.getpid()}.part")
            self._part = part if replaceable else None
            self._file = (self._part or path).open("w", encoding="utf-8")
        except (OSError, ValueError) as error:  # ValueError: a NUL in the name
            raise self._failed(error) from None

    def write(self, event: Event) -> None:
        """Write an event as one line."""
        try:
            self._file.write(line(event) + "\n")
        except OSError as error:
            raise self._failed(error) from None

    def finish(self) -> None:
        """Everything is written: now the file may be seen."""
        try:
            self._file.close()
            if self._part is not None:
                self._part.replace(self._whole)
        except OSError as error:
            raise self._failed(error) from None

    def drop(self) -> None:
        """Leave nothing half-written behind; there is nothing left after `finish`."""
        with suppress(OSError):
            self._file.close()
        if self._part is not None:
            self._part.unlink(missing_ok=True)

    def _failed(self, error: Exception) -> BadInput:
        why = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
        return BadInput(f"{self._path}: the trace cannot be written: {why}")
