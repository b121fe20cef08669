"""The values that a calibration finds, how sure they are, and what could not be told."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import inf
from typing import TYPE_CHECKING

from ..shared.domain.text import counted

if TYPE_CHECKING:
    from ..shared.domain.motion import Motion
    from .estimates import Estimate

SURE = 0.95
"""The probability with which all intervals hold, all of them at once."""
SPARE = 5
"""How many measurements there must be more than parameters."""
WIDEST = {"pace": 0.2, "drain": 0.5, "charge": 0.5}
"""Half an interval, as a share of its value, from which on that says nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Found:
    """A value, and from how many of what it was found."""

    estimate: Estimate
    count: int
    of: str
    low: float = 0.0
    high: float = 0.0
    """Its interval."""

    @property
    def value(self) -> float:
        """What was found; no overhead is less than none."""
        return max(self.estimate.value, 0.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionTime:
    """An action of an app's own, and how long it took on average, in seconds."""

    app: str
    name: str
    seconds: float
    low: float
    high: float
    """Its interval."""
    count: int
    """In how many trips it was done."""
    planned: float
    """What plans count with, on average of the same trips."""
    parameter: str | None
    """The parameter of a trip that says so; None: it is the same in all."""


@dataclass(slots=True, kw_only=True)
class Calibration:
    """What journals tell of a fleet."""

    model: Motion
    """How it is said to move."""
    found: dict[str, Found] = field(default_factory=dict)
    """By the keys of `[motion]`, and `charge`: the share of `charge_time` that a charge takes."""
    untold: dict[str, str] = field(default_factory=dict)
    """What could not be told, and why."""
    own: list[ActionTime] = field(default_factory=list)
    """The apps' own actions that were done often enough."""
    notes: list[str] = field(default_factory=list)
    """What does not fit into `[motion]`."""
    commands: int = 0
    broken_off: int = 0
    failed: int = 0
    far_off: int = 0

    def bound(self) -> None:
        """Give each value its interval, so that all hold at once; drop those that say nothing."""
        while self.found:
            level = 1 - (1 - SURE) / len(self.found)
            for name, found in self.found.items():
                low, high = found.estimate.interval(level)
                self.found[name] = replace(found, low=max(low, 0.0), high=max(high, 0.0))
            vague = {
                name: found
                for name, found in self.found.items()
                if (found.high - found.low) / 2 > WIDEST.get(name, inf) * found.value
            }
            if not vague:
                return
            for name, found in vague.items():
                del self.found[name]
                self.untold[name] = f"{counted(found.count, found.of)} leave it open"


def too_few(count: int, of: str, least: int) -> str:
    """Return why a value could not be told: there is too little of something."""
    return f"it takes {least} {of}s at least, and there {'is' if count == 1 else 'are'} {count}"
