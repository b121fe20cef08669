"""A small lithium battery: its voltage at rest and under load, and its reported state."""

from __future__ import annotations

from dataclasses import replace

from ..lithium import SAG, level_at, volts_at
from ..shared.alone.drones import Body
from ..shared.alone.world import World
from ..shared.domain.model import Category, Point
from ..shared.domain.trace import Clock
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
    """A simulated drone whose place a firmware's dynamics say, with its battery as the firmware sees it."""

    def __init__(
        self,
        id: str,
        home: Point,
        category: Category,
        world: World,
        clock: Clock,
        *,
        cells: int = 1,
        shuts_down: bool = False,
    ) -> None:
        """`shuts_down`: whether its build switches it off before it is empty."""
        super().__init__(id, home, category, world, clock)
        self._cells = cells
        self._shuts_down = shuts_down
        self._low = False
        self._below_low = self._below_empty = 0.0

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

    def set_volts(self, volts: float) -> None:
        """Set the charge so that this voltage is measured now."""
        self.charge_to(level_at(volts / self._cells + self._sag))

    @property
    def charges(self) -> bool:
        """Whether its pad charges it."""
        return self._charge.rate > 0.0

    @property
    def volts(self) -> float:
        """The present voltage."""
        return self._cells * self._cell

    @property
    def _cell(self) -> float:
        return volts_at(self.battery_level) - self._sag

    @property
    def _sag(self) -> float:
        return 0.0 if self.landed else SAG

    @property
    def state(self) -> int:
        """The value of `pm.state`."""
        if self._low:
            return LOW_POWER
        if self.charges:
            return CHARGED if self.battery_level >= 1.0 else CHARGING
        return ON_BATTERY

    def switches_off(self, seconds: float) -> bool:
        """Advance the time; return whether it has switched off: by its build, or because it is empty."""
        volts = self._cell
        self._below_low = self._below_low + seconds if volts < LOW else 0.0
        self._below_empty = self._below_empty + seconds if volts < EMPTY else 0.0
        self._low = self._below_low > _LONG
        used_up = not self.landed and self.battery_level <= 0.0
        return used_up or (self._shuts_down and self._below_empty > _LONG)
