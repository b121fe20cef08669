"""The recording of one run: what pages would be shown of it, and for what its missions wait."""

from __future__ import annotations

import time
from collections import defaultdict
from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...report.sentences import sentence_of
from ...shared.domain.actions import PICK
from ...shared.fleet.reach import Reach, chain_of
from ...shared.hooks.plain_data import trip_of
from .. import rows
from ..feed import kind_of
from ..history.recording import MOVES_EVERY, Recording
from ..wait_reasons import WaitReasons
from ..wire import DroneRow, MissionRow

if TYPE_CHECKING:
    from ...shared.brain import Brain
    from ...shared.domain.model import Telemetry, Trip
    from ...shared.domain.trace import Event
    from .question import Question

FRAMES = 1_200
"""How often a rehearsal is looked at."""

MISSIONS_IN_ALL = 30_000
"""How many missions are asked in all for where they stand: a row of each takes some 30 µs."""

MOST_CHAINS = 200
"""Of so many different trips it is worked out what they need of a drone."""

_ASIDE = {"paused": None, "question": None, "held": None}


@dataclass(kw_only=True)
class Waits:
    """For what missions have waited in a run, in seconds by mission."""

    seconds: float = 0.0
    """How long it was looked at."""
    low: dict[str, float] = field(default_factory=lambda: defaultdict(float))
    """None that could fly was free, and half of them or more were too low, or charging."""
    busy: dict[str, float] = field(default_factory=lambda: defaultdict(float))
    """None that could fly was free."""
    room: dict[str, float] = field(default_factory=lambda: defaultdict(float))
    """No more drones may fly at once."""
    few: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """The drones that could fly what a mission waited for, if fewer than all could."""
    lacks: dict[str, tuple[str, float]] = field(default_factory=dict)
    """The action of that, and the kilograms that it takes to lift."""
    first: tuple[int, Mapping[str, float]] | None = None
    """At the beginning: how many missions waited for batteries alone, and of each drone that was too low
    for them the level that the least of them needs."""


