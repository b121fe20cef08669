"""The Start that is forecast: what it would fly, and the drones as it would find them."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from ...shared.alone.faults import Faults
from ...shared.domain.app import moving
from ...shared.domain.errors import BadInput
from ...shared.domain.status import TripStatus
from ...trials.case import fresh
from ..plan.promised import broken, promised
from ..words import words
from .forecast import without_runs
from .preflight import MOST_RUNS, Newer, Preflight
from .present import Present, at_rest, in_flight
from .question import Question

if TYPE_CHECKING:
    from ...app import App
    from ...shared.domain.model import Mission
    from ..between_flights import FleetHistory
    from ..config import StationConfig
    from ..plan.plan import MissionPlan
    from ..session import FlightSession
    from ..wire import Forecast


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedStart:
    """Of which Start a forecast is asked for."""

    revision: int
    """That of the plan which the page shows."""
    missions: list[str] | None = None
    """The keys of the missions to be started; None: all that Start would."""
    only_failed: bool = False
    runs: int | None = None
    """How many runs; None: as many as there is time for."""


class StartForecasts:
    """Forecasts what a Start of a station would do."""

    def __init__(
        self,
        app: App,
        config: StationConfig,
        plan: MissionPlan,
        history: FleetHistory,
        refuse: Callable[[], object],
    ) -> None:
        """`refuse` raises `BadInput` if a Start of any plan would be refused."""
        self._app = moving(app, config.fleet.motion, charges=config.fleet.charges_at_home)
        self._config, self._plan, self._history, self._refuse = config, plan, history, refuse
        self.preflight = Preflight(config.own_folder)
        plan.on_change = self.preflight.revised

    async def ask(self, asked: PlannedStart, session: FlightSession | None) -> Forecast:
        """Return the forecast; raise `BadInput` if the plan is another, or a newer one is asked for.

        Cancelling this gives it up.
        """
        if asked.runs is not None and not 1 <= asked.runs <= MOST_RUNS:
            raise BadInput(f"a forecast has from 1 to {MOST_RUNS} runs")
        await self._plan.examined()
        if asked.revision != self._plan.revision:
            raise Newer("the plan has changed")
        try:
            self._refuse()
            missions, keys = self._plan.launchable(asked.missions, asked.only_failed)
            if not missions:
                raise BadInput("there is no mission to start: make one first")
        except BadInput as error:
            problems = [
                words("preflight.refused", text, why=text) for text in str(error).split("\n")
            ]
            return without_runs(None, asked.revision, problems)
        fleet = replace(
            self._config.fleet,
            airspace=replace(self._config.fleet.airspace),
            began=time.time(),
            zone="",
        )
        beside = list(_left_of(session))
        names = {mission.name for mission in (*beside, *missions)}
        for index, mission in enumerate([*beside, *missions]):
            mission.index = index
            if "after" in mission.promises:  # what has ended is waited for no more
                after = [name for name in mission.promises["after"] if name in names]
                mission.promises = {**mission.promises, "after": after}
        question = Question(
            app=self._app,
            fleet=fleet,
            missions=missions,
            beside=beside,
            present=list(self._present(session)),
            faults=Faults(**self._config.faults) if self._config.sim else Faults(),
            seed=self._config.seed,
            runs=asked.runs,
            revision=asked.revision,
        )
        late = await broken(promised(missions), self._app, fleet)
        problems = [words("preflight.promise", text, why=text) for text in late]
        if asked.revision != self._plan.revision:
            raise Newer("the plan has changed")
        return await self.preflight.ask(question, keys, problems)

    def _present(self, session: FlightSession | None) -> Iterator[Present]:
        """Yield the drones as a Start would find them now."""
        fleet, config = self._config.fleet, self._config
        life = session.life if session is not None else None
        if life is not None and life.is_set_out:
            entries = {entry.id: entry for entry in fleet.drones}
            yield from in_flight(entries, life.brain.drones())
            return
        kinds = {category.name: category for category in self._app.categories}
        for entry in fleet.drones:
            yield at_rest(
                entry,
                kinds[entry.category],
                self._history.sightings.get(entry.id),
                self._history.records,
                now=time.time(),
                simulated=config.sim,
                speed=config.speed or 1.0,
            )


def _left_of(session: FlightSession | None) -> Iterator[Mission[Any]]:
    """Yield the missions that fly, with the trips that they have not done."""
    life = session.life if session is not None and session.lives else None
    if life is None:
        return
    for mission in life.missions:
        if not life.records.missions[mission.name]["ended"] and mission.trips:
            left = fresh(mission)
            left.promises = {}
            for trip in left.trips:  # one that flies now is supposed to fly again
                trip.status, trip.start_time, trip.end_time = TripStatus.WAITING, None, None
            yield left
