"""Forecasting what a Start would do: one at a time, the newest wins, and none holds a Stop up."""

from __future__ import annotations

import asyncio
import secrets
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import aclosing, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...process.beside import in_a_copy
from ...process.copies import Died
from ...shared.alone.world import Faults
from ...shared.domain.app import moving
from ...shared.domain.errors import BadInput
from ...shared.domain.status import TripStatus
from ...shared.domain.text import duration
from ...trials.case import fresh
from ..history.reading import REHEARSAL, rehearsals_in
from ..plan.problems import broken, promised
from ..rows import words
from .forecast import forecast, without_runs
from .question import Present, Question, at_rest, in_flight
from .runs import MOST, Flown, found

if TYPE_CHECKING:
    from ...app import App
    from ...files.fleet import FleetFile
    from ...shared.domain.model import Mission
    from ..between_flights import FleetHistory
    from ..config import StationConfig
    from ..plan.plan import MissionPlan
    from ..session import FlightSession
    from ..wire import Forecast, Words


WITHIN = 30.0
"""Seconds after which a forecast is made of the runs so far."""

FIRST_WITHIN = 12.0
"""Seconds after which a forecast whose first run has not ended is made in a simpler world, or not at all."""

KEPT = 4


class Newer(BadInput):
    """A forecast was given up, as a newer one was asked for, or the plan has changed."""

    def __init__(self, why: str) -> None:
        super().__init__(f"this forecast was given up: {why}")


class Preflight:
    """The forecasts of one station."""

    def __init__(self, own_folder: Path) -> None:
        self._folder = rehearsals_in(own_folder)
        self._running: asyncio.Task[Forecast] | None = None
        self._why = ""
        """Why the one that runs was given up."""

    async def ask(self, question: Question, keys: Sequence[str], problems: list[Words]) -> Forecast:
        """Return the forecast of a Start; raise `BadInput` if there is none to make, or a newer one wins.

        Cancelling this gives it up at once.
        """
        if not question.flown.drones:
            raise BadInput("no drone may fly: each is lost, retired, or not ready")
        self.give_up("a newer one was asked for")
        mine = asyncio.ensure_future(self._made(question, keys, problems))
        self._running = mine
        try:
            await asyncio.wait([mine])
        finally:
            if not mine.done():
                mine.cancel()
            if self._running is mine:
                self._running = None
        if mine.cancelled():
            raise Newer(self._why)
        return mine.result()

    def give_up(self, why: str) -> None:
        """End the forecast that is being made, if any."""
        if self._running is not None:
            self._why = why
            self._running.cancel()

    async def _made(
        self, question: Question, keys: Sequence[str], problems: list[Words]
    ) -> Forecast:
        id = f"rehearsal-{secrets.token_hex(8)}"
        path = self._folder / f"{id}{REHEARSAL}"
        rehearsed = None
        try:
            flown = await self._flown(question, path)
            if not flown.runs and (simpler := question.simpler) is not None:
                question, flown = simpler, await self._flown(simpler, path)
            if not flown.runs:
                raise BadInput(
                    f"not even one run of this plan was flown within {duration(FIRST_WITHIN)}:"
                    " choose fewer missions"
                )
            rehearsed = id if flown.is_recorded else None
            return forecast(question, keys, flown, rehearsed, problems)
        finally:
            with suppress(OSError):  # what stays is deleted after another forecast
                if rehearsed is None:
                    path.unlink(missing_ok=True)
                self._tidy()

    async def _flown(self, question: Question, path: Path) -> Flown:
        """Return what is found in time: nothing more if the first run takes too long."""
        flown = Flown()
        loop = asyncio.get_running_loop()
        ends = loop.time() + WITHIN
        try:
            async with (
                asyncio.timeout(FIRST_WITHIN) as limit,
                aclosing(in_a_copy(lambda: found(question, path))) as finds,
            ):
                async for one in finds:
                    flown.take(one)
                    if flown.runs:
                        limit.reschedule(ends)
        except TimeoutError:
            pass  # the forecast is made of the runs so far
        except Died as end:
            raise BadInput(
                f"the process that flew the forecast {end}: something in hooks.py ends it,"
                " or there is not enough memory"
            ) from None
        return flown

    def _tidy(self) -> None:
        """Delete all rehearsals but the newest."""
        there = sorted(self._folder.glob(f"*{REHEARSAL}"), key=lambda path: path.stat().st_mtime)
        for path in there[:-KEPT]:
            path.unlink(missing_ok=True)


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
        fleet_now: Callable[[], FleetFile],
        refuse: Callable[[], object],
    ) -> None:
        """`fleet_now` returns the fleet with the drones that have joined it; `refuse` raises `BadInput` if a
        Start of any plan would be refused.
        """
        self._fleet_now = fleet_now
        self._app = moving(app, config.fleet.motion, charges=config.fleet.charges_at_home)
        self._config = config
        self._plan = plan
        self._history = history
        self._refuse = refuse
        self.preflight = Preflight(config.own_folder)
        plan.on_change = lambda: self.preflight.give_up("the plan has changed")

    async def ask(self, asked: PlannedStart, session: FlightSession | None) -> Forecast:
        """Return the forecast; raise `BadInput` if the plan is another, or a newer one is asked for.

        Cancelling this gives it up.
        """
        if asked.runs is not None and not 1 <= asked.runs <= MOST:
            raise BadInput(f"a forecast has from 1 to {MOST} runs")
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
            return without_runs(asked.revision, problems)
        fleet = self._fleet_now()
        fleet = replace(fleet, airspace=replace(fleet.airspace), began=time.time(), zone="")
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
        fleet = self._fleet_now()
        config = self._config
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
                trip.status = TripStatus.WAITING
                trip.start_time = None
                trip.end_time = None
            yield left