class Rehearsal:
    """Records one run while it is flown."""

    def __init__(self, question: Question, path: Path, every: float) -> None:
        """`every`: the seconds between two looks."""
        self._question, self._every = question, every
        self._now = 0.0
        self._recording = Recording(
            path,
            begun_at=round(time.time() * 1000),
            speed=max(1.0, every / MOVES_EVERY),
        )
        app = question.app
        self._reasons = WaitReasons(app, question.flown, lambda: self._now)
        self._fit = _Fit(question)
        self._lines = 0
        looks = max(1, MISSIONS_IN_ALL // max(1, len(question.all)))
        self._missions_every = max(every, every * FRAMES / looks)
        self._looked_at = -self._missions_every
        self._missions: list[MissionRow] = []
        self._out = [_out_row(one.id, one.out) for one in question.present if one.out is not None]
        self.waits = Waits()

    def take(self, event: Event) -> None:
        """Record what a console would say of an event."""
        said = sentence_of(event)
        if said is not None:
            self._lines += 1
            self._recording.tell(
                {
                    "number": self._lines,
                    "time": event["t"],
                    "mission": event.get("mission"),
                    "text": said,
                    "kind": kind_of(event),
                }
            )

    def look(self, brain: Brain, now: float, drones: Mapping[str, Telemetry]) -> None:
        """Record how everything stands."""
        since, self._now = now - self._now, now
        where, stand = brain.whereabouts(), brain.drones()
        over = not where
        if over or now - self._looked_at >= self._missions_every:
            passed = now - max(0.0, self._looked_at)
            self._looked_at = now
            self._missions = self._rows_of(brain, where, stand, passed)
        self.waits.seconds += since
        self._recording.write(
            round(now, 3),
            {
                "phase": "over" if over else "flying",
                "plan": self._question.revision,
                "said": "",
                "how": None,
                "busy": "",
            },
            self._missions,
            [*self._drone_rows(where, stand, drones), *self._out],
        )

    def finish(self) -> None:
        """End the recording."""
        self._recording.finish()

    def _rows_of(
        self,
        brain: Brain,
        where: Mapping[str, Any],
        stand: Mapping[str, Any],
        passed: float,
    ) -> list[MissionRow]:
        self._reasons.look(brain, self._question.flown)
        records = {
            name: {**_ASIDE, "promises": {}, "late": False, **record}
            for name, record in brain.standing()["missions"].items()
        }
        found, waiting = list[MissionRow](), list[tuple[str, Mapping[str, Any]]]()
        for name, record in sorted(records.items(), key=lambda item: int(item[1]["index"])):
            app, why = self._question.app, self._reasons.why
            row = rows.row_in_flight(name, records, where, self._now, app, why)
            if rows.waits_for_a_drone(row):
                waiting.append((name, record))
            found.append(row)
        self._note(waiting, stand, passed)
        return found

    def _note(
        self,
        waiting: Sequence[tuple[str, Mapping[str, Any]]],
        stand: Mapping[str, Any],
        passed: float,
    ) -> None:
        """Note for what missions wait, and since the last look did."""
        short = {id for id, one in stand.items() if one.get("aside") or one["status"] == "CHARGING"}
        free = {id for id, one in stand.items() if one["status"] == "FREE"} - short
        at_first = list[Mapping[str, Any]]()
        for name, record in waiting:
            able, lacks = self._fit.able(record)
            if len(able) < len(stand):
                self.waits.few[name], self.waits.lacks[name] = able, lacks
            if able and 2 * len(short.intersection(able)) >= len(able):
                at_first += [record] if short.issuperset(able) else []
                self.waits.low[name] += passed
            elif free.isdisjoint(able):
                self.waits.busy[name] += passed
            else:
                self.waits.room[name] += passed
        if self.waits.first is None:
            self.waits.first = len(at_first), self._fit.levels(short, at_first, stand)

    def _drone_rows(
        self,
        where: Mapping[str, Any],
        stand: Mapping[str, Any],
        drones: Mapping[str, Telemetry],
    ) -> list[DroneRow]:
        work = {one["drone"]: name for name, one in where.items() if one["drone"] is not None}
        found = list[DroneRow]()
        for id, told in stand.items():
            real = drones[id]
            drone = {**told, "at": real.location, "battery": real.battery_level}
            low = self._reasons.why_low(told)
            why, status = low or told["unready"], "LOW" if low else ""
            mission = work.get(id)
            found.append(rows.drone_row(id, drone, status=status, why=why, mission=mission))
        return found


def _out_row(id: str, why: Any) -> DroneRow:
    status = "LOST" if why["key"].endswith(".lost") else "OFFLINE"
    return rows.drone_at(id, status, None, 0, status == "OFFLINE", str(why["text"]))


class _Fit:
    """Which drones could fly what a mission has to do next, if their batteries were full."""

    def __init__(self, question: Question) -> None:
        self._app = question.app
        self._reach = Reach(question.app, question.fleet.airspace)
        self._drones = [(one, question.kind(one.id)) for one in question.flown.drones]
        self._known: dict[object, tuple[str, ...]] = {}

    def able(self, record: Mapping[str, Any]) -> tuple[tuple[str, ...], tuple[str, float]]:
        """Return those drones, and the action and the mass in kilograms for which it takes them."""
        chain = self._chain(record)
        actions = tuple(trip.action for trip in chain)
        mass = max((trip.item.mass for trip in chain if trip.item is not None), default=0.0)
        which = actions, mass
        if which not in self._known:
            self._known[which] = tuple(
                one.id
                for one, kind in self._drones
                if mass <= kind.payload and all(map(kind.can, actions))
            )
        return self._known[which], (actions[0], mass)

    def levels(
        self,
        drones: AbstractSet[str],
        records: Sequence[Mapping[str, Any]],
        stand: Mapping[str, Any],
    ) -> Mapping[str, float]:
        """Return the least level with which each of these drones could fly one of these missions."""
        chains = [self._chain(record) for record in records[:MOST_CHAINS]]
        found = dict[str, float]()
        for one, kind in self._drones:
            if one.id in drones:
                x, y, z = stand[one.id]["at"]
                every = (self._reach.level(kind, one.home, (x, y, z), chain) for chain in chains)
                if (least := min(every, default=inf)) <= 1.0:
                    found[one.id] = least
        return found

    def _chain(self, record: Mapping[str, Any]) -> Sequence[Trip]:
        todo = record["todo"][:1] if record["todo"][0]["action"] != PICK else record["todo"]
        return chain_of([trip_of(self._app, one) for one in todo])
