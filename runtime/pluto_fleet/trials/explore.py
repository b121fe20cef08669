"""Choosing cases, every strike at every row of a journal or random ones, and making small what was found."""

from __future__ import annotations

import gc
import re
from bisect import bisect_right
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from copy import deepcopy
from dataclasses import dataclass, field, fields, replace
from itertools import product
from random import Random
from typing import Any, TypeVar

from ..app import App
from ..files.fleet import FleetFile
from ..files.plan_check import problems
from ..shared.alone.files import readers_of
from ..shared.domain.actions import PICK, RELEASE, Plain
from ..shared.domain.fields import Entity, Field, FieldType
from ..shared.domain.model import Item, Mission, Point, Trip
from ..shared.domain.quantities import Type
from ..shared.events.declared import AlongField, TrackField
from .case import DEATHS, FAIR, STOPS, Case, Strike, StrikeKind, Weather
from .lives import tried
from .record import TrialResult

TRIES = 50
"""How often a mission is drawn until the fleet can fly it."""

_TIMES = (0.0, 2.0, 5.0, 12.0, 30.0)
_VALUES: dict[Type, Plain] = {
    Type.INT: 1,
    Type.BOOL: True,
    Type.TEXT: "x",
    Type.MASS: 0.001,
    Type.PERCENT: 0.5,
    Type.TEMPERATURE: 293.15,
}
"""Values of parameters without a default; other numbers are 1."""


def random_missions(app: App, fleet: FleetFile, seed: int) -> list[Mission[Any]]:
    """Return up to three missions of up to three trips that the fleet can fly, by a seed."""
    drawing = _Generator(app, fleet, Random(f"{seed}/missions"))
    missions: list[Mission[Any]] = []
    for _ in range(drawing.rng.choice((1, 2, 2, 3))):
        for _ in range(TRIES):
            mission = drawing.mission(len(missions))
            if not problems([mission], app, fleet, fleet.airspace):
                missions.append(mission)
                break
    return missions


def promising(missions: Sequence[Mission[Any]], seed: int) -> tuple[Mission[Any], ...]:
    """Promise something of some missions, by a seed: windows, deadlines, what they come after."""
    rng, names = Random(f"{seed}/promises"), list[str]()
    kept: list[Mission[Any]] = []
    for mission in missions:
        promises: dict[str, object] = {}
        if rng.random() < 0.4:
            promises["deadline"] = rng.choice((10.0, 40.0, 40.5, 200.0, 2_000.0))
        if "deadline" in promises and rng.random() < 0.5:
            promises["opens"] = rng.choice(_TIMES)
        if names and rng.random() < 0.3:
            promises["after"] = rng.sample(names, rng.randrange(1, 1 + len(names)))
        kept.append(replace(mission, promises=promises))
        names.append(mission.name)
    return tuple(kept)


