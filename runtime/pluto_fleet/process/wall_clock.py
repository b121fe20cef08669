"""The computer's clock, beside the time of a flight: it says which hour it is, and may be set."""

from __future__ import annotations

import asyncio
from collections.abc import Mapping
from time import time as now
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .realtime import RealTime

_LEAST = 0.05
"""Seconds: clocks that differ by less are the same."""


class WallClock:
    """How far the computer's clock has drifted from a flight's time since the flight first began.

    It drifts when it is set, and when the computer sleeps, in which no time passes for the flight.
    """

    def __init__(self, kernel: RealTime, known: Mapping[str, float | None]) -> None:
        """`known` from earlier runs: when the flight first `began`, in seconds since 1970, and the `drift`."""
        began = known["began"]
        self.drift = known["drift"] or 0.0
        self.began = now() - kernel.time() if began is None else began
        if began is not None and kernel.speed == 1.0:
            self.drift = now() - began - kernel.time()
        self._ahead = self._measured() - self.drift

    @property
    def data(self) -> Mapping[str, object]:
        """What a brain, and a journal, must know of it."""
        return {"began": self.began, "drift": self.drift, "zone": ""}

    def moved(self) -> bool:
        """Take over how it stands; return whether it has moved since it was asked last."""
        drift = self._measured() - self._ahead
        if abs(drift - self.drift) < _LEAST:
            return False
        self.drift = drift
        return True

    def _measured(self) -> float:
        return now() - asyncio.get_running_loop().time()
