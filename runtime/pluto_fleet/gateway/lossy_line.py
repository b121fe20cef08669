"""A line to the brain on which reports come late, or break it: for simulations."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from plutoc_runtime.time.kernel import FLEET, EventKind

if TYPE_CHECKING:
    from ..jobs.job import Report
    from .gateway import Gateway, Link

LOST = -1.0
"""The fate of a report that never arrives."""


class LossyLine:
    """Give it to a gateway as its `line`.

    `delay` says of each report how many seconds it takes, or that it is `LOST`: then the line is
    broken, as a real one would be, and the link is cut. What was not heard is known to the gateway.
    """

    def __init__(self, gateway: Gateway, delay: Callable[[], float]) -> None:
        self._gateway, self._delay = gateway, delay
        self.late = self.lost = 0
        """How many reports were late, and how many got lost."""

    def __call__(self, report: Report) -> Report:
        """Return a listener that hears over this line, for another."""
        return partial(self._carry, report)

    def _carry(self, report: Report, result: object) -> None:
        seconds = self._delay()
        if seconds < 0:
            self.lost += 1
            self._gateway.cut()
        elif seconds > 0:
            self.late += 1
            kernel, link = self._gateway.kernel, self._gateway.commander
            arrives = partial(self._arrive, link, report, result)
            kernel.schedule(kernel.now + seconds, EventKind.FLIGHT, FLEET, arrives)
        else:
            report(result)

    def _arrive(self, link: Link | None, report: Report, result: object) -> None:
        if link is not None and self._gateway.is_commanded_by(link):
            report(result)
