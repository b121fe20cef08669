"""What happens to a Crazyflie that nobody has asked for, found in what it tells of itself."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ..drones.telemetry import BATTERY_LOW, CRASHED, LOCKED, POSITION_LOST, DroneEvent
from . import words
from .battery import LOW
from .state import LOW_POWER

if TYPE_CHECKING:
    from .state import State

LONG = 3.0
"""Seconds that it must be low: a burst of the motors costs volts, too."""
_WELL = 3.5
"""Volts of a cell at which a battery counts as another one, or as charged."""


class Alarms:
    """What has been told already: each thing is told once, when it begins."""

    def __init__(self, cells: int = 1) -> None:
        self._cells = cells
        self._crashed = self._locked = self._low = self._adrift = False
        self._low_since: float | None = None

    def hear(self, state: State) -> Iterator[DroneEvent]:
        """Yield what has happened since the last state."""
        if state.crashed and not self._crashed:
            yield DroneEvent(kind=CRASHED, reason=words.LIES)
        if state.locked and not self._locked:
            why = words.LOCKED_BY_DECK if state.deck_failed else words.IS_LOCKED
            yield DroneEvent(kind=LOCKED, reason=why)
        self._crashed, self._locked = state.crashed, state.locked
        if self._battery_low(state):
            yield DroneEvent(kind=BATTERY_LOW, reason=words.low(state.volts))

    def hear_of_its_place(self, adrift: bool, variance: float) -> Iterator[DroneEvent]:
        """Yield that it does not know its place in the air any more, when that begins."""
        if adrift and not self._adrift:
            yield DroneEvent(kind=POSITION_LOST, reason=words.adrift(variance))
        self._adrift = adrift

    def _battery_low(self, state: State) -> bool:
        """Say whether it has just become so low that it must come down."""
        volts = state.volts / self._cells
        if state.power != LOW_POWER and not 0.0 < volts < LOW:
            self._low_since = None
            self._low = self._low and volts < _WELL
            return False
        if self._low_since is None:
            self._low_since = state.time
        if self._low or state.time - self._low_since < LONG:
            return False
        self._low = True
        return True
