"""One run of an app with a journal, from its start or from where an earlier run ended.

A run ends when its last mission has ended, when it is stopped, or when its process dies. The next one
begins with the journal's records and a report of the drones, however the last one ended.
"""

from __future__ import annotations

from collections.abc import Coroutine, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from ..process.text import of
from ..shared.domain.errors import BadInput
from ..shared.domain.status import IN_THE_AIR, DroneStatus
from ..shared.domain.text import place, quoted
from ..shared.domain.values import shortened
from ..shared.time.kernel import FLEET, Future, Task
from .control import Control
from .driver import begun
from .recorded_brain import RecordedBrain
from .recovery import Recovery

if TYPE_CHECKING:
    from ..jobs.reports import FleetReport
    from ..shared.domain.model import Mission

HELPLESS = 12.0
"""Seconds after which a drone on the ground would have begun to fly home, if it could."""


class RecordedFlight(RecordedBrain):
    """One run: its start, its commands and its end."""

    def __init__(self, *parts: Any, epoch: int, **more: Any) -> None:
        """`epoch` counts the runs; the rest is as for a `RecordedBrain`."""
        super().__init__(*parts, **more)
        self._epoch = epoch
        self._added: dict[str, int] = {}
        """The places in the plan of missions that came later: the records have them after their instant."""
        self.in_simulation = False
        """Whether what happens in the world of the fleet's file happens here, too."""
        self.carried_home = True
        """Whether drones that need a person are waited for when all missions have ended."""
        self._over: Future[float] = Future()
        self._ended_at: float | None = None
        self._helpless: Task[None] | None = None
        self.control = Control(self)
        self._listeners = (*self._listeners, self.control.mishaps.hear)
        self.probed, self.doubted = self.control.probed, self.control.doubt_in_flight

    # Starting and resuming

    def start(self, missions: Sequence[Mission[Any]]) -> Task[float]:
        """Fly these missions from the beginning; the task returns when the last one ended."""
        return self._set_out(self._started(missions))

    def go_on(self, planned: Sequence[Mission[Any]]) -> Task[float]:
        """Resume from the records; if the journal has no mission yet, fly the planned ones."""
        if not self.records.missions:
            return self.start(planned)
        return self._set_out(self._went_on())

    def add(self, missions: Sequence[Mission[Any]]) -> None:
        """Start more missions while others fly; raise `BadInput` if they cannot be flown."""
        if not self.is_set_out:
            raise BadInput("the drones are just being asked where they are: try again in a moment")
        known = {name: int(record["index"]) for name, record in self.records.missions.items()}
        known |= self._added
        for mission in missions:
            if mission.name in known:
                name = quoted(mission.name)
                raise BadInput(f"a mission {name} has been started already: rename the new one")
        first = 1 + max(known.values())
        for index, mission in enumerate(missions, start=first):
            mission.index = self._added[mission.name] = index
        self._begin(missions)

    def _begin(self, missions: Sequence[Mission[Any]]) -> None:
        self.driver.call(partial(self.brain.begin, begun(self.app, missions)))

    def _set_out(self, whole: Coroutine[Any, Any, float]) -> Task[float]:
        self.control.whole = task = self.kernel.spawn(whole, FLEET, "the session")
        return task

    async def _started(self, missions: Sequence[Mission[Any]]) -> float:
        records, fleet_report = self.records, await self.link.fleet_report()
        if fleet_report.drones.keys().isdisjoint(records.mended):
            # else one of them, which was repaired, is queried again
            lost = {name: one["reason"] for name, one in records.lost.items()}
            _refuse_if_none_is_ready(fleet_report, lost)
        self._note_begin()
        recovery = Recovery(self, self.control, fleet_report)
        recovery.restore()
        recovery.go_on()
        self._begin(missions)
        self.is_set_out = True
        self._rehearse()
        return await self._over

    async def _went_on(self) -> float:
        fleet_report = await self.link.fleet_report()
        self._note_begin()
        recovery = Recovery(self, self.control, fleet_report)
        recovery.restore()
        await recovery.find_out()
        recovery.settle()
        recovery.go_on()
        self.is_set_out = True
        self._rehearse()
        self.look_for_the_end()
        return await self._over

    def _rehearse(self) -> None:
        """Have happen what happens in the simulated world; what has happened already does not again."""
        world = self.fleet.world
        if self.in_simulation and world is not None:
            self.driver.tell({"happens": world.events})

    def _note_begin(self) -> None:
        if self.clock:
            clock = {name: self.clock[name] for name in ("began", "drift")}
            self.recorder.fact("clock", clock)
        self.note("brain.began", epoch=self._epoch, **self.clock)

    # The end

    def look_for_the_end(self) -> None:
        """End the run if every mission has ended and every drone is down; missions may wait for people."""
        if self._over.is_set or not self.is_set_out or self.driver.halted:
            return
        if self.brain.living or self.control.waits:
            self._ended_at = None
        elif self._ended_at is None:
            self._ended_at = self.kernel.now
        if self._ended_at is None:
            return
        if self.brain.over is not None:
            self._over.set(self._ended_at)
        elif not self.carried_home and self._helpless is None:
            self._helpless = self.kernel.spawn(
                self._wait_for_people(), FLEET, "drones need a person"
            )

    async def _wait_for_people(self) -> None:
        """End the run, too, if all that keeps it are drones that stand on the ground and need a person."""
        since: dict[str, float] = {}
        while self._ended_at is not None and not self._over.is_set:
            now, drones = self.kernel.now, self.brain.drones()
            stand = {id: DroneStatus(one["status"]) for id, one in drones.items()}
            under_way = {id for id, status in stand.items() if status in IN_THE_AIR}
            for id in drones:
                stands = stand[id] is DroneStatus.RECOVERING and drones[id]["landed"]
                if id in under_way and stands:
                    since.setdefault(id, now)
                else:
                    since.pop(id, None)
            if under_way and all(now - since.get(id, now) >= HELPLESS for id in under_way):
                for id in drones:
                    if id in under_way:
                        where = place(drones[id]["at"])
                        text = f"{id} stands at {where} and needs a person: go and look"
                        self.note("log", mission=None, text=text)
                self._over.set(self._ended_at)
                break
            await self.kernel.sleep(1.0)
        self._helpless = None


def _refuse_if_none_is_ready(fleet_report: FleetReport, lost: Mapping[str, str]) -> None:
    """Raise `BadInput` if no drone may fly: nothing has begun."""
    reasons = {
        drone: (
            f"it is lost, and was not brought back ({lost[drone]})"
            if drone in lost
            else "; ".join(one.problems)
        )
        for drone, one in fleet_report.drones.items()
    }
    problems = [of(drone, reason) for drone, reason in reasons.items()]
    if problems and all(reasons.values()):
        whole = shortened(["no drone is ready to fly", *problems])
        raise BadInput(f"{whole}\nnothing has begun: mend that, and begin anew, with a new journal")
