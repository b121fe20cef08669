"""Can the fleet fly what is drawn? Asked beside the loop that flies: a crowded map takes long."""

from __future__ import annotations

import asyncio
from collections.abc import Collection, Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from .problems import PlanProblem, nobody_can_fly
from .shape import Shape

if TYPE_CHECKING:
    from plutoc_runtime.domain.airspace import Airspace
    from plutoc_runtime.domain.app import App

    from ...files.fleet import FleetFile


class Flyable:
    """What is known of each mission, by its key: it is asked about again when it has changed."""

    def __init__(self, app: App, fleet: FleetFile) -> None:
        self._app, self._fleet = app, fleet
        self._known: dict[object, tuple[Shape, Sequence[PlanProblem]]] = {}
        self._beside = replace(fleet.airspace)  # routes are remembered: by one thread each
        self._one_at_a_time = asyncio.Lock()

    def known(self, missions: Collection[Shape]) -> Iterator[PlanProblem]:
        """Yield what keeps these missions from being flown, as far as it has been asked."""
        for mission in missions:
            if self._is_known(mission):
                yield from self._known[mission["key"]][1]

    def knows(self, missions: Collection[Shape]) -> bool:
        """Say whether everything has been asked about these missions."""
        return not self._unknown(missions)

    async def ask(self, missions: Collection[Shape]) -> None:
        """Find out what is not known of these missions, in a thread."""
        async with self._one_at_a_time:
            for mission in self._unknown(missions):
                found = await asyncio.to_thread(self._found, mission, self._beside)
                self._known[mission["key"]] = mission, found
            self._forget_all_but(missions)

    def ask_at_once(self, missions: Collection[Shape]) -> None:
        """Find it out before anything else happens."""
        for mission in self._unknown(missions):
            self._known[mission["key"]] = mission, self._found(mission, self._fleet.airspace)
        self._forget_all_but(missions)

    def _unknown(self, missions: Collection[Shape]) -> list[Shape]:
        return [mission for mission in missions if not self._is_known(mission)]

    def _forget_all_but(self, missions: Collection[Shape]) -> None:
        keys = [mission["key"] for mission in missions]
        self._known = {key: self._known[key] for key in keys if key in self._known}

    def _is_known(self, mission: Shape) -> bool:
        return self._known.get(mission["key"], (None, ()))[0] == mission

    def _found(self, mission: Shape, airspace: Airspace) -> Sequence[PlanProblem]:
        return nobody_can_fly(self._app, self._fleet, airspace, mission)
