"""One run of an app with a journal, from its start or from where an earlier run ended.

A run ends when its last mission has ended, when it is stopped, or when its process dies. The next one
begins with the journal's records and a report of the drones, however the last one ended.
"""

from __future__ import annotations

from collections.abc import Coroutine, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from plutoc_runtime.domain.errors import BadInput
from plutoc_runtime.domain.text import quoted
from plutoc_runtime.flow.engine import Listener, Session
from plutoc_runtime.time.kernel import FLEET, Kernel, Task

from ..files.reading import shortened
from ..journal.durable_link import DurableLink
from ..journal.recorder import Recorder, Sink
from ..process.signal_guard import guard_hooks
from ..process.text import of
from .abort import DeferredAbort
from .control import Control
from .live_engine import LiveEngine, live_engine
from .live_fleet import LiveFleet, live_fleet
from .recovery import go_on

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Mission
    from plutoc_runtime.domain.trace import Event

    from ..files.fleet import FleetFile
    from ..jobs.job import CommandLink
    from ..jobs.reports import FleetReport
    from ..journal.fold import Records


class RecordedFlight:
    """A session whose events are durable before they have any effect outside."""

    def __init__(
        self,
        app: App,
        fleet: FleetFile,
        kernel: Kernel,
        link: CommandLink,
        sink: Sink,
        records: Records,
        *,
        epoch: int,
        listeners: Sequence[Listener] = (),
        watcher: Listener | None = None,
    ) -> None:
        """`watcher` is called with an event only when it is durable, `listeners` at once."""
        guard_hooks()
        self._kernel, self._link, self._epoch = kernel, link, epoch
        self.recorder = Recorder(app, kernel, sink, records)
        navigation = DurableLink(link, self.recorder)
        heard: list[Listener] = [self.recorder.take, self._forget, *listeners]
        if watcher is not None:
            heard.append(partial(self._when_durable, watcher))
        self.session = Session(
            app,
            fleet,
            kernel,
            navigation,
            heard,
            self.recorder,
            DeferredAbort(link),
            LiveFleet,
            LiveEngine,
        )
        self.control = Control(self.session, link)
        self._retired: Sequence[str] = records.retired
        self._mended: Sequence[str] = records.mended
        self._lost: Mapping[str, Any] = records.lost
        self.missions: tuple[Mission[Any], ...] = ()
        """All missions, also those that ended in earlier runs."""

    def _forget(self, event: Event) -> None:
        """Remove from the gateway's ledger what is durable in the journal."""
        if event["event"] in ("trip.completed", "trip.failed"):
            mission, trip = event["mission"], event["trip"]
            id = f"{mission}/{trip}/{event['round']}/{event['attempt']}"
            self.recorder.when_durable(partial(self._link.forget, id))

    def _when_durable(self, watcher: Listener, event: Event) -> None:
        if event["event"] == "trip.completed":
            records = self.recorder.records
            trip = records.flown_last(str(event["mission"]))
            event = {**event, "result": records.results[-1][-1], "did": trip}
        self.recorder.when_durable(partial(watcher, event))

    def start(self, missions: Sequence[Mission[Any]]) -> Task[float]:
        """Fly these missions from the beginning; the task is as that of `Session.start`."""
        return self._set_out(self._started(missions))

    def go_on(self, planned: Sequence[Mission[Any]]) -> Task[float]:
        """Resume from the records; if the journal has no mission yet, fly the planned ones."""
        if not self.recorder.records.missions:
            return self.start(planned)
        return self._set_out(self._went_on())

    def add(self, missions: Sequence[Mission[Any]]) -> None:
        """Start more missions while others fly; raise `BadInput` if they cannot be flown."""
        if not self.missions:
            raise BadInput("the drones are just being asked where they are: try again in a moment")
        for name in {one.name for one in self.missions} & {one.name for one in missions}:
            raise BadInput(f"a mission {quoted(name)} has been started already: rename the new one")
        first = 1 + max(mission.index for mission in self.missions)
        for index, mission in enumerate(missions, start=first):
            mission.index = index
        self.missions += tuple(missions)
        live_engine(self.session).add(missions)

    def _set_out(self, whole: Coroutine[Any, Any, float]) -> Task[float]:
        self.control.whole = task = self._kernel.spawn(whole, FLEET, "the session")
        return task

    async def _started(self, missions: Sequence[Mission[Any]]) -> float:
        core = self.session.core
        fleet_report = await self._link.fleet_report()
        if fleet_report.drones.keys().isdisjoint(self._mended):  # else one of them is queried again
            _refuse_if_none_is_ready(
                fleet_report, {name: one["reason"] for name, one in self._lost.items()}
            )
        core.trace.note("brain.began", epoch=self._epoch)
        self._retire()
        for drone in core.fleet.drones:
            live_fleet(core).take_up(drone, fleet_report.drones[drone.id])
        self.session.set_out(missions)
        self.missions = tuple(missions)
        return await self.session.see_through()

    async def _went_on(self) -> float:
        session, records = self.session, self.recorder.records
        fleet_report = await self._link.fleet_report()
        session.core.trace.note("brain.began", epoch=self._epoch)
        self._retire()
        missions = await go_on(
            session.core, live_engine(session), self._link, fleet_report, records
        )
        self.missions = tuple(missions)
        return await session.see_through()

    def _retire(self) -> None:
        """Do not allocate drones that were retired or lost in an earlier run.

        Those that were repaired and not back when it ended are queried again.
        """
        fleet = live_fleet(self.session.core)
        fleet.retired.update(drone for drone in fleet.drones if drone.id in self._retired)
        fleet.lost.update(
            {
                drone: self._lost[drone.id]["reason"]
                for drone in fleet.drones
                if drone.id in self._lost
            }
        )
        for drone in self._mended:
            self._link.mended(drone)


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
