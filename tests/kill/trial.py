"""One flight under kill -9: killed at random moments, resumed each time, and judged at its end."""

from __future__ import annotations

import os
import signal
from collections import Counter
from collections.abc import Iterator
from contextlib import closing, suppress
from dataclasses import dataclass, field
from pathlib import Path
from random import Random
from threading import Thread

from pluto_fleet.journal.place import commands_note, gateway_folder
from pluto_fleet.journal.reader import Reader, standing_of
from pluto_fleet.journal.standing import Standing
from pluto_fleet.process.ipc import ask
from pluto_fleet.shared.domain.errors import BadInput
from tests.kill.judge import done_by_the_world, lost, mistaken, outlived, phase, unkept, wrong
from tests.kill.lives import PATIENCE, Flight, alive, eventually
from tests.kill.plans import Plan

LONGEST = 0.7
"""Seconds until something is killed."""
SOON = (0.0, 0.02, 0.2, 0.5)
"""Seconds from when it is told of an event until it is killed, about."""
PLACES = ((2.0, 3.0), (4.0, 1.0), (6.0, 5.0))
"""Where events happen that it is told of."""


def killed(brains: Counter[str], gateways: Counter[str]) -> Iterator[str]:
    """Yield how often each was killed, and what went on then."""
    for what, kills in (("brain", brains), ("gateway", gateways)):
        where = ", ".join(f"{count} {phase}" for phase, count in kills.most_common())
        yield f"{kills.total()} kill -9 of the {what}: {where or 'none'}"


@dataclass(slots=True)
class Tally:
    """All flights of one campaign."""

    brains: Counter[str] = field(default_factory=Counter)
    """Kills of the brain, by what went on."""
    gateways: Counter[str] = field(default_factory=Counter)
    ends: Counter[str] = field(default_factory=Counter)
    reasons: Counter[str] = field(default_factory=Counter)
    told: Counter[str] = field(default_factory=Counter)
    """Events that were told, by whether that was answered."""
    actions: int = 0
    """Picks and releases that the world has done."""
    decided: int = 0

    def lines(self) -> Iterator[str]:
        yield from killed(self.brains, self.gateways)
        yield f"missions: {', '.join(f'{n} {end}' for end, n in self.ends.most_common())}"
        yield from (f"  {count} × {reason}" for reason, count in self.reasons.most_common())
        answered = ", ".join(f"{count} {how}" for how, count in self.told.most_common())
        yield f"events told: {answered or 'none'}"
        yield f"items picked or released: {self.actions}; decided by a person: {self.decided}"


