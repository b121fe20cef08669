"""Which cases are tried: everything that can strike, at every row of a journal, or drawn by a seed."""

from __future__ import annotations

import gc
from bisect import bisect_right
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace
from random import Random
from typing import TYPE_CHECKING, Any

from .blows import DEATHS, STOPS, Blow, Kind
from .case import FAIR, Case, Weather
from .drawing import drawn_missions
from .rig import tried

if TYPE_CHECKING:
    from plutoc_runtime.domain.app import App
    from plutoc_runtime.domain.model import Mission

    from ..files.fleet import FleetFile
    from .book import Trial

FAULTS = (
    *(kind.value for kind in Kind),
    "failsafe",
    "death in recovery",
    "report to nobody",
    "slow line",
    "slow radio",
    "slow disk",
    "late wake-up",
    "clock jump",
    "snapshot",
    "hook raising",
    "hook blocking",
    "go on",
    "decision",
    "decision at rest",
    "flight: crash",
    "flight: link",
    "flight: battery",
    "flight: action",
)
"""Everything of which it is counted how often it has really struck."""

FORGOTTEN = 100
"""After so many trials the memory that they took is given back."""

_MOMENTS = (0.0, 0.0, 0.4, 1.1, 2.2, 7.0)
"""Seconds after a row at which something strikes: also while an action is under way."""
_MOST_ROWS = 100
_MIDST = 0.6
"""Seconds before an action is done."""
_IN_THE_MIDST = (
    (Kind.CRASH,),
    (Kind.GATEWAY,),
    (Kind.FREEZE,),
    (Kind.CUT,),
    (Kind.PAUSE,),
    (Kind.GATEWAY, Kind.REBOOT),
    (Kind.CRASH, Kind.REBOOT),
    (Kind.CRASH, Kind.GATEWAY),
)
_BEYOND = 14
"""Rows among which the next blow of a drawn case falls."""


@dataclass(slots=True, kw_only=True)
class Finding:
    """A case in which something was that may not be."""

    case: Case
    sentences: tuple[str, ...]


@dataclass(slots=True, kw_only=True)
class Tally:
    """What came of many cases."""

    runs: int = 0
    rows: int = 0
    lives: int = 0
    missions: Counter[str] = field(default_factory=Counter)
    """How many ended with which status."""
    fired: Counter[str] = field(default_factory=Counter)
    findings: list[Finding] = field(default_factory=list)


def explored(
    app: App,
    cases: Iterable[Case],
    tally: Tally,
    enough: Callable[[Tally], bool],
    wrong: Callable[[Trial], tuple[str, ...]] = lambda trial: trial.wrong,
) -> None:
    """Try one case after the other, until all are tried or it is enough; `wrong` says what to find."""
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
    """Yield the case with each death and each Stop at every row of its journal, and with both.

    Of a long journal it is every second row, or third, and so on. In the midst of every action
    there die brain and gateway, and drones forget.
    """
    if not case.missions:
        return
    yield case
    trial = tried(app, case)
    for row in range(1, trial.rows + 1, 1 + trial.rows // _MOST_ROWS):
        for kind in (*DEATHS, *STOPS):
            yield replace(case, blows=(Blow(kind=kind, row=row),))
        for death in DEATHS:
            for stop in STOPS:
                first, second = Blow(kind=death, row=row), Blow(kind=stop, row=row + 1)
                yield replace(case, blows=(first, second))
                first, second = Blow(kind=stop, row=row), Blow(kind=death, row=row + 1)
                yield replace(case, blows=(first, second))
    for act in trial.acts[:: 1 + len(trial.acts) // _MOST_ROWS]:
        moment = act.time - _MIDST
        row = bisect_right(trial.times, moment)
        if row:
            after = round(moment - trial.times[row - 1], 3)
            for kinds in _IN_THE_MIDST:
                blows = tuple(Blow(kind=kind, row=row, after=after) for kind in kinds)
                yield replace(case, blows=blows)


def small_case(
    app: App, fleet: FleetFile, seed: int, missions: Sequence[Mission[Any]] = ()
) -> Case:
    """Return a case to strike everywhere: small missions, and weather that is fair every other time."""
    weather = FAIR if seed % 2 == 0 else drawn_weather(Random(f"{seed}/weather"))
    flown = missions or drawn_missions(app, fleet, seed)
    return Case(seed=seed, missions=tuple(flown), fleet=fleet, weather=weather)


def drawn_case(
    app: App, fleet: FleetFile, seed: int, missions: Sequence[Mission[Any]] = ()
) -> Case:
    """Return a case in which anything may strike, by a seed."""
    rng = Random(f"{seed}/case")
    blows = []
    row = 0
    for _ in range(rng.choice((1, 1, 2, 2, 3))):
        row += rng.randrange(1, _BEYOND)
        blows.append(Blow(kind=rng.choice(tuple(Kind)), row=row, after=rng.choice(_MOMENTS)))
        if rng.random() < 0.5:
            row = max(0, row - _BEYOND // 2)  # something else soon after, or during recovery
    return Case(
        seed=seed,
        missions=tuple(missions or drawn_missions(app, fleet, seed)),
        fleet=fleet,
        weather=drawn_weather(rng),
        blows=tuple(blows),
    )


def drawn_weather(rng: Random) -> Weather:
    """Return some weather."""
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
        snapshot=rng.choice((0.0, 1.0)),
    )
