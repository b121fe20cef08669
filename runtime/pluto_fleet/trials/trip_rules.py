"""What must be true of trips: their flights, their attempts, their delays."""

from __future__ import annotations

import re
from collections import Counter
from typing import TYPE_CHECKING

from .rule import Say, at, flight, named

if TYPE_CHECKING:
    from plutoc_runtime.domain.trace import Event


class TripsDoNotOverlap:
    """A mission has one trip in flight at a time, and what ends is what was launched."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._flying: dict[object, tuple[object, object, object, object]] = {}
        self.hears = {
            "trip.launched": self._launch,
            "trip.completed": self._end,
            "trip.failed": self._end,
            "trip.interrupted": self._interrupt,
            "mission.uncertain": self._doubt,
            "mission.ended": self._end_mission,
        }
        self._doubted: dict[object, None] = {}

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

    def _interrupt(self, event: Event) -> None:
        mission = event["mission"]
        launched = self._flying.pop(mission, None)
        if launched is None or launched[0] != event["trip"]:
            self._say(f"{at(event)}: {event['trip']} of {mission} was interrupted before it flew")

    def _doubt(self, event: Event) -> None:
        self._doubted[event["mission"]] = None

    def _end_mission(self, event: Event) -> None:
        launched = self._flying.pop(event["mission"], None)
        if launched is not None and event["mission"] not in self._doubted:
            self._say(f"{at(event)}: {event['mission']} ended during {named(launched)}")


class AttemptsCountUp:
    """The flights of one trip in one round are numbered 1, 2, 3; one that was interrupted is none."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._last: dict[tuple[object, object, object], int] = {}
        self._newest: dict[object, tuple[object, object, object]] = {}
        """By mission, what it flew last."""
        self._round: dict[object, object] = {}
        self._shared: set[tuple[object, object]] = set()
        """Names that a hook has given to several trips of a mission: which of them flies cannot be told."""
        self.hears = {
            "trip.launched": self._launch,
            "trip.interrupted": self._interrupt,
            "mission.repeated": self._repeat,
            "mission.changed": self._change,
        }

    def _repeat(self, event: Event) -> None:
        self._round[event["mission"]] = event["round"]

    def _change(self, event: Event) -> None:
        todo, done, mission = event["todo"], event["done"], event["mission"]
        assert isinstance(todo, list)
        assert isinstance(done, list)
        names = Counter(trip["name"] for trip in (*todo, *done))
        self._shared.update((mission, name) for name, trips in names.items() if trips > 1)
        for trip in todo:  # one that waits has its next attempt before it
            flown = trip.get("attempt", 1) - ("status" not in trip)
            self._last[mission, trip["name"], self._round.get(mission, 0)] = flown

    def _launch(self, event: Event) -> None:
        trip = event["mission"], event["trip"], event["round"]
        self._newest[event["mission"]] = trip
        last = self._last[trip] = self._last.get(trip, 0) + 1
        if event["attempt"] != last and trip[:2] not in self._shared:
            self._say(
                f"{at(event)}: flight {last} of {event['trip']} of {event['mission']} "
                f"calls itself attempt {event['attempt']}"
            )

    def _interrupt(self, event: Event) -> None:
        trip = self._newest.get(event["mission"])
        if trip in self._last:
            self._last[trip] -= 1


class LimitsAreKept:
    """Who fails for its safe time has flown so long: a limit is that of one trip and of no other."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._since: dict[object, float] = {}
        self.hears = {"trip.launched": self._launch, "trip.failed": self._fail}

    def _launch(self, event: Event) -> None:
        self._since[event["mission"]] = float(str(event["t"]))

    def _fail(self, event: Event) -> None:
        limit = _LIMIT.search(str(event["reason"]))
        since = self._since.get(event["mission"])
        if limit is None or since is None:
            return
        parts = [(float(number), unit) for number, unit in _PART.findall(limit[1])]
        seconds = sum(number * _SECONDS[unit] for number, unit in parts)
        rounded = 0.1 if len(parts) == 1 and parts[0][1] == "s" else _SECONDS[parts[-1][1]]
        flown = float(str(event["t"])) - since
        if flown < seconds - rounded:
            self._say(
                f"{at(event)}: {event['trip']} of {event['mission']} failed after {flown:g} s "
                f"for a safe time of {limit[1]}"
            )


_LIMIT = re.compile(r"safe time of ((?:[0-9.]+ (?:s|min|h) ?)+)")
_PART = re.compile(r"([0-9.]+) (s|min|h)")
_SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0}
