"""What a navigation is told of its drone when it is made."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from plutoc_runtime.domain.model import Point


@dataclass(frozen=True, slots=True, kw_only=True)
class DroneSetup:
    """One drone of the fleet file, for the navigation that is to fly it."""

    id: str
    """Its name in the fleet file: name it in what you raise."""
    uri: str | None
    """How to reach it, in the words of its library; None: the fleet file does not say."""
    home: Point
    """Where it stands when it is at home, in the map's frame."""
    speed: float
    """The most that its category permits, metres per second."""
    options: Mapping[str, object]
    """The table `[navigation.NAME]` of the fleet file, the drone's own `[drone.options]` on top."""
    folder: Path
    """Where it may keep files, such as photos; shared by all drones, and there already."""
