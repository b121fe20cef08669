"""The invariants of every run of every app with any faults, checked on its events.

The rules are independent of the runtime's implementation. They process one event after the other (see
`trace.py`), so a run may be of any length, and they cost little. A journal may hold several runs of an app
that was stopped or crashed and resumed.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Protocol

from ..shared.domain.actions import PICK, RELEASE
from ..shared.domain.model import Mission
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


UNWELL = ("drone.recovering", "drone.lost", "drone.charging", "drone.offline")

_GROUND = 0.05
"""The largest height of a drone on the ground, in metres."""


class ServesOneMission:
    """A drone gets another trip only after its last one ended and it was free again.

    A mission may be allocated the drone that it holds: one not launched yet, or with its item. When an
    app resumes, no drone is free before all were queried.
    """

    def __init__(self, say: Say) -> None:
        self._say = say
        self._holder: dict[object, object] = {}
        self._away: dict[object, None] = {}
        self._free_since: dict[object, None] | None = None
        """The drones that have been free in this run of an app with a journal."""
        self.hears = {
            "brain.began": self._begin,
            "drone.free": self._free,
            "drone.returning": self._leave,
            **dict.fromkeys(UNWELL, self._leave),
            "trip.allocated": self._allocate,
            "trip.launched": self._launch,
            "trip.interrupted": self._offer,
            "trip.relieving": self._relieve,
        }

    def _begin(self, _: Event) -> None:
        self._free_since = {}

    def _offer(self, event: Event) -> None:
        """An event has broken a flight off: the next allocation decides whose its drone is."""
        for drone, holder in tuple(self._holder.items()):
            if holder == event["mission"]:
                del self._holder[drone]
                if self._free_since is not None:
                    self._free_since[drone] = None

    def _relieve(self, event: Event) -> None:
        """Another drone sets out to the mission's flight."""
        self._holder[event["drone"]] = event["mission"]
        self._away.pop(event["drone"], None)

    def _free(self, event: Event) -> None:
        self._holder.pop(event["drone"], None)
        self._away.pop(event["drone"], None)
        if self._free_since is not None:
            self._free_since[event["drone"]] = None

    def _leave(self, event: Event) -> None:
        self._holder.pop(event["drone"], None)
        self._away[event["drone"]] = None

    def _allocate(self, event: Event) -> None:
        drone, mission = event["drone"], event["mission"]
        holder = self._holder.get(drone)
        if drone in self._away:
            self._say(f"{at(event)}: {drone} was given to {mission} before it was free again")
        elif holder is None:
            if self._free_since is not None and drone not in self._free_since:
                self._say(f"{at(event)}: {drone} was given to {mission} before it was asked")
        elif holder != mission:
            self._say(f"{at(event)}: {drone} was given to {mission} while {holder} had it")
        self._holder[drone] = mission

    def _launch(self, event: Event) -> None:
        drone, mission = event["drone"], event["mission"]
        if self._holder.get(drone) != mission:
            self._say(f"{at(event)}: {drone} flew for {mission}, which did not have it")


class StaysDown:
    """No drone that recovers, charges or is lost is allocated; a lost one stays lost.

    A free drone is on the ground.
    """

    def __init__(self, say: Say) -> None:
        self._say = say
        self._state: dict[object, object] = {}
        self.hears = {
            "drone": self._become,
            "brain.began": self._begin,
            "trip.allocated": self._serve,
            "trip.launched": self._serve,
        }

    def _serve(self, event: Event) -> None:
        state = self._state.get(event["drone"])
        if state in UNWELL:
            self._say(f"{at(event)}: {event['event']} with {event['drone']} after {state}")

    def _begin(self, _: Event) -> None:
        self._state.clear()  # it may have been repaired, and is queried

    def _become(self, event: Event) -> None:
        drone = event["drone"]
        if self._state.get(drone) == "drone.lost":
            self._say(f"{at(event)}: {drone} was lost before {event['event']}")
        self._state[drone] = event["event"]
        if event["event"] == "drone.free":
            where = event.get("at")
            if isinstance(where, list) and where[2] > _GROUND:
                self._say(f"{at(event)}: {drone} is free in the air")


