"""What must hold of every mission and every trip, by the events of a run."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Mapping
from typing import Any, Protocol

from ..shared.domain.trace import Event

Say = Callable[[str], object]
"""Called with the sentence of a violation."""

Hears = Callable[["Event"], None]

OVER = "over"
"""The kind of the final event, at which a rule checks what should have happened by then."""


class Rule(Protocol):
    """An invariant of every run."""

    @property
    def hears(self) -> Mapping[str, Hears]:
        """Return the handlers by the kind of event, such as `trip.launched`, or by its family, `trip`."""
        ...


def at(event: Event) -> str:
    """Return an event's time, as the beginning of a sentence."""
    return f"{event['t']:g} s"


def flight(event: Event) -> tuple[object, object, object, object]:
    """Return the flight of an event."""
    return event["trip"], event["drone"], event["round"], event["attempt"]


def named(flown: tuple[object, object, object, object]) -> str:
    """Return a flight in words."""
    trip, drone, round_, attempt = flown
    return f"{trip} ({drone}, round {round_}, attempt {attempt})"


def changed(event: Event) -> Any:
    """Return the trips to do that a hook has changed, or that a person has put in place of others."""
    return event["put" if event["event"] == "mission.changed" else "todo"]


ENDS = ("COMPLETED", "FAILED", "CANCELLED")


