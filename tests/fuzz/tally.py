"""Many trials, counted."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field

from tests.fuzz.trial import Outcome

WRITTEN_EVERY = 25
"""Every so many-th app that is accepted is written to the disk as well."""


@dataclass(slots=True)
class Tally:
    """What became of the inputs so far."""

    made: Counter[str] = field(default_factory=Counter)
    """Inputs by the way in which they were made."""
    accepted: Counter[str] = field(default_factory=Counter)
    codes: Counter[str] = field(default_factory=Counter)
    """How many inputs got a code, at least once."""
    hooks: Counter[str] = field(default_factory=Counter)

    def add(self, outcome: Outcome) -> None:
        """Count one."""
        self.made[outcome.way] += 1
        self.accepted[outcome.way] += not outcome.codes
        self.codes.update(set(outcome.codes))
        self.hooks.update(set(outcome.hooks))

    def lines(self) -> Iterator[str]:
        """Say what was counted."""
        yield f"inputs {self.made.total()}, accepted {self.accepted.total()}"
        for way in sorted(self.made):
            yield f"  {way}: {self.made[way]}, accepted {self.accepted[way]}"
        for title, counts in (("rejected", self.codes), ("hooks rejected", self.hooks)):
            yield f"{title} by code ({len(counts)} codes):"
            said = [f"{code} {counts[code]}" for code in sorted(counts)]
            for i in range(0, len(said), 8):
                yield "  " + ", ".join(said[i : i + 8])
