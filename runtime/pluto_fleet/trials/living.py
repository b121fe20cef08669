"""One life of an app in a trial: what it writes down, what strikes it, and how it ends."""

from __future__ import annotations

import json
from collections import deque
from functools import partial
from typing import TYPE_CHECKING

from plutoc_runtime.domain.errors import BadInput, Cancelled, Failure

from ..flight.recorded_flight import Life
from ..jobs.reports import Down
from .blows import BY_HAND, DEATHS, STOPS, Blow, Kind
from .brain import BrainTime
from .case import fresh
from .invariants import ENDS
from .survival import Known, forgotten, known_of
from .wire import Wire

if TYPE_CHECKING:
    from collections.abc import Callable

    from plutoc_runtime.domain.trace import Event

    from ..journal.fold import Records
    from .rig import Rig

THINKS = 20.0
"""Seconds after which a person looks, and decides."""
STOPPED = 45.0
"""Seconds for which an app that was stopped stays so."""

_read = json.JSONDecoder().raw_decode
"""A row begins and ends with its list: there is nothing around it to look for."""

_NONE: frozenset[Kind] = frozenset()


class Living:
    """One life, in the rig."""

    def __init__(self, rig: Rig, records: Records) -> None:
        self.rig, case = rig, rig.case
        now = max(rig.world.now + rig.skew, records.time)
        self.skew = rig.skew = now - rig.world.now
        self.kernel = BrainTime(now, case.weather, rig.chance, rig.fired, self.hook_returned)
        link = rig.gateway.link(rig.lives, self.lost)
        self.wire = Wire(link, rig.gateway, self.kernel, case.weather.slow, rig.fired, self.sent)
        self.added = self.committed = 0
        self.unwritten: deque[tuple[int, str, list[Event]]] = deque()
        self.unknown: dict[str, None] = {}
        """The missions of which something is not on record."""
        self.full = False
        planned = () if records.missions else tuple(map(fresh, case.missions))
        self.before: dict[str, Known] = {} if planned else dict(rig.book.known)
        self.life = Life(
            rig.app,
            case.fleet,
            self.kernel,
            self.wire,
            self,
            records,
            epoch=rig.lives,
        )
        self.life.control.stopped.watch(self.stopped)
        self.task = self.life.go_on(planned)
        self.due: list[Callable[[], object]] = []
        rig.later(THINKS, self.person)

    def take_turn(self) -> None:
        """Let it do what is due."""
        kernel, rig = self.kernel, self.rig
        kernel.drain()
        if kernel.settled is not None:
            kernel.settled()
        if kernel.crashed is not None:
            rig.raise_from(kernel)
        if self.due:
            due, self.due = self.due, []
            for call in due:
                call()
        if not self.task.is_set:
            return
        error = self.task.error
        if rig.brain is not self or isinstance(error, Cancelled):
            return
        if error is not None:
            rig.blame(error)
        elif self.committed == self.added:  # else what happened last is not durable yet
            rig.ended(self)

    def hook_returned(self, hook: Callable[..., object], args: tuple[object, ...]) -> None:
        """What an action of the app's own does is done to the world, if its drone is still there."""
        if self.rig.brain is self:
            self.rig.book.hook_did(hook, args, self.rig.world.now)

    def haunt(self) -> None:
        """Go on although another brain has taken over."""
        self.kernel.now = max(self.kernel.now, self.rig.world.now + self.skew)
        self.kernel.drain()
        if self.kernel.settled is not None:
            self.kernel.settled()

    def sent(self, job: str) -> None:
        """A drone is sent on its way."""
        if self.rig.brain is self and not self.rig.book.once.knows(job):
            self.rig.found.append(f"{self.kernel.now:g} s: {job} set out before that was on record")

    # The journal

    def add(self, row: str) -> int:
        """Take the row of an instant."""
        rig = self.rig
        self.added += 1
        if rig.brain is not self:  # somebody else has the journal by now
            return self.added
        rig.book.times.append(rig.world.now)
        events: list[Event] = _read(row)[0]
        if self.before:
            self.look_back(events)
        struck = rig.strikes.get(len(rig.book.times))
        kinds = {blow.kind for blow in struck if not blow.after} if struck else _NONE
        if Kind.DISK in kinds:
            self.full = True
            rig.fired[Kind.DISK.value] += 1
            rig.later(0.5, self.give_up)
        if self.full or Kind.LOST in kinds:
            self.forget(events)
        else:
            self.unwritten.append((self.added, row, events))
            commit = partial(self.commit, self.added, Kind.KEPT not in kinds)
            if kinds & {Kind.KEPT, Kind.CRASH} or not rig.case.weather.disk:
                self.due.append(commit)
            else:
                rig.fired["slow disk"] += 1
                rig.later(rig.case.weather.disk, commit)
        for blow in struck or ():
            if blow.kind is not Kind.DISK:
                self.due.append(partial(self.plan, blow, events))
        return self.added

    def commit(self, number: int, told: bool) -> None:
        """All rows up to this one are durable, if the disk was as fast as the brain's death."""
        if self.rig.brain is not self or self.full or number <= self.committed:
            return
        while self.unwritten and self.unwritten[0][0] <= number:
            self.committed, row, events = self.unwritten.popleft()
            self.rig.book.commit(row, events)
        if told:
            self.life.recorder.durable(number)

    def forget(self, events: list[Event]) -> None:
        """What is not on record need not be known again."""
        self.unknown.update((str(event["mission"]), None) for event in events if "mission" in event)

    def remember(self) -> None:
        """This life is over: what is on record of it must be known in the next."""
        for _, _, events in self.unwritten:
            self.forget(events)
        for name, mission in self.life.recorder.missions.items():
            if name in self.unknown:
                self.rig.book.known.pop(name, None)
            else:
                self.rig.book.known[name] = known_of(self.rig.app, mission)

    def look_back(self, events: list[Event]) -> None:
        """See, once it is known again, what has been forgotten since the last life."""
        now = {mission.name: mission for mission in self.life.missions}
        if not now:
            return
        before, self.before = self.before, {}
        since: dict[str, list[Event]] = {}
        for event in events:
            since.setdefault(str(event.get("mission")), []).append(event)
        found = self.rig.found
        for name, known in before.items():
            if name not in now:
                found.append(f"{name} was forgotten")
            elif self.rig.book.ends.get(name) not in ENDS:
                after = known_of(self.rig.app, now[name])
                said = forgotten(name, known, after, since.get(name, ()))
                found += [f"{self.kernel.now:g} s: {sentence}" for sentence in said]
        results = len(self.life.session.core.results.so_far())
        if results < self.rig.book.once.done:
            found.append(f"{self.rig.book.once.done} results were there, {results} are left")

    # What strikes

    def plan(self, blow: Blow, events: list[Event]) -> None:
        if blow.after:
            self.rig.later(blow.after, partial(self.strike, blow, events))
        else:
            self.strike(blow, events)

    def strike(self, blow: Blow, events: list[Event]) -> None:
        """Something strikes: the brain that wrote the row, or whichever lives by now."""
        rig, kind = self.rig, blow.kind
        brain = rig.brain
        if kind is Kind.GATEWAY:
            rig.fired[kind.value] += 1
            self.lose_gateway()
        elif kind in (Kind.REBOOT, Kind.FALL):
            named = [str(event["drone"]) for event in events if event.get("drone")]
            drone = (named or [rig.drones[0].id])[-1]
            if kind is Kind.REBOOT:
                rig.fired[kind.value] += 1
                rig.navigation.reboot(drone)
            elif self.flies(drone) and rig.navigation.strike(drone, Failure.CRASH):
                rig.fired[kind.value] += 1
        elif kind is Kind.REPORT:
            rig.fired[kind.value] += 1
            rig.loses_report = True
        elif brain is None:
            return
        elif kind in DEATHS:
            rig.fired[kind.value] += 1
            rig.lose_brain(rig.case.weather.down)
        elif kind is Kind.FREEZE:
            rig.fired[kind.value] += 1
            rig.freeze()
        elif kind is Kind.CUT:
            rig.fired[kind.value] += 1
            rig.gateway.cut()
        elif kind in STOPS:
            rig.fired[kind.value] += 1
            how = Down.HOME if kind is Kind.RTL else Down.LAND
            brain.kernel.post(brain.life.control.stop, how)
        elif kind in BY_HAND:
            brain.by_hand(kind, events)

    def flies(self, drone: str) -> bool:
        """Whether a drone is in the air: nobody can fall from the ground."""
        return not self.rig.navigation.telemetry[drone].landed

    def by_hand(self, kind: Kind, events: list[Event]) -> None:
        named = [str(event["mission"]) for event in events if event.get("mission")]
        mission = (named or [mission.name for mission in self.rig.case.missions])[-1]
        control = self.life.control
        tell: dict[Kind, Callable[[str], str]] = {
            Kind.PAUSE: control.pause,
            Kind.SKIP: control.skip,
            Kind.CANCEL: control.cancel,
        }
        if self.told(partial(tell[kind], mission)):
            self.rig.fired[kind.value] += 1
            if kind is Kind.PAUSE:
                self.rig.later(THINKS, self.person)

    def told(self, command: Callable[[], object]) -> bool:
        """Tell the app something; say whether it could."""
        if self.task.is_set:  # it is about to end, and hears nobody any more
            return False
        try:
            command()
        except BadInput:
            return False
        return True

    def person(self) -> None:
        """Somebody looks, lets go on what is paused, and decides what waits."""
        rig = self.rig
        if rig.brain is not self:
            return
        if self.told(self.life.control.go_on):
            rig.fired["go on"] += 1
        for name, record in list(self.life.recorder.records.missions.items()):
            if not record["ended"] and (record["question"] or record["held"]):
                decide = partial(
                    self.life.control.decide,
                    name,
                    rig.book.answer(name, self.life.recorder.records),
                )
                if self.told(decide):
                    rig.fired["decision"] += 1
        if any(record["paused"] for record in self.life.recorder.records.missions.values()):
            rig.later(THINKS, self.person)

    def lost(self) -> None:
        """Brain and gateway have lost one another: the brain begins anew from its own journal."""
        if self.rig.brain is self:
            self.rig.lose_brain(0.5)

    def lose_gateway(self) -> None:
        rig = self.rig
        rig.gateway.crash()
        rig.gateway = rig.new_gateway()

    def give_up(self) -> None:
        """It has noticed that nothing can be written."""
        if self.rig.brain is self:
            self.rig.lose_brain(self.rig.case.weather.down)

    def stopped(self, _: object) -> None:
        """Everything is down: somebody goes on later."""
        self.due.append(self.rest)

    def rest(self) -> None:
        if self.rig.brain is self:
            self.rig.brain = None
            self.remember()
            self.wire.alive = False
            self.rig.gateway.cut()
            self.die()
            self.rig.later(STOPPED, self.rig.be_born)

    def die(self) -> None:
        """Nothing of it goes on."""
        if self.kernel.dead:
            return
        self.kernel.over = self.kernel.dead = True
        self.kernel.close()
