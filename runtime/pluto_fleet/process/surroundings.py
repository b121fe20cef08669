"""What there is to see and to measure around simulated drones, as their processes are told it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ..shared.domain.airspace import Airspace
from ..shared.domain.fleet_data import WorldData
from ..shared.events.world import MovingWorld

if TYPE_CHECKING:
    from collections.abc import Sequence

    from ..shared.alone.world import World


@dataclass(frozen=True, slots=True, kw_only=True)
class Surroundings:
    """A world, as it is written for another process."""

    seed: int = 0
    data: WorldData = field(default_factory=WorldData)

    @property
    def world(self) -> MovingWorld:
        """The same as simulated drones of a gateway are in."""
        return MovingWorld(self.seed, Airspace(), self.data)


NOTHING = Surroundings()


def quantities_in(world: World) -> Sequence[str]:
    """Return what there is to measure in a world."""
    return sorted({*world.background, *(source.quantity for source in world.sources)})
