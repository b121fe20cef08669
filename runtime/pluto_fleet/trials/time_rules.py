"""What must hold of delays and of promises: when missions may go on, and when they are late."""

from __future__ import annotations

from dataclasses import dataclass, field

from ..shared.domain.trace import Event
from .rules import Say, at, changed

DelayPlace = tuple[object, object, object, object, int]
"""Mission, block, trip, round, attempt."""

_ROUNDED = 0.002
"""Seconds of tolerance: the events' times are rounded."""


class DelaysAreWaited:
    """No trip is allocated a drone before its delay is over, or waits for it twice.

    A delay stands still while everything is stopped or the mission is paused, but not during a crash.
    """

    def __init__(self, say: Say) -> None:
        self._say = say
        self._delay: dict[object, _Delay] = {}
        """By mission, its present delay."""
        self._waited: set[DelayPlace] = set()
        self._tries: dict[tuple[object, object], int] = {}
        """By mission and trip, the attempt; 1 if missing."""
        self._round: dict[object, object] = {}
        self._stopped = False
        self.hears = {
            "trip.delayed": self._wait,
            "trip.allocated": self._go_on,
            "trip.reset": self._reset,
            "trip.skipped": self._skip,
            "mission.extended": self._extend,
            "mission.changed": self._change,
            "mission.replanned": self._change,
            "mission.repeated": self._repeat,
            "mission.paused": self._pause,
            "mission.resumed": self._resume,
            "mission.ended": self._end,
            "stopped": self._stop,
            "brain.began": self._begin,
        }

    def _wait(self, event: Event) -> None:
        mission = event["mission"]
        trip = event["trip"]
        attempt = self._tries.get((mission, trip), 1)
        place = mission, event.get("block"), trip, self._round.get(mission, 0), attempt
        until = event["until"]
        now = event["t"]
        over = event.get("over", until)
        last = self._delay.get(mission)
        if last is not None and last.place == place:
            expected = last.over if last.rest is None else now + last.rest
            if abs(over - expected) > _ROUNDED:
                self._say(
                    f"{at(event)}: {trip} of {mission} waits until {over:g} s, "
                    f"not until {expected:g} s as before"
                )
            if abs(until - over) > _ROUNDED and abs(until - last.until) > _ROUNDED:
                self._say(
                    f"{at(event)}: {trip} of {mission} begins at {until:g} s, "
                    f"not at {last.until:g} s as before"
                )
        elif place in self._waited:
            self._say(f"{at(event)}: {trip} of {mission} waits for its delay once more")
        elif last is not None:
            self._waited.add(last.place)
        self._delay[mission] = _Delay(place, over, until)

    def _go_on(self, event: Event) -> None:
        delay = self._delay.pop(event["mission"], None)
        if delay is None:
            return
        self._waited.add(delay.place)
        now = event["t"]
        over = delay.over if delay.rest is None else now + delay.rest
        if now < max(over, delay.begins) - _ROUNDED:
            self._say(
                f"{at(event)}: {event['trip']} of {event['mission']} was given {event['drone']}, "
                f"and its delay is not over before {max(over, delay.begins):g} s"
            )

    def _reset(self, event: Event) -> None:
        self._tries[event["mission"], event["trip"]] = event["attempt"]

    def _extend(self, event: Event) -> None:
        for trip in event["redo"]:
            key = event["mission"], trip
            self._tries[key] = self._tries.get(key, 1) + 1

    def _change(self, event: Event) -> None:
        for trip in changed(event):
            self._tries[event["mission"], trip["name"]] = trip.get("attempt", 1)

    def _repeat(self, event: Event) -> None:
        mission = event["mission"]
        self._round[mission] = event["round"]
        for key in [key for key in self._tries if key[0] == mission]:
            del self._tries[key]

    def _skip(self, event: Event) -> None:
        delay = self._delay.get(event["mission"])
        if delay is not None and delay.place[2] == event["trip"]:
            del self._delay[event["mission"]]

    def _end(self, event: Event) -> None:
        self._delay.pop(event["mission"], None)

    def _pause(self, event: Event) -> None:
        delay = self._delay.get(event["mission"])
        if delay is not None:
            delay.paused = True
            delay.stand(event)

    def _resume(self, event: Event) -> None:
        delay = self._delay.get(event["mission"])
        if delay is not None:
            delay.paused = False
            delay.run(event)

    def _stop(self, event: Event) -> None:
        self._stopped = True
        for delay in self._delay.values():
            delay.stand(event)

    def _begin(self, event: Event) -> None:
        stopped, self._stopped = self._stopped, False
        for delay in self._delay.values() if stopped else ():
            if not delay.paused:
                delay.run(event)


class _Delay:
    """A pending delay."""

    __slots__ = ("begins", "over", "paused", "place", "rest", "until")

    def __init__(self, place: DelayPlace, over: float, until: float) -> None:
        self.place = place
        self.over = over
        self.until = until
        self.begins = until if until > over else 0.0
        """A time of day, which a Stop does not change."""
        self.rest: float | None = None
        """The remaining seconds while it stands still."""
        self.paused = False

    def stand(self, event: Event) -> None:
        """Suspend it."""
        if self.rest is None:
            self.rest = self.over - event["t"]

    def run(self, event: Event) -> None:
        """Continue it."""
        if self.rest is not None:
            self.over = event["t"] + self.rest
            self.rest = None


_WRITTEN = 1e-5
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
        if event["t"] < mission.opens - _WRITTEN:
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
        if mission.deadline is None or event["t"] < mission.deadline - _WRITTEN:
            self._say(f"{at(event)}: {event['mission']} is late before its deadline")
        if mission.late:
            self._say(f"{at(event)}: {event['mission']} is late once more")
        mission.late = True

    def _end(self, event: Event) -> None:
        mission = self._of(event)
        mission.ended = event["status"]
        due = mission.deadline
        if due is not None and event["t"] > due + _WRITTEN and not mission.late:
            self._say(
                f"{at(event)}: {event['mission']} ends, was due at {due:g} s, and is not late"
            )
