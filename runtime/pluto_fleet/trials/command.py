"""`plutoc test`, within the app that was compiled for it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from copy import deepcopy
from dataclasses import dataclass, replace
from math import inf
from operator import attrgetter
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from ..files.drones import DroneEntry
from ..files.fleet import FleetFile, default_fleet, load_fleet
from ..files.fleet_text import fleet_text
from ..files.missions import load_missions
from ..files.missions_text import missions_text
from ..files.plan_check import problems
from ..report.terminal import trial_progress
from ..shared import output
from ..shared.domain.errors import BadInput
from ..shared.domain.fields import Entity, FieldType
from ..shared.domain.text import counted
from ..shared.domain.trace import dumped
from ..shared.fleet.reach import idle_actions
from .case import FAIR, Case
from .explore import Finding, Tally, everywhere, explored, random_case, small_case
from .lives import tried
from .options import Options, parse
from .report import findings_data, repeated, report, shown_again
from .shrink import first_the_same, shows_the_same, shrunk

if TYPE_CHECKING:
    from ..app import App
    from ..shared.domain.model import Mission

FOUND, BAD_INPUT = 1, 2

STRUCK_EVERYWHERE = 3
"""The number of seeds for which every strike is tried at every row."""
MOST_FINDINGS = 5
"""The number of findings after which the search ends."""

_WRONG = attrgetter("wrong")


ByItself = Callable[[list[str]], int]
"""Runs the program with these arguments in a new process, and returns the exit code."""


def test(app: App, argv: Sequence[str], by_itself: ByItself | None = None) -> int:
    """Try the app, report the findings, and return the exit code."""
    try:
        options = parse(argv)
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else BAD_INPUT
    return _tried(app, options, by_itself)


def _tried(app: App, options: Options, by_itself: ByItself | None) -> int:
    fleet = _simulated(load_fleet(options.fleet, app)) if options.fleet else default_fleet(app)
    missions = _missions(app, fleet, options)
    if options.single:
        return _once_more(app, fleet, options, missions)
    if not missions:
        for sentence in idle_actions(app, fleet):
            output.tell(f"{options.fleet or app.name}: warning: {sentence}, so it is not tried")
    tally = Tally()
    progress = trial_progress(lines=not options.json)
    way = _Extent()

    def enough(tally: Tally) -> bool:
        progress.update(tally.runs / way.runs, _so_far(tally, way, options))
        return len(tally.findings) >= MOST_FINDINGS

    def fails(case: Case) -> bool:
        progress.update(1.0, f"{_so_far(tally, way, options)}: making the first one smaller")
        return the_same(case)

    smallest: Finding | None = None
    interrupted = False
    try:
        explored(app, _cases(app, fleet, options, missions, way), tally, enough)
        if tally.findings:
            the_same = shows_the_same(app, tally.findings[0], _WRONG)
            smallest = _smallest(app, tally.findings[0], fails)
            if smallest and by_itself and not _shows(app, smallest, by_itself):
                smallest = None
    except KeyboardInterrupt:
        if not tally.runs:
            raise
        interrupted = True  # what was found so far is reported
    finally:
        progress.clear()
    if not tally.runs:
        raise BadInput("the fleet can fly none of the missions that were drawn: use --missions")
    if options.json:
        output.line(dumped(findings_data(app, tally, smallest)))
    else:
        for line in report(app, options, tally, smallest, interrupted=interrupted):
            output.line(line)
    if interrupted:
        raise KeyboardInterrupt
    return FOUND if tally.findings else 0


def _simulated(fleet: FleetFile) -> FleetFile:
    """Return the fleet without its settings for real drones."""
    plain = FleetFile(airspace=fleet.airspace, drones=())
    return replace(
        fleet,
        navigation=plain.navigation,
        options=plain.options,
        localization=plain.localization,
        localization_options=plain.localization_options,
        drones=tuple(
            DroneEntry(id=drone.id, category=drone.category, home=drone.home)
            for drone in fleet.drones
        ),
    )


@dataclass(slots=True)
class _Extent:
    """The progress of the work."""

    seeds: int = 0
    """The number of seeds begun."""
    runs: float = inf
    """The expected number of runs, as far as known."""


def _cases(
    app: App, fleet: FleetFile, options: Options, missions: Sequence[Mission[Any]], way: _Extent
) -> Iterator[Case]:
    known = options.seeds
    for seed in range(options.seed, options.seed + options.seeds):
        way.seeds += 1
        ahead = min(options.seeds, STRUCK_EVERYWHERE) - way.seeds
        yield random_case(app, fleet, seed, missions)
        if ahead >= 0:
            struck = list(everywhere(app, small_case(app, fleet, seed, missions)))
            known += len(struck)
            way.runs = known + ahead * len(struck)
            yield from struck


def _so_far(tally: Tally, way: _Extent, options: Options) -> str:
    found = counted(len(tally.findings), "mistake")
    return f"{counted(tally.runs, 'run')}, seed {way.seeds} of {options.seeds}, {found} found"


def _smallest(app: App, first: Finding, fails: Callable[[Case], bool]) -> Finding | None:
    """Shrink a finding to a small case with the same violation; None: its own case does not reproduce it."""
    if not fails(first.case):
        return None
    small = shrunk(first.case, fails)
    return Finding(case=small, sentences=first_the_same(first, tried(app, small).wrong))


def _shows(app: App, small: Finding, by_itself: ByItself) -> bool:
    """Return whether a case shows it in a new process, without state left by earlier runs."""
    with TemporaryDirectory() as folder:
        missions, fleet = Path(folder) / "missions.toml", Path(folder) / "fleet.toml"
        missions.write_text(missions_text(app, small.case.missions), encoding="utf-8")
        fleet.write_text(fleet_text(small.case.fleet), encoding="utf-8")
        return by_itself(repeated(small.case, missions, fleet)) == FOUND


def _once_more(
    app: App, fleet: FleetFile, options: Options, missions: Sequence[Mission[Any]]
) -> int:
    drawn = small_case(app, fleet, options.seed, missions)
    case = Case(
        seed=options.seed,
        missions=drawn.missions,
        fleet=fleet,
        weather=options.weather or FAIR,
        strikes=options.strike or (),
    )
    trial = tried(app, case)
    if options.json:
        tally = Tally(runs=1, rows=trial.rows, lives=trial.lives, fired=trial.fired)
        finding = Finding(case=case, sentences=trial.wrong) if trial.wrong else None
        output.line(dumped(findings_data(app, tally, finding)))
    else:
        for line in shown_again(trial):
            output.line(line)
    return FOUND if trial.wrong else 0


def _missions(app: App, fleet: FleetFile, options: Options) -> list[Mission[Any]]:
    """Return the missions of the file, if any; endless repetitions are limited to one."""
    if options.missions is None:
        return []
    missions = load_missions(options.missions, app, fleet.airspace, fleet.landmarks)
    found = problems(missions, app, fleet, fleet.airspace)
    if found:
        raise BadInput("\n".join(f"{options.missions}: {sentence}" for sentence in found))
    missions = deepcopy(missions)
    for field in app.fields:
        if field.on is Entity.MISSION and field.type is FieldType.ROUNDS:
            for mission in missions:
                if getattr(mission, field.name) is True:
                    setattr(mission, field.name, 1)
    return missions
