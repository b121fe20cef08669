"""What must be true of missions."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from .rule import OVER, Say, at, names

if TYPE_CHECKING:
    from plutoc_runtime.domain.trace import Event

ENDS = ("COMPLETED", "FAILED", "CANCELLED")


class EndsOnce:
    """Every mission ends, once, or waits for a person, and says why if it was not completed."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._ended: Counter[object] = Counter()
        self._set_out_by_now: dict[object, None] = {}
        """Those that were on their way to a drone: they may not begin anew, whatever a person skips."""
        self._waits: dict[object, object] = {}
        """Those that wait for a person, and why."""
        self.hears = {
            "mission.created": self._create,
            "trip.delayed": self._set_out,
            "trip.allocated": self._set_out,
            "trip.launched": self._set_out,
            "mission.ended": self._end,
            "mission.uncertain": self._wait,
            "mission.held": self._wait,
            "mission.decided": self._go_on,
            OVER: self._over,
        }

    def _create(self, event: Event) -> None:
        if event["mission"] in self._set_out_by_now:
            self._say(f"{at(event)}: {event['mission']} was created once more")
        self._ended[event["mission"]] = 0

    def _set_out(self, event: Event) -> None:
        self._set_out_by_now[event["mission"]] = None

    def _end(self, event: Event) -> None:
        mission, status, reason = event["mission"], event["status"], str(event["reason"])
        self._ended[mission] += 1
        self._waits.pop(mission, None)
        if status not in ENDS:
            self._say(f"{at(event)}: {mission} ended {status}")
        if status == "FAILED" and not reason.strip():
            self._say(f"{at(event)}: {mission} failed without a reason")
        if status == "COMPLETED" and reason:
            self._say(f"{at(event)}: {mission} was completed, yet says why it failed: {reason}")

    def _wait(self, event: Event) -> None:
        self._waits[event["mission"]] = event["reason"]
        if not str(event["reason"]).strip():
            self._say(f"{at(event)}: {event['mission']} waits for a person, who is asked nothing")

    def _go_on(self, event: Event) -> None:
        if self._waits.pop(event["mission"], None) is None:
            self._say(f"{at(event)}: {event['mission']} asked nothing, and was answered")

    def _over(self, _: Event) -> None:
        for mission, times in self._ended.items():
            if times != 1 and mission not in self._waits:
                self._say(f"{mission} ended {times} times")


class NothingAfterTheEnd:
    """A mission that has ended does nothing any more."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._over: dict[object, None] = {}
        self.hears = {"trip": self._go_on, "mission": self._go_on, "mission.ended": self._end}

    def _go_on(self, event: Event) -> None:
        if event["mission"] in self._over:
            self._say(f"{at(event)}: {event['mission']} had ended before {event['event']}")

    def _end(self, event: Event) -> None:
        self._go_on(event)
        self._over[event["mission"]] = None


class CompletedDidEverything:
    """Who ends COMPLETED has completed every trip of its last round, added ones included."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._own: dict[object, list[str]] = {}
        self._to_do: dict[object, Counter[object]] = {}
        self.hears = {
            "mission.created": self._create,
            "mission.extended": self._extend,
            "mission.repeated": self._repeat,
            "mission.ended": self._end,
            "mission.changed": self._change,
            "trip.completed": self._complete,
            "trip.skipped": self._skip,
        }

    def _create(self, event: Event) -> None:
        own = self._own[event["mission"]] = names(event, "trips")
        self._to_do[event["mission"]] = Counter(own)

    def _extend(self, event: Event) -> None:
        self._to_do[event["mission"]].update(names(event, "redo") + names(event, "add"))

    def _repeat(self, event: Event) -> None:
        self._to_do[event["mission"]] = Counter(self._own[event["mission"]])

    def _change(self, event: Event) -> None:
        todo, done = event["todo"], event["done"]
        assert isinstance(todo, list)
        assert isinstance(done, list)
        own = [str(trip["name"]) for trip in (*done, *todo) if not trip.get("added")]
        self._own[event["mission"]] = own
        self._to_do[event["mission"]] = Counter(trip["name"] for trip in todo)

    def _complete(self, event: Event) -> None:
        self._to_do[event["mission"]][event["trip"]] -= 1

    def _skip(self, event: Event) -> None:
        self._complete(event)  # in further rounds it is left out, too
        if event["trip"] in self._own[event["mission"]]:
            self._own[event["mission"]].remove(str(event["trip"]))

    def _end(self, event: Event) -> None:
        mission = event["mission"]
        if event["status"] == "COMPLETED":
            for trip, times in self._to_do[mission].items():
                if times:
                    self._say(f"{at(event)}: {mission} ended COMPLETED, {trip} {times} times to do")
