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
    """What became of the inputs so far: by the way in which they were made, and by what was said of them."""

    made: Counter[str] = field(default_factory=Counter)
    accepted: Counter[str] = field(default_factory=Counter)
    codes: Counter[str] = field(default_factory=Counter)
    hooks: Counter[str] = field(default_factory=Counter)

    def add(self, outcome: Outcome) -> None:
        """Count one; a code once, however often it was given."""
        self.made[outcome.way] += 1
        self.accepted[outcome.way] += not outcome.codes
        self.codes.update(set(outcome.codes))
        self.hooks.update(set(outcome.hooks))

    def lines(self) -> Iterator[str]:
        """Say what was counted."""
        for title in ("made", "accepted", "codes", "hooks"):
            counts: Counter[str] = getattr(self, title)
            yield f"{title} ({counts.total()}): " + ", ".join(
                f"{k} {counts[k]}" for k in sorted(counts)
            )
