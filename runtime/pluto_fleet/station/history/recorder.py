"""Recording a flight while it flies, in a thread of its own that no flight ever waits for."""

from __future__ import annotations

import queue
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from .recording import Recording, Row

LARGEST = 512 * 1024 * 1024
"""Bytes of one flight's recording: days of fifty drones."""

WAITING = 128
"""Samples that may wait for the disk, about ten seconds of them; later ones are left out."""

FLUSH_EVERY = 1.0
"""Seconds without a flush at most: as much is lost when the station is killed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Sample:
    """What is shown from one instant on, whole; it must not change afterwards."""

    t: float
    state: Row
    missions: Sequence[Row]
    drones: Sequence[Row]
    alerts: Sequence[Row] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class SaidLine:
    """A line of the console that is in no journal; `after` as many lines that are."""

    line: Row
    after: int


class Recorder:
    """Records one flight: what it is given is written by a thread, or not at all.

    No method waits or fails. A disk that is full, or gone, ends the recording, and `troubled` is
    called with a sentence, in the thread; the flight goes on.
    """

    def __init__(
        self, path: Path, *, begun_at: int, speed: float, troubled: Callable[[str], object]
    ) -> None:
        self._path, self._begun_at, self._speed = path, begun_at, speed
        self._troubled = troubled
        self._given: queue.Queue[Sample | SaidLine | None] = queue.Queue(WAITING)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._run, name="recorder", daemon=True)
        self._thread.start()

    def show(self, sample: Sample) -> None:
        """Record what is shown; without a change that costs nothing."""
        self._give(sample)

    def tell(self, line: Row, after: int) -> None:
        """Record a line of the console that is in no journal."""
        self._give(SaidLine(line=line, after=after))

    def end(self) -> None:
        """End the recording with what it has been given; whatever is given later is left out."""
        self._ended.set()
        try:
            self._given.put_nowait(None)
        except queue.Full:
            return  # the thread looks at `_ended` after each one

    def wait(self, seconds: float) -> bool:
        """Wait until all is written; return whether it is."""
        self._thread.join(seconds)
        return not self._thread.is_alive()

    def _give(self, what: Sample | SaidLine) -> None:
        if self._ended.is_set():
            return
        try:
            self._given.put_nowait(what)
        except queue.Full:
            return  # each sample is whole, so the next one says what this one would have said

    def _run(self) -> None:
        try:
            recording = Recording(
                self._path, begun_at=self._begun_at, speed=self._speed, largest=LARGEST
            )
            try:
                self._write(recording)
            finally:
                recording.finish()
        except OSError as error:
            self._ended.set()
            self._troubled(
                "this flight is not recorded any more, so its replay will have less than was seen:"
                f" {self._path}: {error.strerror or error}"
            )

    def _write(self, recording: Recording) -> None:
        """Write what is given, until the end."""
        flushed = time.monotonic()
        while not (self._ended.is_set() and self._given.empty()):
            try:
                given = self._given.get(timeout=FLUSH_EVERY)
            except queue.Empty:
                given = None
            match given:
                case SaidLine(line=line, after=after):
                    recording.tell(line, after)
                case Sample(t=t, state=state, missions=missions, drones=drones, alerts=alerts):
                    recording.write(t, state, missions, drones, alerts)
            if time.monotonic() - flushed >= FLUSH_EVERY:
                recording.flush()
                flushed = time.monotonic()
