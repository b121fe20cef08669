"""For what the missions of a plan wait before they begin, and for how long, if they are started at some time of day."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from ..shared.domain.text import duration, quoted
from ..shared.flow.promises import kept_from

if TYPE_CHECKING:
    from ..shared.domain.model import Mission
    from ..shared.time.hours import Hours

LONG = 10.0
"""Seconds of a wait that is worth a line: in a flight it is told then, or at once if it is known to take longer."""


def waits(missions: Sequence[Mission[Any]], hours: Hours) -> Iterator[str]:
    """Yield a sentence for each mission that waits, by the hours from their start on."""
    for mission in missions:
        promises = kept_from(mission.promises, hours)
        after = ", ".join(map(quoted, promises.get("after", ())))
        opens = promises.get("opens", 0.0)
        at = getattr(mission, "at", None)
        delay = getattr(mission.trips[0], "delay", None)
        begins = 0.0 if at is None else hours.next(at, 0.0)
        why, seconds = max(
            ("its window has not opened", opens),
            ("its first trip is not to start before", begins),
            ("its first trip has a delay", delay or 0.0),
            key=lambda one: one[1],
        )
        who = f"mission {quoted(mission.name)}: waits"
        if after:
            yield f"{who} until {after} {'have' if ', ' in after else 'has'} completed"
        if seconds > LONG:
            start = hours.said(0.0)
            end = hours.said(seconds)
            yield f"{who} {duration(seconds)} if it is started at {start}, until {end}: {why}"
