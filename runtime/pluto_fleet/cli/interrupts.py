"""Ctrl-C and `kill` while drones fly: the first lands them, the second ends the app at once.

Processes forked by hooks do not inherit these handlers: else ending such a child would land the
fleet.
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

from ..flight.offline import leave_stop
from ..gateway.starting import stop_directly
from ..jobs.reports import Down
from ..journal.place import gateway_folder
from ..process.forked import in_children, leave
from ..shared import output
from ..shared.domain.errors import BadInput

STOP_DIRECTLY_AFTER = 1.0
"""Seconds that the app may take to stop its drones, before the gateway is told directly."""


class Stoppable(Protocol):
    """A flight that can be stopped."""

    asked: Down | None
    """How to bring the drones down, once a stop was requested."""

    def stop(self, how: Down) -> None:
        """Bring all drones down; called in the loop's thread."""
        ...


class Interrupts:
    """Handles the signals that ask the app to end."""

    def __init__(
        self,
        stops: Stoppable,
        journal: Callable[[], Path | None],
        how_to_go_on: str,
        last: Callable[[], object] = lambda: None,
    ) -> None:
        """`journal` returns the one that is being written; None: nothing flies.

        `last` is called before the app exits at once.
        """
        self.code: int | None = None
        """The exit code for the signal that has interrupted it."""
        self.loop: asyncio.AbstractEventLoop | None = None
        self._stops, self._journal, self._how = stops, journal, how_to_go_on
        self._heard, self._last = False, last
        self._process = os.getpid()

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Handle signals within this context."""
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
        if os.getpid() != self._process:  # a forked child that has not reset its handlers yet
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
        """Stop the drones by the gateway: a hook blocks the app."""
        if not self._heard:
            journal = self._journal()
            with suppress(BadInput):
                if journal is None:
                    return
                stop_directly(gateway_folder(journal), Down.LAND, STOP_DIRECTLY_AFTER)
                output.tell("the app is busy: the gateway lands the drones without it")
