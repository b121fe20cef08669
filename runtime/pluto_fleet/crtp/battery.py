"""A small lithium battery: its voltage at rest and under load, and its reported state."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ..lithium import SAG, level_at, volts_at
from ..shared.alone.drones import Body
from ..shared.domain.model import Point
from ..shared.fleet.reach import docked
from ..shared.fleet.telemetry import resting

LOW, EMPTY = 3.2, 3.0
"""Volts of a cell under load: below the first it is said to be low; below the second it switches
itself off, if its build does that at all."""
_LONG = 5.0
"""Seconds for which a low voltage must last."""
FLIGHT, CHARGE = 420.0, 1200.0
"""Seconds from full to empty in the air, and from empty to full on the pad."""
_ON_PAD = 0.05
"""Metres of height up to which a pad charges."""

ON_BATTERY, CHARGING, CHARGED, LOW_POWER = 0, 1, 2, 3


class CarriedBody(Body):
    """A simulated drone whose place a firmware's dynamics say."""

    def carried(self, to: Point, *, motors: bool) -> None:
        """Be there now; the battery drains while the motors turn, and charges in the dock."""
        rate = -1.0 / self.category.endurance
        if not motors:
            rate = (to[2] < _ON_PAD and docked(to, self.home)) / self.category.charge_time
        if rate != self._charge.rate:
            self._charge = self._charge.changing(self._clock.now, rate)
        self._landed = not motors
        self._legs = [resting(to, self._clock.now)]

    def charge_to(self, level: float) -> None:
        """Have so much in its battery now."""
        self._charge = replace(self._charge, level=level, since=self._clock.now)

    @property
    def charges(self) -> bool:
        """Whether its pad charges it."""
        return self._charge.rate > 0.0


@dataclass(slots=True)
class SimulatedBattery:
    """A drone's battery, as its firmware sees it."""

    body: CarriedBody
    cells: int = 1
    shuts_down: bool = False
    """Whether its build switches it off before it is empty."""
    low: bool = False
    _below_low: float = 0.0
    _below_empty: float = 0.0

    @property
    def level(self) -> float:
        """Its charge, from 0 to 1."""
        return self.body.battery_level

    @property
    def volts(self) -> float:
        """The present voltage."""
        return self.cells * self._cell

    @property
    def _cell(self) -> float:
        """Volts of each cell."""
        return volts_at(self.level) - self._sag

    @property
    def _sag(self) -> float:
        return 0.0 if self.body.landed else SAG

    @property
    def state(self) -> int:
        """The value of `pm.state`."""
        if self.low:
            return LOW_POWER
        if self.body.charges:
            return CHARGED if self.level >= 1.0 else CHARGING
        return ON_BATTERY

    def set_volts(self, volts: float) -> None:
        """Set the charge so that this voltage is measured now."""
        self.body.charge_to(level_at(volts / self.cells + self._sag))

    def step(self, seconds: float) -> bool:
        """Advance the time; return whether it has switched off: by its build, or because it is empty."""
        volts = self._cell
        self._below_low = self._below_low + seconds if volts < LOW else 0.0
        self._below_empty = self._below_empty + seconds if volts < EMPTY else 0.0
        self.low = self._below_low > _LONG
        used_up = not self.body.landed and self.level <= 0.0
        return used_up or (self.shuts_down and self._below_empty > _LONG)
