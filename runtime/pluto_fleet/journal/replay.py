"""From a journal to its records: what another life of the app begins with."""

from __future__ import annotations

import gc
import json
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from .fold import Records

if TYPE_CHECKING:
    from plutoc_runtime.domain.trace import Event

    from .reading import Read


def replayed(read: Read, header: Event | None = None) -> Records:
    """Return what a journal comes to: its header, or a snapshot, and what has happened since.

    Ask afterwards whether `read` was damaged: then it is what was so far.
    """
    with _without_collections():
        records = Records(None if read.snapshot is None else json.loads(read.snapshot))
        if read.snapshot is None and header is not None:
            records.take(header)
        take = records.take
        for event in read.events:
            take(event)
    return records


@contextmanager
def _without_collections() -> Iterator[None]:
    """Let the garbage collector rest: plain data has no cycles, and it would look at all of it."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()