@dataclass(slots=True, kw_only=True)
class Trial:
    """A flight, and how it shall be killed."""

    plan: Plan
    flight: Flight
    random: Random
    victims: list[str]
    """What shall be killed, one after the other: brain, gateway."""
    tally: Tally
    early: float = 0.2
    """How often a life is killed before it need have come to its drones."""
    taken: dict[str, bool] = field(default_factory=dict)
    """By their ids, the events that it was told of: whether it has said that it has taken them over."""
    _seen: list[str] = field(default_factory=list)
    """What has been read of its journal."""
    _wrong: list[str] = field(default_factory=list)

    def run(self) -> list[str]:
        """Kill, resume, and judge; return what is wrong."""
        self.plan.write(self.flight.folder)
        self.flight.start()
        code: int | None = None
        for victim in self.victims:
            if self.random.random() >= self.early:
                self.flight.until_it_flies()
            code = self.flight.wait(self.random.uniform(0.0, LONGEST))
            if code is not None:
                break
            if self.plan.event:
                self._tell_and_kill(victim)
            else:
                self._kill(victim)
        self._end(self.flight.see_through() if code is None else code)
        return self._wrong

    def _kill(self, victim: str) -> None:
        if victim == "brain":
            if self.flight.kill():
                self.tally.brains[self._now()] += 1
            self.flight.start()
            return
        pid = gateway_of(self.flight.journal)
        if pid is not None:
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
                self.tally.gateways[self._now()] += 1

    def _tell_and_kill(self, victim: str) -> None:
        """Kill while it is told of an event: of a new one, or once more of one that it was told of."""
        known = [*self.taken]
        new = f"told {len(known)}"
        id = self.random.choice((new, new, *known[-1:]))
        teller = Thread(target=self._tell, args=(id,))
        teller.start()
        self.flight.wait(self.random.choice(SOON) * self.random.uniform(0.5, 1.5))
        self._kill(victim)
        teller.join()

    def _tell(self, id: str) -> None:
        x, y = PLACES[len(self.taken) % len(PLACES)]
        facts = {"id": id, "at": [x, y], "fields": {"level": len(self.taken)}}
        request = {"command": "raise-event", "event": self.plan.event, **facts}
        self.taken.setdefault(id, False)
        try:
            ask(commands_note(self.flight.journal), request, PATIENCE)
        except BadInput as why:  # it had ended, or ends
            self.tally.told[f"not answered: {str(why).rpartition(': ')[2]}"] += 1
        else:
            self.tally.told["answered"] += 1
            self.taken[id] = True

    def _now(self) -> str:
        """Return what went on; nothing that was on record may have gone."""
        before, self._seen = self._seen, self._rows()
        self._wrong += lost(before, self._seen)
        return phase(self._standing())

    def _end(self, code: int) -> None:
        tally, journal = self.tally, self.flight.journal
        code = self._decide(code)
        self._now()
        standing = self._standing()
        self._wrong += unkept(self.flight.lives, self._seen)
        self._wrong += wrong(journal, self._seen, standing)
        self._wrong += mistaken(self.taken, self._seen, standing)
        self._wrong += outlived(self.flight.folder, self._seen)
        if code not in (0, 1):
            self._wrong.append(f"exit code {code}: {self.flight.lives[-1][-400:]}")
        pid = gateway_of(journal)
        if pid is not None and not eventually(lambda: not alive(pid)):
            self._wrong.append(f"the gateway, process {pid}, has not ended")
        tally.actions += done_by_the_world(journal).total()
        for record in standing.missions.values():
            tally.ends[record["status"]] += 1
            if record["reason"]:
                tally.reasons[record["reason"]] += 1

    def _decide(self, code: int) -> int:
        """Say of every unknown action what the world has on record, and go on."""
        while code == 4:
            for name, record in self._standing().missions.items():
                if record["question"] is None:
                    continue
                flight = record["flight"]
                key = f"{name}/{flight['trip']}/{flight['round']}"
                known = {trip for _, trip in done_by_the_world(self.flight.journal)}
                answer = "done" if key in known else "not-done"
                said = self.flight.run("decide", str(self.flight.journal), name, answer)
                self.tally.decided += 1
                if said.code != 0:
                    self._wrong.append(f"decide: {said.err}")
                    return code
            self.flight.start()
            code = self.flight.see_through()
        return code

    def _rows(self) -> list[str]:
        """Return all that is on record."""
        if not self.flight.journal.exists():
            return []
        with closing(Reader(self.flight.journal)) as reader:
            rows = [instant.text for instant in reader.instants()]
            if reader.damaged is not None:
                self._wrong.append(reader.damaged)
        return rows

    def _standing(self) -> Standing:
        return standing_of(self.flight.journal) if self.flight.journal.exists() else Standing()


def end_gateway(journal: Path) -> None:
    """Leave no gateway of a flight behind."""
    pid = gateway_of(journal)
    if pid is not None:
        with suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)


def gateway_of(journal: Path) -> int | None:
    """Return the process of a flight's gateway; None: there is none."""
    with suppress(OSError, ValueError):
        pid = int((gateway_folder(journal) / "lock").read_text())
        if alive(pid) and b"gateway" in Path(f"/proc/{pid}/cmdline").read_bytes():
            return pid
    return None
