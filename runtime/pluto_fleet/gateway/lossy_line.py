"""A simulated line to the brain that delays reports, or breaks."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from ..shared.time.kernel import FLEET, EventKind

if TYPE_CHECKING:
    from .gateway import Gateway, Line
    from .jobs import Report

LOST = -1.0
"""The delay of a report that is lost."""


class LossyLine:
    """To be set as a gateway's `line`.

    `delay` returns the seconds that a report takes, or `LOST`: then the line breaks, as a real one
    would, and the link is cut. The gateway still knows what was not delivered.
    """

    def __init__(self, gateway: Gateway, delay: Callable[[], float]) -> None:
        self._gateway, self._delay = gateway, delay
        self.late = self.lost = 0
        """How many reports were delayed, and how many were lost."""

    def __call__(self, report: Report) -> Report:
        """Wrap a listener, so that it is called through this line."""
        return partial(self._carry, report)

    def _carry(self, report: Report, result: object) -> None:
        seconds = self._delay()
        if seconds < 0:
            self.lost += 1
            self._gateway.cut()
        elif seconds > 0:
            self.late += 1
            kernel, line = self._gateway.kernel, self._gateway.commander
            arrives = partial(self._arrive, line, report, result)
            kernel.schedule(kernel.now + seconds, EventKind.FLIGHT, FLEET, arrives)
        else:
            report(result)

    def _arrive(self, line: Line | None, report: Report, result: object) -> None:
        if line is not None and self._gateway.is_commanded_by(line):
            report(result)