class ItemsStayAboard:
    """From pick to release a mission's item stays with one drone, and that drone with the mission."""

    def __init__(self, items: Mapping[str, Mapping[str, str]], say: Say) -> None:
        self._say = say
        self._items = items
        self._carrier: dict[object, tuple[object, str]] = {}
        """By mission: the drone with its item, and the trip that releases it."""
        self.hears: Mapping[str, Hears] = {
            "trip.allocated": self._serve,
            "trip.launched": self._serve,
            "trip.completed": self._complete,
            "trip.failed": self._end,
            "mission.ended": self._end,
        }
        if not items:  # many apps carry nothing: then it costs nothing
            self.hears = {}

    def _serve(self, event: Event) -> None:
        drone, mission = event["drone"], event["mission"]
        has = self._carrier.get(mission)
        if has is not None and has[0] != drone:
            self._say(f"{at(event)}: {mission} has its item aboard {has[0]}, yet takes {drone}")
        for other, (carries, _) in self._carrier.items():
            if carries == drone and other != mission:
                self._say(f"{at(event)}: {drone} has the item of {other}, yet serves {mission}")

    def _complete(self, event: Event) -> None:
        mission, trip = event["mission"], str(event["trip"])
        releases = self._items.get(str(mission), {}).get(trip)
        if releases is not None:
            self._carrier[mission] = event["drone"], releases
        elif mission in self._carrier and trip == self._carrier[mission][1]:
            del self._carrier[mission]

    def _end(self, event: Event) -> None:
        self._carrier.pop(event["mission"], None)


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
        mission, trip = event["mission"], event["trip"]
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
        self.place, self.over, self.until = place, over, until
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


Items = Mapping[str, Mapping[str, str]]
"""By mission: the trips that pick an item, each with the trip that releases it."""

RULES: tuple[Callable[[Say], Rule], ...] = (
    EndsOnce,
    NothingAfterTheEnd,
    TripsDoNotOverlap,
    AttemptsCountUp,
    DelaysAreWaited,
    PromisesAreKept,
    LimitsAreKept,
    CompletedDidEverything,
    ServesOneMission,
    StaysDown,
)
"""The rules that need only the events."""


class Invariants:
    """Checks all rules: call `take` with every event, and `over` at the end."""

    def __init__(self, items: Items, rules: Sequence[Callable[[Say], Rule]] | None = None) -> None:
        self.found: list[str] = []
        """A sentence for each violation so far."""
        chosen: Sequence[Callable[[Say], Rule]]
        chosen = (*RULES, partial(ItemsStayAboard, items)) if rules is None else rules
        self._hears = _Hears([rule(self.found.append) for rule in chosen])
        self._now = 0.0

    def take(self, event: Event) -> None:
        """Process an event."""
        now = event["t"]
        if now < self._now:
            self.found.append(f"{at(event)}: {event['event']} comes after {self._now:g} s")
        self._now = now
        for hear in self._hears[event["event"]]:
            hear(event)

    def over(self) -> list[str]:
        """Return all violations of the run, also by what should have happened."""
        for hear in self._hears[OVER]:
            hear({"t": self._now, "event": OVER})
        return self.found


class _Hears(dict[object, tuple[Hears, ...]]):
    """The rules for each kind of event, by its full name or its family."""

    def __init__(self, rules: Sequence[Rule]) -> None:
        super().__init__()
        self._rules = rules

    def __missing__(self, kind: object) -> tuple[Hears, ...]:
        family = str(kind).partition(".")[0]
        asked = (rule.hears.get(str(kind), rule.hears.get(family)) for rule in self._rules)
        found = self[kind] = tuple(hear for hear in asked if hear is not None)
        return found


def violations(trace: Iterable[Event], items: Items) -> list[str]:
    """Return all violations of a complete run."""
    invariants = Invariants(items)
    for event in trace:
        invariants.take(event)
    return invariants.over()


def items_of(missions: Iterable[Mission[Any]]) -> Items:
    """Return the trips of a plan that pick items, with the trips that release them."""
    items: dict[str, dict[str, str]] = {}
    for mission in missions:
        picked = ""
        for trip in mission.trips:
            if trip.action == PICK:
                picked = trip.name
            elif trip.action == RELEASE:
                items.setdefault(mission.name, {})[picked] = trip.name
    return items
