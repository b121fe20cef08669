"""With what a station works: its folder, its fleet, and how it simulates."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..files.fleet import FleetFile


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """What does not change while a station is there."""

    folder: Path
    """Where journals are; what only the station needs is in its folder `station`."""
    fleet: FleetFile
    fleet_text: str | None = None
    image: Path | None = None
    """The floor plan."""
    sim: bool = True
    crtp_sim: int | None = None
    """How many simulated Crazyflies are flown as real ones; None: none."""
    seed: int = 0
    faults: Mapping[str, float]
    speed: float | None = None
    """How many times as fast time passes; None: as it does, or as it did."""

    @property
    def own_folder(self) -> Path:
        """What is nobody's but the station's."""
        return self.folder / "station"
