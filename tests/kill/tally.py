"""How often what was killed, in which moment, and how the missions ended."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field


@dataclass(slots=True)
class Tally:
    """All flights of one campaign."""

    brains: Counter[str] = field(default_factory=Counter)
    """Kills of the brain, by what went on."""
    gateways: Counter[str] = field(default_factory=Counter)
    ends: Counter[str] = field(default_factory=Counter)
    reasons: Counter[str] = field(default_factory=Counter)
    actions: int = 0
    """Picks and releases that the world has done."""
    decided: int = 0

    def lines(self) -> Iterator[str]:
        """Yield the report."""
        for what, kills in (("brain", self.brains), ("gateway", self.gateways)):
            where = ", ".join(f"{count} {phase}" for phase, count in kills.most_common())
            yield f"{kills.total()} kill -9 of the {what}: {where or 'none'}"
        yield f"missions: {', '.join(f'{n} {end}' for end, n in self.ends.most_common())}"
        yield from (f"  {count} × {reason}" for reason, count in self.reasons.most_common())
        yield f"items picked or released: {self.actions}; decided by a person: {self.decided}"