class EndsOnce:
    """Every mission ends once, or waits for the user, with a reason if it was not completed."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._ended: Counter[object] = Counter()
        self._set_out_by_now: dict[object, None] = {}
        """Missions that had begun: they may not begin again, also after a skip."""
        self._waits: dict[object, object] = {}
        """Missions that wait for the user, and why."""
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
        mission = event["mission"]
        status = event["status"]
        reason = event["reason"]
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
        if not event["reason"].strip():
            self._say(f"{at(event)}: {event['mission']} waits for a person, who is asked nothing")

    def _go_on(self, event: Event) -> None:
        if self._waits.pop(event["mission"], None) is None:
            self._say(f"{at(event)}: {event['mission']} asked nothing, and was answered")

    def _over(self, _: Event) -> None:
        for mission, times in self._ended.items():
            if times != 1 and mission not in self._waits:
                self._say(f"{mission} ended {times} times")


class NothingAfterTheEnd:
    """Nothing happens to a mission after its end."""

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
    """A mission that ends COMPLETED has completed every trip of its last round, with added ones."""

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
            "mission.replanned": self._replan,
            "trip.completed": self._complete,
            "trip.skipped": self._skip,
        }

    def _create(self, event: Event) -> None:
        own = self._own[event["mission"]] = event["trips"]
        self._to_do[event["mission"]] = Counter(own)

    def _extend(self, event: Event) -> None:
        self._to_do[event["mission"]].update(event["redo"] + event["add"])

    def _repeat(self, event: Event) -> None:
        self._to_do[event["mission"]] = Counter(self._own[event["mission"]])

    def _change(self, event: Event) -> None:
        own = self._own[event["mission"]]
        to_do = self._to_do[event["mission"]]
        put = {str(trip["name"]): trip for trip in event["put"]}
        for name in event["gone"]:
            if name not in put:
                del to_do[name]
                own[:] = [one for one in own if one != name]
        for name, trip in put.items():
            to_do[name] = 1
            if name not in own and not trip.get("added"):
                own.append(name)

    def _replan(self, event: Event) -> None:
        todo = event["todo"]
        done = event["done"]
        own = [str(trip["name"]) for trip in (*done, *todo) if not trip.get("added")]
        self._own[event["mission"]] = own
        self._to_do[event["mission"]] = Counter(trip["name"] for trip in todo)

    def _complete(self, event: Event) -> None:
        self._to_do[event["mission"]][event["trip"]] -= 1

    def _skip(self, event: Event) -> None:
        if event["mission"] not in self._own:
            return  # it has not begun: it will be created without that trip
        self._complete(event)  # it is skipped in further rounds, too
        if event["trip"] in self._own[event["mission"]]:
            self._own[event["mission"]].remove(str(event["trip"]))

    def _end(self, event: Event) -> None:
        mission = event["mission"]
        if event["status"] == "COMPLETED":
            for trip, times in self._to_do.get(
                mission, {}
            ).items():  # it may have been skipped whole
                if times:
                    self._say(f"{at(event)}: {mission} ended COMPLETED, {trip} {times} times to do")


class TripsDoNotOverlap:
    """A mission has one trip in flight at a time, and the trip that ends is the one launched."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._flying: dict[object, tuple[object, object, object, object]] = {}
        self.hears = {
            "trip.launched": self._launch,
            "trip.handed_over": self._hand_over,
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

    def _hand_over(self, event: Event) -> None:
        mission = event["mission"]
        if mission not in self._flying:
            self._say(f"{at(event)}: {event['trip']} of {mission} was taken over, and did not fly")
        self._flying[mission] = flight(event)

    def _end(self, event: Event) -> None:
        mission = event["mission"]
        launched = self._flying.pop(mission, None)
        if launched is None:
            self._say(f"{at(event)}: {event['trip']} of {mission} ended and was not in flight")
        elif launched != flight(event):
            this = named(flight(event))
            other = named(launched)
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
    """The flights of one trip in one round are numbered 1, 2, 3; interrupted ones do not count."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._last: dict[tuple[object, object, object], int] = {}
        self._newest: dict[object, tuple[object, object, object]] = {}
        """By mission, its latest flight."""
        self._round: dict[object, object] = {}
        self.hears = {
            "trip.launched": self._launch,
            "trip.interrupted": self._interrupt,
            "mission.repeated": self._repeat,
            "mission.changed": self._change,
            "mission.replanned": self._change,
        }

    def _repeat(self, event: Event) -> None:
        self._round[event["mission"]] = event["round"]

    def _change(self, event: Event) -> None:
        mission = event["mission"]
        for trip in changed(event):  # a waiting trip has its next attempt's number
            flown = trip.get("attempt", 1) - ("status" not in trip)
            self._last[mission, trip["name"], self._round.get(mission, 0)] = flown

    def _launch(self, event: Event) -> None:
        trip = event["mission"], event["trip"], event["round"]
        self._newest[event["mission"]] = trip
        last = self._last[trip] = self._last.get(trip, 0) + 1
        if event["attempt"] != last:
            self._say(
                f"{at(event)}: flight {last} of {event['trip']} of {event['mission']} "
                f"calls itself attempt {event['attempt']}"
            )

    def _interrupt(self, event: Event) -> None:
        trip = self._newest.get(event["mission"])
        if trip in self._last:
            self._last[trip] -= 1


class EventsHappenOnce:
    """With one id an event happens once; each mission that is made of one is made once, and begins."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._raised: dict[object, None] = {}
        self._made: dict[object, None] = {}
        self._begun: dict[object, None] = {}
        self.hears = {
            "event.raised": self._raise,
            "event.over": self._end,
            "mission": self._begin,
            OVER: self._over,
        }

    def _raise(self, event: Event) -> None:
        if event["id"] in self._raised:
            self._say(f"{at(event)}: event {event['id']} happens once more")
        self._raised[event["id"]] = None

    def _end(self, event: Event) -> None:
        mission = event.get("made")
        if event["id"] not in self._raised:
            self._say(f"{at(event)}: event {event['id']} has not happened, and is over")
        if mission in self._made:
            self._say(f"{at(event)}: mission {mission} is made once more, of event {event['id']}")
        if mission is not None:
            self._made[mission] = None

    def _begin(self, event: Event) -> None:
        self._begun[event["mission"]] = None

    def _over(self, _: Event) -> None:
        for mission in self._made:
            if mission not in self._begun:
                self._say(f"mission {mission} was made of an event, and has not begun")


class LimitsAreKept:
    """A trip that fails by its safe time has flown that long."""

    def __init__(self, say: Say) -> None:
        self._say = say
        self._since: dict[object, float] = {}
        self.hears = {"trip.launched": self._launch, "trip.failed": self._fail}

    def _launch(self, event: Event) -> None:
        self._since[event["mission"]] = event["t"]

    def _fail(self, event: Event) -> None:
        limit = _LIMIT.search(event["reason"])
        since = self._since.get(event["mission"])
        if limit is None or since is None:
            return
        parts = [(float(number), unit) for number, unit in _PART.findall(limit[1])]
        seconds = sum(number * _SECONDS[unit] for number, unit in parts)
        rounded = 0.1 if len(parts) == 1 and parts[0][1] == "s" else _SECONDS[parts[-1][1]]
        flown = event["t"] - since
        if flown < seconds - rounded:
            self._say(
                f"{at(event)}: {event['trip']} of {event['mission']} failed after {flown:g} s "
                f"for a safe time of {limit[1]}"
            )


_LIMIT = re.compile(r"safe time of ((?:[0-9.]+ (?:s|min|h) ?)+)")
_PART = re.compile(r"([0-9.]+) (s|min|h)")
_SECONDS = {"s": 1.0, "min": 60.0, "h": 3600.0}