class _Generator:
    def __init__(self, app: App, fleet: FleetFile, rng: Random) -> None:
        self.app, self.fleet, self.rng = app, fleet, rng
        self.width, self.depth = fleet.airspace.size

    def mission(self, index: int) -> Mission[Any]:
        trips: list[Trip] = []
        for _ in range(self.rng.choice((1, 2, 2, 3))):
            self.add(trips)
        mission = self.app.mission(name=f"m{index + 1}", index=index, trips=trips)
        self.fill(mission, Entity.MISSION)
        return mission

    def add(self, trips: list[Trip]) -> None:
        action = self.rng.choice([name for name in self.app.actions if name != RELEASE])
        payload = min((c.payload for c in self.app.categories if c.can(PICK)), default=0.001)
        item = Item(name=f"item{len(trips) + 1}", mass=round(payload / 2, 6))
        for name in (PICK, RELEASE) if action == PICK else (action,):
            place = len(trips)
            carries = item if action == PICK else None
            trips.append(self.trip(place, name, carries))

    def trip(self, place: int, action: str, item: Item | None) -> Trip:
        given = {
            parameter.name: (
                _VALUES.get(parameter.type, 1.0) if parameter.default is None else parameter.default
            )
            for parameter in self.app.actions[action].parameters
        }
        trip = self.app.trip(
            name=str(place + 1),
            action=action,
            target=self.spot(),
            source=self.spot() if self.rng.random() < 0.1 else None,
            parameters=given,
            item=item,
            index=place,
        )
        self.fill(trip, Entity.TRIP)
        return trip

    def spot(self) -> Point:
        airspace = self.fleet.airspace
        for _ in range(TRIES):
            x, y = (
                round(self.rng.uniform(0.3, side - 0.3), 1) for side in (self.width, self.depth)
            )
            spot = (x, y, airspace.cruise_height)
            if airspace.problem(spot) is None:
                break
        return spot

    def fill(self, entity: Mission[Any] | Trip, kind: Entity) -> None:
        for one in self.app.fields:
            if one.on is kind and (self.rng.random() < 0.6 or one.hint):
                setattr(entity, one.name, self.value(one))

    def value(self, field: Field) -> object:
        if isinstance(field, TrackField):
            return None  # nothing moves in the world of a trial
        if isinstance(field, AlongField):
            return self.along(field)
        match field.type:
            case FieldType.TIME:
                return self.rng.choice(_TIMES)
            case FieldType.TIME_OF_DAY:
                return 60.0 * self.rng.randrange(3)
            case Type.BOOL:
                return self.rng.random() < 0.5
            case Type.TEXT:
                return self.rng.choice(("", "a text", "é\n"))
            case Type.FLOAT | Type.PERCENT:
                return self.rng.random()
            case FieldType.EVALUATOR:
                return self.rng.choice((None, *self.app.evaluators))
            case _:
                return self.rng.randrange(3)

    def along(self, field: AlongField) -> object:
        name = self.rng.choice((None, *field.actions))
        if name is None:
            return None
        every = {"every": "5 s"} if name in self.app.actions else {}
        return readers_of(self.app)[field.type]({"action": name, **every})


FORGOTTEN = 100
"""The number of trials between two garbage collections."""

_MOMENTS = (0.0, 0.0, 0.4, 1.1, 2.2, 7.0)
"""Seconds after a row for strikes, also during an action."""
MOST_ROWS = 100
_MIDST = 0.6
"""Seconds before the end of an action, for a strike in its midst."""
_IN_THE_MIDST = (
    (StrikeKind.CRASH,),
    (StrikeKind.GATEWAY,),
    (StrikeKind.FREEZE,),
    (StrikeKind.CUT,),
    (StrikeKind.PAUSE,),
    (StrikeKind.GATEWAY, StrikeKind.REBOOT),
    (StrikeKind.CRASH, StrikeKind.REBOOT),
    (StrikeKind.CRASH, StrikeKind.GATEWAY),
)
_BEYOND = 14
"""The range of rows for the next strike of a random case."""


@dataclass(slots=True, kw_only=True)
class Finding:
    """A case with a violation."""

    case: Case
    sentences: tuple[str, ...]


@dataclass(slots=True, kw_only=True)
class Tally:
    """The outcome of many cases."""

    runs: int = 0
    rows: int = 0
    lives: int = 0
    missions: Counter[str] = field(default_factory=Counter)
    """The number of missions by their final status."""
    fired: Counter[str] = field(default_factory=Counter)
    findings: list[Finding] = field(default_factory=list)


def explored(
    app: App,
    cases: Iterable[Case],
    tally: Tally,
    enough: Callable[[Tally], bool],
    wrong: Callable[[TrialResult], tuple[str, ...]] = lambda trial: trial.wrong,
) -> None:
    """Try cases until all are tried or enough is found; `wrong` returns the violations of a run."""
    for case in cases:
        if enough(tally):
            return
        if not case.missions:
            continue  # the fleet can fly none that was drawn
        trial = tried(app, case)
        tally.runs += 1
        if tally.runs % FORGOTTEN == 0:
            gc.collect()  # each has kept the collector from its world
        tally.rows += trial.rows
        tally.lives += trial.lives
        tally.fired.update(trial.fired)
        tally.missions.update(trial.ends.values())
        sentences = wrong(trial)
        if sentences:
            tally.findings.append(Finding(case=case, sentences=sentences))


