"""The smallest and the largest of each number in a plan file.

What lies beyond is a slip of the pen, or no flight of any drone; and nothing that is computed from
what lies between divides by nothing or grows beyond all numbers.
"""

from __future__ import annotations

from dataclasses import dataclass

from plutoc_runtime.domain.text import number


@dataclass(frozen=True, slots=True, kw_only=True)
class Limit:
    """From where to where a number may be."""

    least: float
    most: float
    unit: str = ""
    or_none: bool = False
    """Whether it may also be 0, which says that there is none of it."""

    def problem(self, amount: float) -> str | None:
        """Return what is wrong with an amount, and what would not be."""
        if self.least <= amount <= self.most or (self.or_none and amount == 0):
            return None
        beyond = f"less than {self._written(self.least)}"
        if amount > self.most:
            beyond = f"more than {self._written(self.most)}"
        elif self.or_none and amount < 0:
            beyond = "less than 0"
        none = "0, or " if self.or_none else ""
        return f"is {beyond}: it may be {none}{self._written(self.least)} to {self._written(self.most)}"

    def _written(self, amount: float) -> str:
        written = number(amount) if abs(amount) < 10_000 else f"{amount:,.0f}"
        return f"{written} {self.unit}".strip()


SIDE = Limit(least=0.1, most=10_000.0, unit="m")
"""Of a map."""
HEIGHT = Limit(least=0.1, most=1000.0, unit="m")
"""At which drones cruise, or above which none flies."""
PLACE = Limit(least=-100_000.0, most=100_000.0, unit="m")
"""A coordinate, be it on the map or not."""
APART = Limit(least=0.05, most=10.0, unit="m", or_none=True)
"""What lies between two drones."""
RADIUS = Limit(least=0.01, most=100_000.0, unit="m")
"""Of something that is seen or measured."""
MASS = Limit(least=0.0, most=1000.0, unit="kg")
"""Of an item."""
TIME = Limit(least=0.001, most=1e9, unit="s", or_none=True)
"""A delay, a limit, a distance of rounds: 30 years at most."""
