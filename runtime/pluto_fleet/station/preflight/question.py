"""What is forecast: the missions of a Start, with drones as they are now."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

from ...files.plan_check import endless
from ...flight.simulate import has_traffic

if TYPE_CHECKING:
    from ...app import App
    from ...files.fleet import FleetFile
    from ...flight.driver import Stands
    from ...shared.alone.faults import Faults
    from ...shared.domain.model import Mission
    from .present import Present

UNTIL = 2 * 3600.0
"""Seconds of virtual time after which runs of missions are cut off that would go on for ever."""


@dataclass(frozen=True, kw_only=True)
class Question:
    """A Start that has not happened yet."""

    app: App
    """Its drones move as the fleet's."""
    fleet: FleetFile
    """All drones, also those that no mission would get."""
    missions: Sequence[Mission[Any]]
    beside: Sequence[Mission[Any]] = ()
    """What is left of the missions that fly already."""
    present: Sequence[Present]
    faults: Faults
    seed: int = 0
    runs: int | None = None
    """How many; None: as many as there is time for."""
    revision: int = 0
    is_simpler: bool = False
    """Whether drones are not kept apart in it though they are in flight, as that took too long."""

    @property
    def simpler(self) -> Question | None:
        """The same in a world in which each drone has the air to itself; None: it is that already."""
        if self.is_simpler or not has_traffic(self.fleet):
            return None
        fleet = replace(self.fleet, apart=0.0)
        return None if has_traffic(fleet) else replace(self, fleet=fleet, is_simpler=True)

    @property
    def all(self) -> Sequence[Mission[Any]]:
        """All missions that a run flies, those that fly already first."""
        return [*self.beside, *self.missions]

    @cached_property
    def until(self) -> float | None:
        """When runs are cut off; None: they end by themselves."""
        return UNTIL if endless(self.all, self.app) else None

    @cached_property
    def flown(self) -> FleetFile:
        """The fleet without the drones that no mission would get."""
        there = {one.id for one in self.present if one.out is None}
        return replace(
            self.fleet, drones=tuple(one for one in self.fleet.drones if one.id in there)
        )

    @cached_property
    def stands(self) -> Stands:
        """Where those drones stand, with which charge."""
        return {one.id: (one.at, one.battery) for one in self.present if one.out is None}

    @cached_property
    def homes(self) -> Mapping[str, tuple[float, float, float]]:
        """The drones' docks."""
        return {one.id: one.home for one in self.fleet.drones}
