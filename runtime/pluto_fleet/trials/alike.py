"""Whether two mistakes are the same: what their sentences say but for names and numbers."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from ..files.plan_check import problems
from .rig import tried

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App

    from .book import Trial
    from .case import Case
    from .explore import Finding

_SOME = "·"
_NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?\w*")
"""With its unit; or the address of an object."""
_SEVERAL = re.compile(rf"{_SOME}(?:, {_SOME})+")


class Alike:
    """Tells the kinds of mistakes of one case apart, and of those that are made from it."""

    def __init__(self, case: Case) -> None:
        names = sorted(set(_names(case)), key=len, reverse=True)
        self._names = re.compile(
            rf"(?<!\w)(?<!\d\.)(?:{'|'.join(map(re.escape, names))})(?!\w|\.\d)"
        )

    def kind(self, sentence: str) -> str:
        """Return the sentence with nothing of who, when and how much: the rule that is broken, and how."""
        return _SEVERAL.sub(_SOME, _NUMBER.sub(_SOME, self._names.sub(_SOME, sentence)))


def _names(case: Case) -> Iterator[str]:
    yield from (drone.id for drone in case.fleet.drones)
    for mission in case.missions:
        yield mission.name
        for trip in mission.trips:
            yield trip.name
            if trip.item is not None:
                yield trip.item.name


def shows_the_same(
    app: App, finding: Finding, wrong: Callable[[Trial], tuple[str, ...]]
) -> Callable[[Case], bool]:
    """Return what says of a smaller case whether it shows the finding's first mistake, and no other.

    A case that the fleet cannot fly shows nothing: it is refused before anything can go wrong.
    """
    alike = Alike(finding.case)
    kinds = [alike.kind(sentence) for sentence in finding.sentences]

    def fails(case: Case) -> bool:
        if problems(case.missions, app, case.fleet, case.fleet.airspace):
            return False
        found = {alike.kind(sentence) for sentence in wrong(tried(app, case))}
        return kinds[0] in found and found.issubset(kinds)

    return fails


def first_the_same(finding: Finding, sentences: tuple[str, ...]) -> tuple[str, ...]:
    """Return what is said of a smaller case, what the finding says first in front."""
    alike = Alike(finding.case)
    kind = alike.kind(finding.sentences[0])
    return tuple(sorted(sentences, key=lambda sentence: alike.kind(sentence) != kind))
