"""A small lithium battery: its voltage at rest and under load, and its reported state."""

from __future__ import annotations

from dataclasses import dataclass

from ..lithium import SAG, level_at, volts_at
from ..shared.domain.motion import CRAZYFLIE, charged

LOW, EMPTY = 3.2, 3.0
"""Volts of a cell under load: below the first it is said to be low; below the second it switches
itself off, if its build does that at all."""
_LONG = 5.0
"""Seconds for which a low voltage must last."""
FLIGHT, CHARGE = 420.0, 1200.0
"""Seconds from full to empty in the air, and from empty to full on the pad."""

ON_BATTERY, CHARGING, CHARGED, LOW_POWER = 0, 1, 2, 3


@dataclass(slots=True)
class SimulatedBattery:
    """The state of a battery."""

    level: float = 1.0
    flight: float = FLIGHT
    """Seconds from full to empty in the air."""
    charge: float = CHARGE
    """Seconds from empty to full on the pad."""
    cells: int = 1
    shuts_down: bool = False
    """Whether its build switches it off before it is empty."""
    loaded: bool = False
    charging: bool = False
    low: bool = False
    _below_low: float = 0.0
    _below_empty: float = 0.0

    @property
    def volts(self) -> float:
        """The present voltage."""
        return self.cells * self._cell

    @property
    def _cell(self) -> float:
        """Volts of each cell."""
        return volts_at(self.level) - (SAG if self.loaded else 0.0)

    @property
    def state(self) -> int:
        """The value of `pm.state`."""
        if self.low:
            return LOW_POWER
        if self.charging:
            return CHARGED if self.level >= 1.0 else CHARGING
        return ON_BATTERY

    def set_volts(self, volts: float) -> None:
        """Set the charge so that this voltage is measured now."""
        self.level = level_at(volts / self.cells + (SAG if self.loaded else 0.0))

    def step(self, seconds: float, *, loaded: bool, charging: bool) -> bool:
        """Advance the time; return whether it has switched off: by its build, or because it is empty."""
        self.loaded, self.charging = loaded, charging
        if loaded:
            self.level = max(0.0, self.level - seconds / self.flight)
        elif charging:
            self.level = charged(self.level, seconds, self.charge, CRAZYFLIE.taper)
        volts = self._cell
        self._below_low = self._below_low + seconds if volts < LOW else 0.0
        self._below_empty = self._below_empty + seconds if volts < EMPTY else 0.0
        self.low = self._below_low > _LONG
        used_up = loaded and self.level <= 0.0
        return used_up or (self.shuts_down and self._below_empty > _LONG)
