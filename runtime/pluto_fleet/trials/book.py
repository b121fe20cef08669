"""What is known of a trial: what is on record, what the world has seen, and what of it may not be."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from plutoc_runtime.alone.simulate import Bound

from ..journal.fold import Records
from .acts import Act, Once
from .brain import BrokenHook
from .invariants import ENDS, Invariants, items_of
from .rule import at

if TYPE_CHECKING:
    from random import Random

    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.trace import Event

    from .case import Case
    from .survival import Known

_IN_A_HOOK = re.compile(
    r"(hook|policy|evaluator|modifier) \w+ "
    r"(raised|must|changed|asks|adds|declares|returned|made|took|left)\b"
)
"""How the reason begins for which a mission fails when the app's own code is at fault."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Trial:
    """What came of a case."""

    violations: tuple[str, ...]
    """What no run may do, whatever the app's own code does."""
    faults: tuple[str, ...]
    """What the app's own code did wrong without being made to."""
    fired: Counter[str]
    """How often each thing really struck."""
    lives: int
    ends: dict[str, str]
    """By mission, how it ended."""
    events: tuple[Event, ...]
    """All that is on record."""
    times: tuple[float, ...]
    """When each row was written, durable or not, by the world's clock."""
    acts: tuple[Act, ...]
    """What the world has seen."""

    @property
    def rows(self) -> int:
        """How many rows the journal had, over all lives, those that were lost included."""
        return len(self.times)

    @property
    def wrong(self) -> tuple[str, ...]:
        """All that should not be."""
        return (*self.violations, *self.faults)


class Book:
    """Everything that outlives a brain, and is no part of the world."""

    def __init__(self, app: App, case: Case) -> None:
        self._app, self._missions = app, case.missions
        self.rows: list[str] = []
        """What is durable."""
        self.times: list[float] = []
        """When each row was written, durable or not."""
        self.acts: list[Act] = []
        self.events: list[Event] = []
        self.ends: dict[str, str] = {}
        """By mission, how it has ended."""
        self.known: dict[str, Known] = {}
        """By mission, what the next life must know."""
        self.delays = 0.0
        """Seconds that trips were to wait."""
        self.once = Once({name: action.repeat for name, action in app.actions.items()})
        self.fired: Counter[str] = Counter()
        self.endless = ""
        """The mission that sets out again and again, if one does."""
        self._bound = Bound(case.missions)
        self.found: list[str] = []
        self.faults: list[str] = []
        self._invariants = Invariants(items_of(case.missions))

    @property
    def waits(self) -> list[str]:
        """The missions that have not ended."""
        return [m.name for m in self._missions if self.ends.get(m.name) not in ENDS]

    def commit(self, row: str, events: list[Event]) -> None:
        """A row is durable."""
        self.rows.append(row)
        for event in events:
            self.events.append(event)
            self._invariants.take(event)
            self.once.take(event)
            if self._bound.look(event) is not None:
                self.endless = str(event["mission"])
            if event["event"] == "mission.ended":
                self._end(event)
            elif event["event"] == "trip.delayed":
                self.delays += float(str(event["until"])) - float(str(event["t"]))

    def _end(self, event: Event) -> None:
        mission, reason = str(event["mission"]), str(event["reason"])
        self.ends[mission] = str(event["status"])
        if _IN_A_HOOK.match(reason) and BrokenHook.__name__ not in reason:
            self.faults.append(f"{at(event)}: {mission} failed: {reason}")

    def did(self, job: str, action: str, now: float) -> None:
        """The world has seen that an action was done."""
        self.acts.append(Act(job=job, action=action, time=now))

    def hook_did(self, hook: Callable[..., object], args: tuple[object, ...], now: float) -> None:
        """A hook has returned: if it is an action of the app's own, that was done."""
        if any(action.hook is hook for action in self._app.actions.values()):
            context: Any = args[2]
            flight = context._state.flight
            self.did(flight.id, flight.trip.action, now)

    def answer(self, name: str, records: Records) -> str:
        """Say what is true about a mission that asks: somebody looks whether it was done."""
        record = records.missions[name]
        if record["held"]:
            return "cancel"
        flight = record["flight"]
        job = f"{name}/{flight['trip']}/{flight['round']}/{flight['attempt']}"
        return "done" if any(act.job == job for act in self.acts) else "not-done"

    def decide(self, records: Records) -> bool:
        """Decide what waits, on the journal of an app that does not run; say whether any did."""
        asking = [
            name
            for name, record in records.missions.items()
            if not record["ended"] and (record["question"] or record["held"])
        ]
        for name in asking:
            answer = self.answer(name, records)
            event = {
                "t": records.time,
                "event": "mission.decided",
                "mission": name,
                "answer": answer,
            }
            self.fired["decision at rest"] += 1
            self.commit(json.dumps([event]), [event])
        return bool(asking)

    def records(self, snapshot: float, chance: Random) -> Records:
        """Read the journal; perhaps from a snapshot of a part of it."""
        records, rows = Records(), iter(self.rows)
        if self.rows and chance.random() < snapshot:
            for _ in range(chance.randrange(len(self.rows)) + 1):
                for event in json.loads(next(rows)):
                    records.take(event)
            self.fired["snapshot"] += 1
            records = Records(json.loads(json.dumps(records.data)))
        for row in rows:
            for event in json.loads(row):
                records.take(event)
        return records

    def closed(self, lives: int) -> Trial:
        """Return what came of it all."""
        whole = not (self.waits and self.found)
        found = self._invariants.over() if whole else self._invariants.found
        return Trial(
            violations=(*self.found, *found, *self.once.violations(self.acts)),
            faults=tuple(self.faults),
            fired=self.fired,
            lives=lives,
            ends=self.ends,
            events=tuple(self.events),
            times=tuple(self.times),
            acts=tuple(self.acts),
        )
