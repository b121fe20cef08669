"""How often what was killed, in which moment, and how the missions ended."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field


@dataclass(slots=True)
class Tally:
    """All flights of one campaign."""

    flights: int = 0
    brains: Counter[str] = field(default_factory=Counter)
    """Kills of the brain, by what went on."""
    gateways: Counter[str] = field(default_factory=Counter)
    missed: int = 0
    """Kills that came too late: the process had ended."""
    ends: Counter[str] = field(default_factory=Counter)
    reasons: Counter[str] = field(default_factory=Counter)
    actions: int = 0
    """Picks and releases that the world has done."""
    decided: int = 0
    problems: list[str] = field(default_factory=list)

    def lines(self) -> Iterator[str]:
        """Yield the report."""
        yield f"{self.flights} flights, {self.actions} items picked or released"
        for what, kills in (("brain", self.brains), ("gateway", self.gateways)):
            where = ", ".join(f"{count} {phase}" for phase, count in kills.most_common())
            yield f"{kills.total()} kill -9 of the {what}: {where or 'none'}"
        yield f"missions: {', '.join(f'{n} {end}' for end, n in self.ends.most_common())}"
        yield from (f"  {count} × {reason}" for reason, count in self.reasons.most_common())
        yield f"decided by a person: {self.decided}"
        yield f"problems: {len(self.problems)}"
        yield from (f"  {problem}" for problem in self.problems)
