"""For what the missions of a plan wait before they begin, and for how long, if they are started at some time of day."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from ..shared.domain.text import duration, quoted
from ..shared.flow.promises import DAY, kept_from

if TYPE_CHECKING:
    from ..shared.domain.model import Mission

LONG = 10.0
"""Seconds of a wait that is worth a line."""


def waits(missions: Sequence[Mission[Any]], of_day: float) -> Iterator[str]:
    """Yield a sentence for each mission that waits; `of_day`: when they are started, in seconds after midnight."""
    for mission in missions:
        promises = kept_from(mission.promises, 0.0, of_day)
        after = ", ".join(map(quoted, promises.get("after", ())))
        opens = promises.get("opens", 0.0)
        at, delay = getattr(mission, "at", None), getattr(mission.trips[0], "delay", None)
        begins = 0.0 if at is None else (at - of_day) % DAY
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
            hour = _hour(of_day + seconds)
            yield f"{who} {duration(seconds)} if it is started at {_hour(of_day)}, until {hour}: {why}"


def _hour(of_day: float) -> str:
    minutes, seconds = divmod(round(of_day), 60)
    return f"{minutes // 60 % 24:02}:{minutes % 60:02}" + f":{seconds:02}" * (seconds > 0)
