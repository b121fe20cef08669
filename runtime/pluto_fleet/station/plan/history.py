"""The last changes of a plan, and who made them: each person takes back their own, and nothing of another's."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING

from ...shared.domain.errors import BadInput
from ...shared.domain.text import quoted
from .merge import Collision, Part, first_shared, merged, touched
from .shape import trips_of

if TYPE_CHECKING:
    from .shape import Shape

MOST = 200
"""The most changes that are kept."""

MOST_TRIPS = 100_000
"""The most trips, in all missions that were changed, that are kept."""


class Step(Enum):
    """How a plan was changed."""

    EDIT = "edit"
    UNDO = "undo"
    REDO = "redo"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Change:
    """One change of the plan."""

    revision: int
    """The plan's, after it."""
    by: str
    """Which browser made it; empty: the station, or one that does not say."""
    step: Step
    before: Sequence[Shape]
    after: Sequence[Shape]
    parts: frozenset[Part]
    trips: int


class PlanHistory:
    """The changes of one plan, oldest first."""

    def __init__(self) -> None:
        self._changes: deque[Change] = deque()
        self._trips = 0
        self._undo: dict[str, list[Change]] = {}
        self._redo: dict[str, list[Change]] = {}

    def note(
        self,
        revision: int,
        before: Sequence[Shape],
        after: Sequence[Shape],
        by: str = "",
        step: Step = Step.EDIT,
    ) -> None:
        """Add a change."""
        parts = frozenset(touched(before, after))
        keys = {part[0] for part in parts}
        trips = sum(len(trips_of(one)) for one in (*before, *after) if one["key"] in keys)
        change = Change(
            revision=revision,
            by=by,
            step=step,
            before=before,
            after=after,
            parts=parts,
            trips=trips,
        )
        self._changes.append(change)
        self._trips += trips
        while len(self._changes) > MOST or (self._trips > MOST_TRIPS and len(self._changes) > 1):
            self._trips -= self._changes.popleft().trips
        if not by:
            return
        undo, redo = self._undo.setdefault(by, []), self._redo.setdefault(by, [])
        if step is Step.EDIT:
            redo.clear()
        else:
            (undo if step is Step.UNDO else redo).pop()
        (redo if step is Step.UNDO else undo).append(change)
        self._forget()

    def without_last(self, by: str, step: Step, missions: Sequence[Shape]) -> list[Shape]:
        """Return the missions without the last change of a browser, or, to redo, without its last undo.

        Raises `BadInput` if there is none, or others have changed the same since.
        """
        own = (self._undo if step is Step.UNDO else self._redo).get(by)
        if not by or not own:
            raise BadInput(f"there is nothing of yours to {step.value}")
        change = own[-1]
        since = [one for one in self._changes if one.revision > change.revision and one.by != by]
        others = {part for one in since for part in one.parts}
        shared = first_shared(change.parts, others)
        try:
            if shared is not None:
                raise Collision
            return merged(change.after, change.before, missions)
        except Collision:
            what = _called(shared, (*missions, *change.before, *change.after))
            raise BadInput(
                f"{what} was changed by another person since: look at it, and change it by hand"
            ) from None

    def can(self, by: str, step: Step) -> bool:
        """Whether a browser has something to undo, or to redo."""
        return bool((self._undo if step is Step.UNDO else self._redo).get(by))

    @property
    def changes(self) -> Sequence[Mapping[str, object]]:
        """All that are kept, for pages."""
        return [
            {"revision": one.revision, "by": one.by, "step": one.step.value}
            for one in self._changes
        ]

    def _forget(self) -> None:
        """Forget what is not kept any more, and browsers that have nothing left."""
        kept = set(self._changes)
        for stacks in (self._undo, self._redo):
            for by, stack in [*stacks.items()]:
                stack[:] = [change for change in stack if change in kept]
                if not stack:
                    del stacks[by]


def _called(part: Part | None, missions: Sequence[Shape]) -> str:
    for mission in missions:
        if part and mission["key"] == part[0]:
            return f"mission {quoted(str(mission['name']))}"
    return "the order of the missions"
