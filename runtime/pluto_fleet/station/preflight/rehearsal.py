"""One run, written down as a journal would: what pages would be shown of it, and for what its missions wait."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, field
from math import inf
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...journal.event_line import exact
from ...journal.facts import SHOWN
from ...shared.domain.actions import PICK
from ...shared.fleet.reach import Reach, chain_of
from ...shared.hooks.plain_data import trip_of
from .. import rows
from ..shown import Noted
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
    """Writes one run down while it is flown."""

    def __init__(self, question: Question, path: Path, every: float) -> None:
        """`every`: the seconds between two looks."""
        self._question = question
        self._now = 0.0
        self._file = path.open("w", encoding="utf-8")
        self._noted = Noted()
        app = question.app
        self._reasons = WaitReasons(app, question.flown, lambda: self._now)
        self._fit = _Fit(question)
        looks = max(1, MISSIONS_IN_ALL // max(1, len(question.all)))
        self._missions_every = max(every, every * FRAMES / looks)
        self._looked_at = -self._missions_every
        self._missions: list[MissionRow] = []
        self._out = [_out_row(one.id, one.out) for one in question.present if one.out is not None]
        self.waits = Waits()
        self.take({"t": 0.0, "event": "rehearsal.begun", "sim": True})

    def take(self, event: Event) -> None:
        """Write an event down."""
        self._file.write(f"[{exact(event)}]\n")

    def look(self, brain: Brain, now: float, drones: Mapping[str, Telemetry]) -> None:
        """Write down how everything stands."""
        since, self._now = now - self._now, now
        where, stand = brain.whereabouts(), brain.drones()
        over = not where
        if over or now - self._looked_at >= self._missions_every:
            passed = now - max(0.0, self._looked_at)
            self._looked_at = now
            self._missions = self._rows_of(brain, where, stand, passed)
        self.waits.seconds += since
        state = {
            "phase": "over" if over else "flying",
            "plan": self._question.revision,
            "map": 0,
            "fleet": len(stand),
            "said": "",
            "how": None,
            "busy": "",
        }
        rows_now = [*self._drone_rows(where, stand, drones), *self._out]
        changes = self._noted.changes(state, {"missions": self._missions, "drones": rows_now})
        if changes:
            self.take({"t": round(now, 3), "event": SHOWN, **changes})

    def finish(self) -> None:
        """End it."""
        self._file.close()

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
            app = self._question.app
            why = self._reasons.why
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
