"""Shrinking a case as long as it shows the same violation."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from copy import deepcopy
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any, TypeVar

from ..files.plan_check import problems
from ..shared.domain.actions import PICK, RELEASE
from .case import FAIR
from .lives import tried

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.model import Mission
    from .case import Case, Strike, Weather
    from .explore import Finding
    from .record import TrialResult

_SOME = "·"
_NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?(?:e[+-]?\d+)?\w*")
"""A number with its unit, or the address of an object."""
_SEVERAL = re.compile(rf"{_SOME}(?:, {_SOME})+")


class MistakeKinds:
    """Classifies the violations of a case, and of cases shrunk from it."""

    def __init__(self, case: Case) -> None:
        names = sorted(set(_names(case)), key=len, reverse=True)
        self._names = re.compile(
            rf"(?<!\w)(?<!-)(?<!\d\.)(?:{'|'.join(map(re.escape, names))})(?!\w|\.\d)"
        )

    def kind(self, sentence: str) -> str:
        """Return a violation's sentence without names, times and numbers."""
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
    app: App, finding: Finding, wrong: Callable[[TrialResult], tuple[str, ...]]
) -> Callable[[Case], bool]:
    """Return a function that tells whether a smaller case shows the finding's first violation, and no other.

    A case that the fleet cannot fly shows nothing.
    """
    alike = MistakeKinds(finding.case)
    kinds = [alike.kind(sentence) for sentence in finding.sentences]

    def fails(case: Case) -> bool:
        if problems(case.missions, app, case.fleet, case.fleet.airspace):
            return False
        found = {alike.kind(sentence) for sentence in wrong(tried(app, case))}
        return kinds[0] in found and found.issubset(kinds)

    return fails


def first_the_same(finding: Finding, sentences: tuple[str, ...]) -> tuple[str, ...]:
    """Return a smaller case's violations, with the finding's first one in front."""
    alike = MistakeKinds(finding.case)
    kind = alike.kind(finding.sentences[0])
    return tuple(sorted(sentences, key=lambda sentence: alike.kind(sentence) != kind))


TRIES = 1500

T = TypeVar("T")


def shrunk(case: Case, fails: Callable[[Case], bool], tries: int = TRIES) -> Case:
    """Return a smaller case that still fails, within a number of tries."""
    again = True
    while again:
        again = False
        for smaller in _smaller(case):
            tries -= 1
            if tries < 0:
                return case
            if fails(smaller):
                case, again = smaller, True
                break
    return case


def _smaller(case: Case) -> Iterator[Case]:
    """Yield simpler cases, the simplest first."""
    for place in range(len(case.strikes)):
        yield replace(case, strikes=_without(case.strikes, place))
    yield from (
        replace(case, weather=weather)
        for weather in _fairer(case.weather)
        if weather != case.weather
    )
    for missions in _fewer(case.missions):
        smaller = replace(case, missions=missions)
        yield smaller
        yield from _moved(smaller)
    if case.fleet.world is not None:
        yield replace(case, fleet=replace(case.fleet, world=None))
    if len(case.fleet.drones) > 1:
        for place in range(len(case.fleet.drones)):
            drones = _without(case.fleet.drones, place)
            yield replace(case, fleet=replace(case.fleet, drones=drones))
    for place, strike in enumerate(case.strikes):
        for earlier in _earlier(strike):
            yield replace(
                case, strikes=(*case.strikes[:place], earlier, *case.strikes[place + 1 :])
            )


def _fairer(weather: Weather) -> Iterator[Weather]:
    """Yield the faults without one of them."""
    yield FAIR
    yield replace(weather, crash=0.0, link=0.0, action=0.0, battery=0.0)
    for field in fields(weather):
        yield replace(weather, **{field.name: getattr(FAIR, field.name)})


def _fewer(missions: tuple[Mission[Any], ...]) -> Iterator[tuple[Mission[Any], ...]]:
    if len(missions) > 1:
        for place in range(len(missions)):
            yield _without(missions, place)
    for place, mission in enumerate(missions):
        for keep in _chains(mission):
            if 0 < len(keep) < len(mission.trips):
                smaller = deepcopy(mission)
                smaller.trips = [deepcopy(mission.trips[number]) for number in keep]
                for number, trip in enumerate(smaller.trips):
                    trip.index = number
                yield (*missions[:place], smaller, *missions[place + 1 :])


def _chains(mission: Mission[Any]) -> Iterator[list[int]]:
    """Yield the trips to keep: all but one, or all but those from a pick to its release."""
    numbers = list(range(len(mission.trips)))
    for number, trip in enumerate(mission.trips):
        if trip.action == PICK:
            ends = [n for n in numbers[number:] if mission.trips[n].action == RELEASE]
            last = ends[0] if ends else number
            yield [n for n in numbers if not number <= n <= last]
        elif trip.action != RELEASE:
            yield [n for n in numbers if n != number]


def _moved(case: Case) -> Iterator[Case]:
    """Move strikes to earlier rows, as fewer missions write fewer rows."""
    if len(case.strikes) == 1:
        for row in range(1, case.strikes[0].row):
            yield replace(case, strikes=(replace(case.strikes[0], row=row),))
    elif case.strikes:
        for less in range(1, min(strike.row for strike in case.strikes)):
            yield replace(
                case,
                strikes=tuple(replace(strike, row=strike.row - less) for strike in case.strikes),
            )


def _earlier(strike: Strike) -> Iterator[Strike]:
    if strike.after:
        yield replace(strike, after=0.0)
    if strike.row > 1:
        yield replace(strike, row=strike.row // 2)
        yield replace(strike, row=strike.row - 1)


def _without(values: tuple[T, ...], place: int) -> tuple[T, ...]:
    return (*values[:place], *values[place + 1 :])