def everywhere(app: App, case: Case) -> Iterator[Case]:
    """Yield the case with each crash and each Stop at every row of its journal, and with both.

    Of a long journal only every n-th row is used. In the midst of every action, brain and gateway
    crash, and drones restart.
    """
    if not case.missions:
        return
    yield case
    trial = tried(app, case)
    for row in range(1, trial.rows + 1, 1 + trial.rows // MOST_ROWS):
        for kind in (*DEATHS, *STOPS):
            yield replace(case, strikes=(Strike(kind=kind, row=row),))
        for death, stop in product(DEATHS, STOPS):
            for first, second in ((death, stop), (stop, death)):
                both = Strike(kind=first, row=row), Strike(kind=second, row=row + 1)
                yield replace(case, strikes=both)
    for act in trial.acts[:: 1 + len(trial.acts) // MOST_ROWS]:
        moment = act.time - _MIDST
        row = bisect_right(trial.times, moment)
        if row:
            after = round(moment - trial.times[row - 1], 3)
            for kinds in _IN_THE_MIDST:
                strikes = tuple(Strike(kind=kind, row=row, after=after) for kind in kinds)
                yield replace(case, strikes=strikes)


def small_case(
    app: App, fleet: FleetFile, seed: int, missions: Sequence[Mission[Any]] = ()
) -> Case:
    """Return a small case for `everywhere`; every other one has no random faults."""
    weather = FAIR if seed % 2 == 0 else random_weather(Random(f"{seed}/weather"))
    flown = tuple(missions) or promising(random_missions(app, fleet, seed), seed)
    return Case(seed=seed, missions=flown, fleet=fleet, weather=weather)


def random_case(
    app: App, fleet: FleetFile, seed: int, missions: Sequence[Mission[Any]] = ()
) -> Case:
    """Return a random case with any strikes."""
    rng = Random(f"{seed}/case")
    strikes = []
    row = 0
    for _ in range(rng.choice((1, 1, 2, 2, 3))):
        row += rng.randrange(1, _BEYOND)
        strikes.append(
            Strike(kind=rng.choice(tuple(StrikeKind)), row=row, after=rng.choice(_MOMENTS))
        )
        if rng.random() < 0.5:
            row = max(0, row - _BEYOND // 2)  # another strike soon after, or during recovery
    return Case(
        seed=seed,
        missions=promising(missions or random_missions(app, fleet, seed), seed),
        fleet=fleet,
        weather=random_weather(rng),
        strikes=tuple(strikes),
    )


def random_weather(rng: Random) -> Weather:
    """Return random faults."""
    share = (0.0, 0.0, 0.1, 0.3)
    return Weather(
        crash=rng.choice(share),
        link=rng.choice(share),
        action=rng.choice(share),
        battery=rng.choice(share),
        hook=rng.choice((0.0, 0.0, 0.0, 0.1)),
        block=rng.choice((0.0, 0.0, 0.2)),
        late=rng.choice((0.0, 0.0, 0.3)),
        slow=rng.choice((0.0, 0.0, 0.05, 0.4)),
        radio=rng.choice((0.0, 0.0, 0.1, 0.5)),
        disk=rng.choice((0.0, 0.0, 0.02, 0.3)),
        jump=rng.choice((0.0, 0.0, 5.0, 100.0, -50.0)),
        down=rng.choice((0.2, 1.0, 5.0, 60.0)),
    )


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


SHRINKS = 1500

T = TypeVar("T")


def shrunk(case: Case, fails: Callable[[Case], bool], tries: int = SHRINKS) -> Case:
    """Return a smaller case that still fails, within a number of tries."""
    again = True
    while again:
        again = False
        for smaller in _smaller(case):
            tries -= 1
            if tries < 0:
                return case
            if fails(smaller):
                case = smaller
                again = True
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
    for one in fields(weather):
        yield replace(weather, **{one.name: getattr(FAIR, one.name)})


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
