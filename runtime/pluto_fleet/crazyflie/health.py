"""A Crazyflie's battery and its alarms, derived from its state.

Under load the voltage of a small battery drops by some tenths of a volt, which at rest would mean much less
charge. The level follows from the voltage at rest; in the air the drop is added, which is measured anew at
each take-off, as batteries age.
"""

from __future__ import annotations

from collections.abc import Iterator
from statistics import fmean
from typing import TYPE_CHECKING

from ..drones.protocol import BATTERY_LOW, CRASHED, LOCKED, POSITION_LOST, DroneEvent
from ..lithium import SAG, level_at
from . import messages
from .state import LOW_POWER

if TYPE_CHECKING:
    from .state import State


_LEAST, _MOST = 0.05, 0.6
"""The bounds of the voltage drop of hovering, which is the usual one until it is measured."""
_SETTLED, _MEASURED = 1.0, 3.0
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
        self._sag, self._sags = SAG, list[float]()
        self._smooth: float | None = None
        self._time = self._since = 0.0
        self._flew = False

    def cell(self, state: State) -> float:
        """Return the volts of one cell now."""
        return state.volts / self.cells

    def hear(self, state: State) -> None:
        """Update by a new state."""
        volts = self.cell(state)
        if not volts > 0.0:
            return
        passed, self._time = state.time - self._time, state.time
        if not state.flies:
            self.rest, self._flew, self._smooth = volts, False, None
            self.level = level_at(volts)
            return
        if not self._flew:
            self._flew, self._since, self._sags = True, state.time, []
        if self._smooth is None:
            self._smooth = volts
        share = min(1.0, passed / _SMOOTH)
        self._smooth += (volts - self._smooth) * share
        self._measure(state, volts)
        if self.rest is None or state.time - self._since > _MEASURED:
            self.level = level_at(self._smooth + self._sag)
        if state.power == LOW_POWER or self._smooth < LOW:
            self.level = min(self.level, _LAST)  # whatever the gauge says

    def _measure(self, state: State, volts: float) -> None:
        """Measure the voltage drop in the first seconds of a flight."""
        if self.rest is None or not _SETTLED <= state.time - self._since <= _MEASURED:
            return
        self._sags.append(self.rest - volts)
        self._sag = min(_MOST, max(_LEAST, fmean(self._sags)))


LOW_FOR = 3.0
"""Seconds that it must be low, as a burst of the motors lowers the voltage, too."""
_WELL = 3.5
"""The voltage of a cell at which a battery counts as replaced or charged."""


class AlarmDetector:
    """Detects alarms: each is reported once, when it begins."""

    def __init__(self, cells: int = 1) -> None:
        self._cells = cells
        self._crashed = self._locked = self._low = self._adrift = False
        self._low_since: float | None = None

    def hear(self, state: State) -> Iterator[DroneEvent]:
        """Yield the events since the last state."""
        if state.crashed and not self._crashed:
            yield DroneEvent(kind=CRASHED, reason=messages.LIES)
        if state.locked and not self._locked:
            why = messages.IS_LOCKED
            if state.deck_failed:
                why = f"one of its decks reports a fault, and {why}"
            yield DroneEvent(kind=LOCKED, reason=why)
        self._crashed, self._locked = state.crashed, state.locked
        if self._battery_low(state):
            yield DroneEvent(kind=BATTERY_LOW, reason=f"its battery is down to {state.volts:.2f} V")

    def hear_of_its_place(self, adrift: bool, variance: float) -> Iterator[DroneEvent]:
        """Yield the event that it has lost its position in the air."""
        if adrift and not self._adrift:
            yield DroneEvent(kind=POSITION_LOST, reason=messages.adrift(variance))
        self._adrift = adrift

    def _battery_low(self, state: State) -> bool:
        """Return whether it has just become so low that it must land."""
        volts = state.volts / self._cells
        if state.power != LOW_POWER and not 0.0 < volts < LOW:
            self._low_since = None
            self._low = self._low and volts < _WELL
            return False
        if self._low_since is None:
            self._low_since = state.time
        if self._low or state.time - self._low_since < LOW_FOR:
            return False
        self._low = True
        return True
