"""Who goes which way, and lets whom pass, when many come down at once: all of them soon.

Times are only planned with, never relied upon: what comes of it is where each rests, and who waits for whom.
Since everybody waits only for who should have been there earlier, nobody waits for ever.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from .choosing import Choice, Chooser, Goer
from .courses import Course
from .orders import planned
from .slots import Stretch

GOOD = 0.5
"""Seconds later than the slowest alone: nothing better is looked for."""


@dataclass(slots=True, eq=False)
class Timetable:
    """What everybody does."""

    courses: dict[str, Course] = field(default_factory=dict)
    stretches: dict[str, tuple[Stretch, ...]] = field(default_factory=dict)
    """From where to where each flies without a rest."""
    after: dict[str, list[tuple[int, str, int]]] = field(default_factory=dict)
    """For each: before which of its pieces it waits, for whom, until which piece is left."""
    awaited: dict[str, set[int]] = field(default_factory=dict)
    """Which of each one's pieces somebody waits for."""
    late: float = 0.0
    """When the last is down."""
    without: tuple[Goer, ...] = ()
    """Those for whom there was no way among the others."""

    def rest_after(self, drone: str, at: int, free: int) -> int:
        """Return where a drone that rests at the end of a piece rests next; there, if it must wait.

        `free`: up to which piece nobody has to pass before it. It leaves out a rest where that saves
        time, and nobody waits for what is behind it then: a long leg leaves its beginning slowly.
        """
        course, to, lasts = self.courses[drone], at, 0.0
        for stretch in self.stretches[drone]:
            if stretch.last <= at:
                continue
            lasts += course.times(stretch.first, stretch.last)[-1]
            if stretch.last > free or course.times(at, stretch.last)[-1] > lasts:
                break
            to = stretch.last
            if any(at <= piece < to for piece in self.awaited[drone]):
                break
        return to


def timetable(goers: Sequence[Goer], limit: float) -> Timetable:
    """Plan for all, so that no two come nearer than that; the first chooses first, if that does."""
    good = max((goer.courses[0].seconds for goer in goers), default=0.0) + GOOD
    chooser = Chooser(limit)
    return _written_down(goers, planned(goers, chooser, good), chooser)


def _written_down(goers: Sequence[Goer], plan: dict[Goer, Choice], chooser: Chooser) -> Timetable:
    """Write down who lets whom pass."""
    table = Timetable(without=tuple(goer for goer in goers if goer not in plan))
    done: list[tuple[str, Choice]] = []
    for goer, choice in plan.items():
        drone, course = goer.drone, choice.course
        table.courses[drone], table.stretches[drone] = course, choice.way
        table.after[drone], table.awaited[drone] = [], set()
        table.late = max(table.late, choice.down)
        for other, its in done:
            for mine, first, last in chooser.pairs(course, its.course):
                if mine and its.times[last][1] <= choice.times[mine][0]:
                    table.after[drone].append((mine, other, last))
                    table.awaited[other].add(last)
                else:
                    table.after[other].append((first, drone, mine))
                    table.awaited[drone].add(mine)
        done.append((drone, choice))
    return table
