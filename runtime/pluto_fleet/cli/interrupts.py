"""Ctrl-C and `kill` while drones fly: the first time they land, the second time the app is gone.

They are told to the app and not to the processes that its hooks fork: a copy of the app's handlers
would land the fleet when such a child is ended.
"""

from __future__ import annotations

import asyncio
import os
import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from threading import Timer
from types import FrameType
from typing import Protocol

from plutoc_runtime import output
from plutoc_runtime.domain.errors import BadInput

from ..flight.offline import leave_stop
from ..gateway.starting import stop_directly
from ..jobs.reports import Down
from ..journal.place import gateway_folder
from ..process.forked import in_children, leave

STOP_DIRECTLY_AFTER = 1.0
"""Seconds that the app may take to stop its drones, before they are told without it."""


class Stoppable(Protocol):
    """What can be brought to its end."""

    asked: Down | None
    """How, once that was asked for."""

    def stop(self, how: Down) -> None:
        """Bring all drones down; called in the loop's thread."""
        ...


class Interrupts:
    """The signals that ask the app to end, and whether it has heard."""

    def __init__(
        self,
        stops: Stoppable,
        journal: Callable[[], Path | None],
        how_to_go_on: str,
        last: Callable[[], object] = lambda: None,
    ) -> None:
        """Begin; `journal` says which one is being written then; None: nothing flies.

        `last` is called before the app leaves at once.
        """
        self.code: int | None = None
        """The exit code of what has interrupted it."""
        self.loop: asyncio.AbstractEventLoop | None = None
        self._stops, self._journal, self._how = stops, journal, how_to_go_on
        self._heard, self._last = False, last
        self._process = os.getpid()

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Hear signals for as long as this lasts."""
        before: dict[int, Callable[[int, FrameType | None], object] | int | None] = {}
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with suppress(ValueError):  # not in the main thread
                if signal.getsignal(number) is not signal.SIG_IGN:  # as with nohup
                    before[number] = signal.signal(number, self._told)

        def as_before() -> None:
            for changed, handler in before.items():
                signal.signal(changed, handler)

        no_more = in_children(as_before)
        try:
            yield
        finally:
            no_more()
            as_before()

    def _told(self, number: int, _: FrameType | None) -> None:
        if os.getpid() != self._process:  # a child, in the moment before it has let go of this
            signal.signal(number, signal.SIG_DFL)
            os.kill(os.getpid(), number)
            return
        if self.code is not None:
            journal = self._journal()
            if journal is not None:
                leave_stop(journal, Down.LAND)  # for a supervisor that starts crashed apps again
                output.tell(f"leaving at once: the gateway lands the drones; {self._how}")
            self._last()
            leave(128 + number)
        self.code = 128 + number
        if self._journal() is not None:
            output.tell("stopping: the drones land where they are (once more to leave at once)")
        self._stops.asked = Down.LAND
        if self.loop is not None:
            self.loop.call_soon_threadsafe(self._stop)
            late = Timer(STOP_DIRECTLY_AFTER, self._go_past)
            late.daemon = True
            late.start()

    def _stop(self) -> None:
        self._heard = True
        self._stops.stop(Down.LAND)

    def _go_past(self) -> None:
        """A hook keeps the app from hearing: tell the drones without it."""
        if not self._heard:
            journal = self._journal()
            with suppress(BadInput):
                if journal is None:
                    return
                stop_directly(gateway_folder(journal), Down.LAND, STOP_DIRECTLY_AFTER)
                output.tell("the app is busy: the gateway lands the drones without it")
