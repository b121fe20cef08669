"""What must be true of trips: their flights, their attempts, their delays."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .rule import Say, at, flight, named

if TYPE_CHECKING:
    from ..trace import Event


class TripsDoNotOverlap:
    """A mission has one trip in flight at a time, and what ends is what was launched."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._flying: dict[object, tuple[object, object, object, object]] = {}
        self.hears = {
            "trip.launched": self._launch,
            "trip.completed": self._end,
            "trip.failed": self._end,
            "mission.ended": self._end_mission,
        }

    def _launch(self, event: Event) -> None:
        mission = event["mission"]
        if mission in self._flying:
            other = named(self._flying[mission])
            self._say(f"{at(event)}: {mission} launched {event['trip']} during {other}")
        self._flying[mission] = flight(event)

    def _end(self, event: Event) -> None:
        mission = event["mission"]
        launched = self._flying.pop(mission, None)
        if launched is None:
            self._say(f"{at(event)}: {event['trip']} of {mission} ended and was not in flight")
        elif launched != flight(event):
            this, other = named(flight(event)), named(launched)
            self._say(f"{at(event)}: {this} of {mission} ended, not {other}")

    def _end_mission(self, event: Event) -> None:
        launched = self._flying.pop(event["mission"], None)
        if launched is not None:
            self._say(f"{at(event)}: {event['mission']} ended during {named(launched)}")


class AttemptsCountUp:
    """The flights of one trip in one round are numbered 1, 2, 3."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._last: dict[tuple[object, object, object], int] = {}
        self.hears = {"trip.launched": self._launch}

    def _launch(self, event: Event) -> None:
        trip = event["mission"], event["trip"], event["round"]
        last = self._last[trip] = self._last.get(trip, 0) + 1
        if event["attempt"] != last:
            self._say(
                f"{at(event)}: flight {last} of {event['trip']} of {event['mission']} "
                f"calls itself attempt {event['attempt']}"
            )


class DelaysAreWaited:
    """No trip gets a drone before its delay is over, and none is waited for twice."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._until: dict[object, float] = {}
        """By mission, when the delay that it waits for is over."""
        self._waited: dict[tuple[object, ...], object] = {}
        self._tries: dict[tuple[object, object], object] = {}
        self.hears = {
            "trip.delayed": self._delay,
            "trip.allocated": self._go_on,
            "trip.launched": self._go_on,
        }

    def _delay(self, event: Event) -> None:
        self._until[event["mission"]] = float(str(event["until"]))

    def _go_on(self, event: Event) -> None:
        until = self._until.pop(event["mission"], None)
        if until is not None and float(str(event["t"])) < until - _ROUNDED:
            self._say(
                f"{at(event)}: {event['event']} for {event['trip']} of {event['mission']}, "
                f"whose delay is not over before {until:g} s"
            )


_ROUNDED = 0.002
"""Seconds. Events say their times with so few decimals."""
