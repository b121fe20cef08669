"""What a plan promises of a mission: not before a time, not before others, done by a deadline.

As plain data: `deadline` and `opens` are moments, `after` the names of missions. A moment is a number, seconds
since the mission was started, or a text, a time of day; once it was started, seconds since the app was.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from .fields import time_of_day
from .text import quoted

if TYPE_CHECKING:
    from .model import Mission

DAY = 86_400.0

Promises = Mapping[str, Any]

KEYS = ("deadline", "window", "after")
"""How a missions file says them."""


def promised(given: dict[str, Any]) -> Promises:
    """Take a mission's promises out of what its file gives; raise `ValueError` if they are too many."""
    deadline, window, after = (given.pop(key, None) for key in KEYS)
    if deadline is not None and window is not None:
        raise ValueError("has a deadline and a window, which ends with a deadline: leave out one")
    opens, closes = window or (None, deadline)
    found = {"deadline": closes, "opens": opens, "after": after}
    return {name: value for name, value in found.items() if value not in (None, [])}


def misplaced(
    missions: Sequence[Mission[Any]], known: Collection[str]
) -> Iterator[tuple[int, str]]:
    """Yield what is wrong with the order of missions, each with the index of one: no such mission, a circle.

    `known` are missions that were started before.
    """
    places = {mission.name: place for place, mission in enumerate(missions)}
    after: dict[str, list[str]] = {}
    for place, mission in enumerate(missions):
        names = after[mission.name] = [*mission.promises.get("after", ())]
        for name in names:
            if name not in places and name not in known:
                yield place, f"comes after {quoted(name)}, and there is no mission of that name"
    while after:
        ready = [name for name, names in after.items() if after.keys().isdisjoint(names)]
        if not ready:
            ready = _circle(after)
            way = ", which comes after ".join(map(quoted, (*ready[1:], ready[0])))
            yield places[ready[0]], f"comes after {way}: none of them can begin"
        for name in ready:
            del after[name]


def _circle(after: Mapping[str, Sequence[str]]) -> list[str]:
    """Return missions of which each comes after the next, and the last after the first."""
    way = [next(iter(after))]
    while (name := next(one for one in after[way[-1]] if one in after)) not in way:
        way.append(name)
    return way[way.index(name) :]


def kept_from(promises: Promises, now: float, of_day: float) -> Promises:
    """Return promises of a mission that starts now, at this time of day, in seconds since the app started.

    A window that is open now has opened, though that was earlier this day.
    """
    deadline, opens = promises.get("deadline"), promises.get("opens")
    found: dict[str, Any] = {**promises}
    for name, moment in ("deadline", deadline), ("opens", opens):
        if moment is not None:
            found[name] = now + _until(moment, of_day)
    if isinstance(deadline, str) and isinstance(opens, str):
        found["opens"] = found["deadline"] - _until(deadline, time_of_day(opens))
    return found


def _until(moment: float | str, of_day: float) -> float:
    return (time_of_day(moment) - of_day) % DAY if isinstance(moment, str) else moment
