"""The invariant of promises: their order, their windows, and what is late."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from .rules import Say, at

if TYPE_CHECKING:
    from ..shared.domain.trace import Event

_ROUNDED = 1e-5
"""Seconds by which a time may differ that was written into a journal."""


@dataclass(slots=True)
class _Promised:
    opens: float = 0.0
    deadline: float | None = None
    after: list[str] = field(default_factory=list)
    late: bool = False
    ended: str | None = None


class PromisesAreKept:
    """No mission begins before its window and those it comes after; it is late if it ends after its deadline."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._promised: dict[object, _Promised] = {}
        self.hears = {
            "mission.promised": self._promise,
            "mission.created": self._begin,
            "trip.launched": self._begin,
            "mission.late": self._late,
            "mission.ended": self._end,
        }

    def _of(self, event: Event) -> _Promised:
        return self._promised.setdefault(event["mission"], _Promised())

    def _promise(self, event: Event) -> None:
        mission = self._of(event)
        if mission.after or mission.deadline is not None:
            self._say(f"{at(event)}: {event['mission']} is promised something once more")
        mission.opens = event.get("opens", 0.0)
        mission.deadline = event.get("deadline")
        mission.after = event.get("after", [])

    def _begin(self, event: Event) -> None:
        mission = self._of(event)
        if event["t"] < mission.opens - _ROUNDED:
            self._say(
                f"{at(event)}: {event['mission']} begins before its window, {mission.opens:g} s"
            )
        for name in mission.after:
            other = self._promised.get(name)
            if other is None or other.ended != "COMPLETED":
                stands = "under way" if other is None or other.ended is None else other.ended
                self._say(
                    f"{at(event)}: {event['mission']} begins, and {name} before it is {stands}"
                )

    def _late(self, event: Event) -> None:
        mission = self._of(event)
        if mission.deadline is None or event["t"] < mission.deadline - _ROUNDED:
            self._say(f"{at(event)}: {event['mission']} is late before its deadline")
        if mission.late:
            self._say(f"{at(event)}: {event['mission']} is late once more")
        mission.late = True

    def _end(self, event: Event) -> None:
        mission = self._of(event)
        mission.ended = event["status"]
        due = mission.deadline
        if due is not None and event["t"] > due + _ROUNDED and not mission.late:
            self._say(
                f"{at(event)}: {event['mission']} ends, was due at {due:g} s, and is not late"
            )
