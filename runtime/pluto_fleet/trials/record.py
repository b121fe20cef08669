"""The record of a trial: the durable events, the world's actions, and the violations."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ..app import App
from ..flight.offline import decided
from ..flight.reconcile import id_of
from ..journal.database import written
from ..journal.facts import row_of
from ..journal.standing import Record, Standing
from ..journal.store import Entry
from ..shared.alone.simulate import Bound, Enough
from ..shared.domain.trace import Event
from ..shared.events.declared import FollowDeclared
from .case import BrokenHook, Case
from .invariants import Invariants, items_of
from .rules import ENDS, at


@dataclass(frozen=True, slots=True, kw_only=True)
class Act:
    """One action that was done."""

    job: str
    """`mission/trip/round/attempt`."""
    action: str
    time: float


class ExactlyOnce:
    """No action that may be done only once is done twice, and the journal agrees with the world.

    It processes the journal's events, and at the end the world's actions.
    """

    def __init__(self, repeat: Mapping[str, str]) -> None:
        self._repeat = repeat
        """By action that the world sees: `safe`, `once` or `ask`."""
        self._launched: dict[str, TripPlace] = {}
        """By job, its trip."""
        self._handed_over: Counter[str] = Counter()
        """By job, how often it was taken over since its launch."""
        self._recorded: dict[str, None] = {}
        self._wanted: Counter[TripPlace] = Counter()
        """How often an evaluator asked to repeat a trip."""
        self._round: dict[object, object] = {}
        self._completed: dict[object, None] = {}
        """The completed missions."""

    @property
    def done(self) -> int:
        """Return how many actions were done according to the journal."""
        return len(self._recorded)

    def knows(self, job: str) -> bool:
        """Return whether the journal has the launch of this."""
        return job in self._launched

    def take(self, event: Event) -> None:
        """Process a durable event."""
        match event["event"]:
            case "trip.launched":
                place = (event["mission"], event["trip"], event["round"])
                job = id_of(event["mission"], event)
                self._launched[job] = place
                self._handed_over[job] = 0
            case "trip.handed_over":
                place = (event["mission"], event["trip"], event["round"])
                job = id_of(event["mission"], event)
                self._handed_over[job] += 1
                self._launched[f"{job}+{self._handed_over[job]}"] = place
            case "trip.completed" if event["did"]["action"] in self._repeat:
                self._recorded[id_of(event["mission"], event)] = None
            case "mission.repeated":
                self._round[event["mission"]] = event["round"]
            case "mission.extended":
                mission = event["mission"]
                for trip in event["redo"]:
                    self._wanted[mission, trip, self._round.get(mission, 0)] += 1
            case "mission.ended" if event["status"] == "COMPLETED":
                self._completed[event["mission"]] = None

    def violations(self, acts: list[Act]) -> list[str]:
        """Return what was done too often, and where journal and world differ."""
        found = []
        jobs: Counter[str] = Counter()
        places: Counter[TripPlace] = Counter()
        safe = {act.job for act in acts if self._repeat.get(act.action, "once") == "safe"}
        for act in acts:
            place = self._launched.get(act.job)
            if place is None:
                found.append(f"{act.time:g} s: {act.job} was flown before that was on record")
            elif act.job not in safe:
                jobs[act.job] += 1
                places[place] += 1
        for job, times in jobs.items():
            if times > 1:
                found.append(f"the action of {job} was done {times} times")
            if job not in self._recorded and self._launched[job][0] in self._completed:
                found.append(f"the action of {job} was done, and the journal does not say so")
        for place, times in places.items():
            if times > 1 + self._wanted[place]:
                mission, trip, round_ = place
                found.append(f"{trip} of {mission} was done {times} times in round {round_}")
        done = {act.job for act in acts}
        for job in self._recorded:
            if job not in done:
                found.append(f"the journal says that the action of {job} was done: it was not")
        return found


_TAKEN_OVER = re.compile(r"\+\d+$")
"""What the id of a flight ends with once another drone has taken it over."""

TripPlace = tuple[object, object, object]
"""Mission, trip, round."""


Memory = Mapping[str, Any]
"""What an app must still know of a mission when it goes on, by what that is called."""


def memory_of(record: Record) -> Memory:
    """Return what is to be known of a mission, by its record."""
    trips = [*record["todo"], *record["done"]]
    return {
        "its round": record["round"],
        "its fields": dict(record.get("fields", {})),
        **{
            f"trip {one['name']}": (one.get("attempt", 1), dict(one.get("fields", {})))
            for one in trips
        },
        _FLIGHTS: record["attempts"],
        _DONE: frozenset(trip["name"] for trip in record["done"]),
    }


_FLIGHTS = "flights"
_DONE = "completed trips"


def forgotten(name: str, before: Memory, after: Memory, since: Sequence[Event]) -> Iterator[str]:
    """Yield what an app has not restored of a mission, apart from changes since."""
    happened = Counter(event["event"] for event in since)
    if not happened.keys().isdisjoint(_CHANGES):
        return
    most = before[_FLIGHTS] + happened["trip.launched"]
    if not most - happened["trip.interrupted"] <= after[_FLIGHTS] <= most:
        yield f"{name} had had {before[_FLIGHTS]} flights, and went on with {after[_FLIGHTS]}"
    for trip in sorted(before[_DONE] - after[_DONE]):
        yield f"{trip} of {name} was completed, and is to be flown again"
    for what in before.keys() - {_FLIGHTS, _DONE}:
        if before[what] != after.get(what):
            yield f"{what} of {name} was {before[what]}, and went on with {after.get(what)}"


_CHANGES = (
    *("trip.reset", "trip.skipped", "mission.repeated", "mission.extended", "mission.changed"),
    "mission.replanned",
)


_IN_A_HOOK = re.compile(
    r"(hook|policy|evaluator|modifier) \w+ "
    r"(raised|must|changed|asks|adds|declares|returned|made|took|left)\b"
)
"""The beginnings of reasons for which a mission fails by the app's own code."""


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialResult:
    """The outcome of a case."""

    violations: tuple[str, ...]
    """Violations that no run may have, with any hooks."""
    faults: tuple[str, ...]
    """Faults of the app's own code that were not injected."""
    fired: Counter[str]
    """How often each fault really occurred."""
    lives: int
    ends: dict[str, str]
    """By mission, its final status."""
    events: tuple[Event, ...]
    """All durable events."""
    times: tuple[float, ...]
    """When each row was written, durable or not, by the world's clock."""
    acts: tuple[Act, ...]
    """The actions in the world."""

    @property
    def rows(self) -> int:
        """How many rows the journal had over all runs, with lost ones."""
        return len(self.times)

    @property
    def wrong(self) -> tuple[str, ...]:
        """All violations and faults."""
        return (*self.violations, *self.faults)


