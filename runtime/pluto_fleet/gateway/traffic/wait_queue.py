"""Somebody who waits for a way, and what has kept it from each: most of that lasts for long."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from plutoc_runtime.time.future import Future

from .detours import Section

if TYPE_CHECKING:
    from .obstacles import Obstacle


@dataclass(slots=True, eq=False)
class Wait:
    """Somebody waits for a section."""

    section: Section
    since: float
    ways: Sequence[Section]
    over: Future[Section] = field(default_factory=Future)
    obstacles: list[Obstacle | None] = field(init=False)
    """For each of the ways, somebody who was on it when it was looked at last."""
    elders: list[Wait | None] = field(init=False)
    """For each of them, who was to have it first when nobody was on it."""

    def __post_init__(self) -> None:
        self.obstacles, self.elders = [None] * len(self.ways), [None] * len(self.ways)

    def was_kept_by(self, drones: Iterable[str]) -> bool:
        """Whether one of these was on one of the ways."""
        return any(
            obstacle is not None and obstacle.claim.drone in drones for obstacle in self.obstacles
        )
