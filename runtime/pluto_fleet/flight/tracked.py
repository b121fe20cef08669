"""What moves beside the drones: where each object was reported last, and the way that it came."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from math import dist
from typing import Any

from ..shared.hooks.plain_data import point_of

MOVED = 0.05
"""Metres from which on an object is somewhere else."""
EVERY = 1.0
"""Seconds between two places of a way, at the least."""
STILL = 2.0
"""Seconds after which a place is noted though it is the same: there was news of it."""
KEPT = 60.0
"""Seconds for which a way is kept, and for which an object is known that is not reported any more."""
MOST = 100
"""The most objects that are known, those that were reported last."""

Place = tuple[float, float, float]


@dataclass(slots=True)
class Tracked:
    """One object."""

    kind: str
    at: Place
    seen: float
    """When it was reported last, in seconds of the flight."""
    way: deque[tuple[float, Place]] = field(default_factory=deque)
    """Where it was at which second, the last minute of it."""

    def is_news(self) -> bool:
        """Return whether its way does not say yet where it is."""
        if not self.way:
            return True
        when, where = self.way[-1]
        passed = self.seen - when
        return passed >= STILL or (passed >= EVERY and dist(where, self.at) >= MOVED)


class TrackedObjects:
    """All objects that are tracked in a run, by their ids."""

    def __init__(self) -> None:
        self._known: dict[str, Tracked] = {}

    def take(self, reports: Mapping[str, Any], now: float) -> dict[str, Any]:
        """Take over reports: `at`, and perhaps `kind`, and how many seconds `ago`; return those that a journal must have.

        These are few: what was reported of an object that stands, or just before, says nothing new.
        """
        news = {}
        for id, report in reports.items():
            x, y, z = point_of(report["at"])
            at = (round(x, 2), round(y, 2), round(z, 2))
            before = self._known.pop(id, None)  # those that were reported last are last
            known = before or Tracked("", at, now)
            kind = str(report.get("kind", known.kind))
            ago = report.get("ago", 0.0)
            told = {"at": at} if before and kind == before.kind else {"at": at, "kind": kind}
            known.kind = kind
            known.at = at
            known.seen = round(now - ago, 3)
            self._known[id] = known
            if known.is_news():
                known.way.append((known.seen, at))
                news[id] = {**told, "ago": ago} if ago else told
        for id in [*self._known][:-MOST]:
            del self._known[id]
        return news

    def now(self, now: float) -> Iterator[tuple[str, Tracked]]:
        """Yield those of which there was news in the last minute, with the way that they came."""
        for id, one in self._known.items():
            if now - one.seen <= KEPT:
                while one.way and one.way[0][0] < one.seen - KEPT:
                    one.way.popleft()
                yield id, one
