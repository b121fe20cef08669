"""The charge of a drone's battery by its voltage, for drones that tell no more than that.

Under load the voltage of a battery drops by some tenths of a volt a cell, which at rest would mean much less
charge. The level follows from the voltage at rest; in the air the drop is added, which is measured anew at
each take-off, as batteries age.
"""

from __future__ import annotations

from math import ceil
from statistics import fmean

from ..lithium import SAG, level_at

_LEAST = 0.05
_MOST = 0.6
"""The bounds of the voltage drop of hovering, which is the usual one until it is measured."""
_SETTLED = 1.0
_MEASURED = 3.0
"""Seconds after take-off, between which the drop is measured."""
_SMOOTH = 1.0
"""Seconds over which the voltage in the air is averaged."""
LOW = 3.2
"""Volts of a cell in the air at which it must come down. At 3.0 some builds switch off."""
FULLEST = 4.5
"""A voltage that no cell has: there must be more cells than assumed."""
_LAST = 0.02
"""The level at that voltage."""


class BatteryGauge:
    """The charge of one drone's battery."""

    def __init__(self, cells: int = 1) -> None:
        self.cells = cells
        """The number of cells in series, whose total voltage is measured."""
        self.level = 0.0
        """From 0 to 1."""
        self.rest: float | None = None
        """The last voltage of a cell without load; None: not measured yet."""
        self._sag = SAG
        self._sags = list[float]()
        self._smooth: float | None = None
        self._time = 0.0
        self._since = 0.0
        self._flew = False

    def hear(self, time: float, volts: float, *, flies: bool, is_low: bool = False) -> None:
        """Take the voltage of the whole battery; `is_low`: the drone says of itself that it is.

        Seconds of any clock; a voltage of 0 is none.
        """
        cell = volts / self.cells
        if not cell > 0.0:
            return
        passed = time - self._time
        self._time = time
        if not flies:
            self.rest = cell
            self._flew = False
            self._smooth = None
            self.level = level_at(cell)
            return
        if not self._flew:
            self._flew = True
            self._since = time
            self._sags = []
        if self._smooth is None:
            self._smooth = cell
        share = min(1.0, passed / _SMOOTH)
        self._smooth += (cell - self._smooth) * share
        self._measure(time, cell)
        if self.rest is None or time - self._since > _MEASURED:
            self.level = level_at(self._smooth + self._sag)
        if is_low or self._smooth < LOW:
            self.level = min(self.level, _LAST)  # whatever the gauge says

    @property
    def problem(self) -> str | None:
        """Return why its voltage tells nothing: the fleet file names too few cells."""
        if self.rest is None or self.rest <= FULLEST:
            return None
        volts = self.rest * self.cells
        have = "one cell has" if self.cells == 1 else f"{self.cells} cells have"
        return (
            f"its battery has {volts:.2f} V, more than {have}: say in the fleet file how many it has,"
            f" such as cells = {ceil(volts / FULLEST)}"
        )

    def _measure(self, time: float, cell: float) -> None:
        """Measure the voltage drop in the first seconds of a flight."""
        if self.rest is None or not _SETTLED <= time - self._since <= _MEASURED:
            return
        self._sags.append(self.rest - cell)
        self._sag = min(_MOST, max(_LEAST, fmean(self._sags)))