class TrialRecord:
    """What outlives a brain and is not part of the world."""

    def __init__(self, app: App, case: Case) -> None:
        self._app, self._missions = app, case.missions
        self._rows: dict[tuple[str, tuple[str | int, ...]], str] = {}
        """The durable rows, by their tables and keys, as JSON."""
        self._time = 0.0
        self.times: list[float] = []
        """When each row was written, durable or not."""
        self.acts: list[Act] = []
        self.events: list[Event] = []
        self.ends: dict[str, str] = {}
        """By mission, its final status."""
        self.known: dict[str, Memory] = {}
        """By mission, what the next run must restore."""
        self.delays = 0.0
        """The total seconds of delays."""
        self.once = ExactlyOnce(
            {
                name: action.repeat
                for name, action in app.actions.items()
                if not isinstance(action, FollowDeclared)  # flown by the brain, picture by picture
            }
        )
        self.fired: Counter[str] = Counter()
        self.endless = ""
        """A mission that flies again and again without end, if any."""
        self._bound = Bound(case.missions)
        self.found: list[str] = []
        self.faults: list[str] = []
        self._invariants = Invariants(items_of(case.missions))

    @property
    def waits(self) -> list[str]:
        """The missions that have not ended."""
        return [m.name for m in self._missions if self.ends.get(m.name) not in ENDS]

    def commit(self, entry: Entry, events: list[Event]) -> None:
        """Add a durable entry."""
        for table, key, row in entry.rows:
            self._rows[table, key] = written(row)
        for event in events:
            self._time = float(str(event["t"]))
            self.events.append(event)
            self._invariants.take(event)
            self.once.take(event)
            try:
                self._bound.look(event)
            except Enough:
                self.endless = str(event["mission"])
            if event["event"] == "mission.ended":
                self._end(event)
            elif event["event"] == "trip.delayed":
                self.delays += event["until"] - event["t"]

    def _end(self, event: Event) -> None:
        mission, reason = str(event["mission"]), str(event["reason"])
        self.ends[mission] = str(event["status"])
        if _IN_A_HOOK.match(reason) and BrokenHook.__name__ not in reason:
            self.faults.append(f"{at(event)}: {mission} failed: {reason}")

    def did(self, job: str, action: str, now: float) -> None:
        """Add an action of the world."""
        self.acts.append(Act(job=_TAKEN_OVER.sub("", job), action=action, time=now))

    def hook_did(self, hook: Callable[..., object], args: tuple[object, ...], now: float) -> None:
        """Add the action of a hook that has returned, if it is one."""
        if any(action.hook is hook for action in self._app.actions.values()):
            context: Any = args[2]
            flight = context._latest()
            self.did(flight.id, flight.trip.action, now)

    def answer(self, name: str, records: Standing) -> str:
        """Return the true answer to a mission's question, as a user would who checks it."""
        record = records.missions[name]
        if record["held"]:
            return "cancel"
        flight = record["flight"]
        job = _TAKEN_OVER.sub("", id_of(name, flight))
        return "done" if any(act.job == job for act in self.acts) else "not-done"

    def decide(self, records: Standing) -> bool:
        """Answer open questions in the journal of an app that does not run; return whether there were any."""
        asking = [
            name
            for name, record in records.missions.items()
            if not record["ended"] and (record["question"] or record["held"])
        ]
        for name in asking:
            entry = decided(records, name, self.answer(name, records))
            self.fired["decision at rest"] += 1
            self.commit(entry, json.loads(entry.events))
        return bool(asking)

    def standing(self) -> Standing:
        """Return where everything stands, by the durable rows."""
        rows = [(table, key, row_of(table, key, text)) for (table, key), text in self._rows.items()]
        return Standing(rows, self._time)

    def closed(self, lives: int) -> TrialResult:
        """Return the outcome."""
        whole = not (self.waits and self.found)
        found = self._invariants.over() if whole else self._invariants.found
        return TrialResult(
            violations=(*self.found, *found, *self.once.violations(self.acts)),
            faults=tuple(self.faults),
            fired=self.fired,
            lives=lives,
            ends=self.ends,
            events=tuple(self.events),
            times=tuple(self.times),
            acts=tuple(self.acts),
        )
